#include "rendering/cylinder/colour_readout.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/functions.h"
#include "rendering/image_readout.h"
#include "rendering/radiometry.h"

namespace rockyard::rendering {

namespace {

constexpr double kAnyWidth_m = 1e-9;  // makes 1 of an irradiance of 1 W/m2/nm: shares come out

SunLight StrengthsOf(const CylinderLightParams& light) {
  SunParams sun;
  sun.elevation_rad = light.elevation_rad;
  sun.azimuth_rad = light.azimuth_rad;
  sun.irradiance_w_m2_nm = 1.0;
  sun.distance_au = 1.0;
  sun.optical_depth = light.optical_depth;
  sun.diffuse_share = light.diffuse_share;
  return MakeSunLight(sun, kAnyWidth_m);
}

}  // namespace

ColourLight::ColourLight(const CylinderLightParams& light, const Colour& ground) {
  const SunLight strengths = StrengthsOf(light);
  toward_sun_L_ = strengths.toward_sun_W;
  sun_ = strengths.direct_w_m2 * ToColour(light.sun);
  sky_ = strengths.sky_w_m2 * ToColour(light.sky);
  ground_ = ground * (sun_ * std::max(0.0, toward_sun_L_.z()) + sky_);
}

Colour ColourLight::On(const math::Vector3& normal_L) const {
  const double facing = std::max(0.0, normal_L.dot(toward_sun_L_));
  const double up = 0.5 * (1.0 + normal_L.z());
  return sun_ * facing + sky_ * up + ground_ * (1.0 - up);
}

namespace {

constexpr double kLargestCount = 255.0;
// Weights of brightness (ITU-R BT.601).
constexpr std::array<float, 3> kBrightness{0.299F, 0.587F, 0.114F};

// Blurs by [a, 1 - 2a, a] along both axes, edges repeated; the variance of these weights is 2 a.
void BlurLight(float a, ColourPlane& plane) {
  if (a == 0.0F) return;
  const int columns = plane.width();
  const int rows = plane.height();
  const float b = 1.0F - 2.0F * a;
  ColourPlane along(columns, rows);
  for (int row = 0; row < rows; ++row) {
    const auto from = plane.Row(row);
    const auto to = along.Row(row);
    const auto last = static_cast<std::size_t>(columns) - 1;
    to[0] = a * (from[0] + from[1]) + b * from[0];
    to[last] = a * (from[last - 1] + from[last]) + b * from[last];
    for (std::size_t i = 1; i < last; ++i) to[i] = a * (from[i - 1] + from[i + 1]) + b * from[i];
  }
  for (int row = 0; row < rows; ++row) {
    const auto above = along.Row(std::max(row - 1, 0));
    const auto here = along.Row(row);
    const auto below = along.Row(std::min(row + 1, rows - 1));
    const auto to = plane.Row(row);
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = a * (above[i] + below[i]) + b * here[i];
  }
}

// Returns the weights of a Gaussian of that deviation, from the middle on, that add up to 1 with
// their mirror image.
std::vector<float> ColourBlurWeights(double deviation) {
  std::vector<float> weights{1.0F};
  if (deviation == 0.0) return weights;
  float sum = 1.0F;
  for (int k = 1; k <= static_cast<int>(std::ceil(3.0 * deviation)); ++k) {
    weights.push_back(static_cast<float>(math::Exp(-0.5 * k * k / (deviation * deviation))));
    sum += 2.0F * weights.back();
  }
  for (float& weight : weights) weight /= sum;
  return weights;
}

// Blurs along a line with its ends repeated. `padded` holds weights.size() - 1 more values than the
// line on either side, which are filled in here.
void BlurLine(const std::vector<float>& weights, std::vector<float>& padded, std::span<float> to) {
  const std::size_t reach = weights.size() - 1;
  std::fill_n(padded.begin(), reach, padded[reach]);
  std::fill_n(padded.begin() + static_cast<std::ptrdiff_t>(reach + to.size()), reach,
              padded[reach + to.size() - 1]);
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = weights[0] * padded[i + reach];
  for (std::size_t k = 1; k <= reach; ++k) {
    for (std::size_t i = 0; i < to.size(); ++i) {
      to[i] += weights[k] * (padded[i + reach - k] + padded[i + reach + k]);
    }
  }
}

}  // namespace

ColourReadout::ColourReadout(const ColourCameraParams& camera, const CylinderLightParams& light,
                             const Colour& ground)
    : camera_(camera) {
  CylinderLightParams at_balance = light;
  at_balance.elevation_rad = camera.balance_elevation_rad;
  const math::Vector3 up = math::Vector3::UnitZ();
  gains_ = Mixed(ColourLight(at_balance, ground).On(up)).inverse();
  const Colour level = gains_ * Mixed(ground * ColourLight(light, ground).On(up));
  gains_ *= kLargestCount * camera.exposure_level / level.maxCoeff();
}

Colour ColourReadout::Mixed(const Colour& light) const {
  const double k = camera_.crosstalk;
  return {(1.0 - k) * light[0] + k * light[1],
          (1.0 - k) * light[1] + 0.5 * k * (light[0] + light[2]),
          (1.0 - k) * light[2] + k * light[1]};
}

ColourPlanes ColourReadout::Counts(const ColourPlanes& light) const {
  ColourPlanes counts = light;
  const auto k = static_cast<float>(camera_.crosstalk);
  const std::array<float, 3> gains{static_cast<float>(gains_[0]), static_cast<float>(gains_[1]),
                                   static_cast<float>(gains_[2])};
  const auto red = light[0].values();
  const auto green = light[1].values();
  const auto blue = light[2].values();
  for (std::size_t i = 0; i < red.size(); ++i) {
    counts[0].values()[i] = gains[0] * ((1.0F - k) * red[i] + k * green[i]);
    counts[1].values()[i] = gains[1] * ((1.0F - k) * green[i] + 0.5F * k * (red[i] + blue[i]));
    counts[2].values()[i] = gains[2] * ((1.0F - k) * blue[i] + k * green[i]);
  }
  const auto a = static_cast<float>(0.5 * camera_.blur_px * camera_.blur_px);
  for (ColourPlane& plane : counts) BlurLight(a, plane);
  BlurColours(counts);
  return counts;
}

void ColourReadout::BlurColours(ColourPlanes& planes) const {
  const std::vector<float> weights = ColourBlurWeights(camera_.colour_blur_px);
  const std::size_t reach = weights.size() - 1;
  if (reach == 0) return;
  const auto columns = static_cast<std::size_t>(planes[0].width());
  std::vector<float> brightness(columns);
  std::vector<float> padded(columns + 2 * reach);
  std::vector<float> blurred(columns);
  for (int row = 0; row < planes[0].height(); ++row) {
    std::fill(brightness.begin(), brightness.end(), 0.0F);
    for (std::size_t channel = 0; channel < planes.size(); ++channel) {
      const auto values = planes[channel].Row(row);
      for (std::size_t i = 0; i < columns; ++i) brightness[i] += kBrightness[channel] * values[i];
    }
    for (ColourPlane& plane : planes) {
      const auto values = plane.Row(row);
      for (std::size_t i = 0; i < columns; ++i) padded[i + reach] = values[i] - brightness[i];
      BlurLine(weights, padded, blurred);
      for (std::size_t i = 0; i < columns; ++i) values[i] = brightness[i] + blurred[i];
    }
  }
}

vision::ColourImage ColourReadout::Read(const ColourPlanes& counts, core::TrialKey key,
                                        std::uint32_t image) const {
  const int columns = counts[0].width();
  vision::ColourImage read(columns, counts[0].height());
  const auto read_variance =
      static_cast<float>(camera_.read_noise_counts * camera_.read_noise_counts);
  const auto shot = static_cast<float>(kLargestCount / camera_.full_well_e);
  constexpr std::array<std::uint8_t vision::Rgb::*, 3> kChannels{
      &vision::Rgb::red, &vision::Rgb::green, &vision::Rgb::blue};
  for (std::uint32_t channel = 0; channel < kChannels.size(); ++channel) {
    const PixelNoise noise(key, core::Purpose::kCylinderNoise, 3 * image + channel);
    for (int row = 0; row < read.height(); ++row) {
      const auto light = counts[channel].Row(row);
      const auto to = read.Row(row);
      ForEachPixelNoise(noise, row, 0, columns, [&](int column, float number) {
        const auto i = static_cast<std::size_t>(column);
        const float deviation = std::sqrt(read_variance + shot * std::max(0.0F, light[i]));
        float count = light[i] + deviation * number;
        if (camera_.gamma != 1.0) {
          const double share = std::max(0.0, count / kLargestCount);
          count = static_cast<float>(kLargestCount * math::Pow(share, camera_.gamma));
        }
        to[i].*kChannels[channel] =
            static_cast<std::uint8_t>(std::clamp(count + 0.5F, 0.0F, 255.0F));
      });
    }
  }
  return read;
}

}  // namespace rockyard::rendering

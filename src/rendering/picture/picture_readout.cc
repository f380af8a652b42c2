#include "rendering/picture/picture_readout.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/check.h"
#include "core/random.h"
#include "math/functions.h"
#include "rendering/radiometry.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

std::vector<float> GaussianWeights(double sigma_px) {
  constexpr double kReach = 4.0;  // in units of sigma
  std::vector<float> weights{1.0F};
  double sum = 1.0;
  for (int k = 1; k < kReach * sigma_px + 1.0; ++k) {
    const double weight = math::Exp(-0.5 * k * k / (sigma_px * sigma_px));
    weights.push_back(static_cast<float>(weight));
    sum += 2.0 * weight;
  }
  for (float& weight : weights) weight = static_cast<float>(weight / sum);
  return weights;
}

// Adds every pixel times `weight` to `sum`.
void AddRow(std::span<const float> from, float weight, std::span<float> sum) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * from[i];
}

}  // namespace

vision::Image<float> Blurred(const vision::Image<float>& sharp, double sigma_px) {
  if (sigma_px == 0.0 || sharp.empty()) return sharp;
  const std::vector<float> weights = GaussianWeights(sigma_px);
  const int reach = static_cast<int>(weights.size()) - 1;
  const int width = sharp.width();
  const int height = sharp.height();
  vision::Image<float> blurred(width, height);
  std::vector<float> line(static_cast<std::size_t>(width + 2 * reach));
  for (int y = 0; y < height; ++y) {
    // The blur along columns comes first, into `line`, whose ends are then repeated for the blur
    // along rows.
    std::fill(line.begin(), line.end(), 0.0F);
    const std::span<float> middle(line.data() + reach, static_cast<std::size_t>(width));
    for (int k = -reach; k <= reach; ++k) {
      const int from = std::clamp(y + k, 0, height - 1);
      AddRow(sharp.Row(from), weights[static_cast<std::size_t>(std::abs(k))], middle);
    }
    std::fill_n(line.begin(), reach, middle.front());
    std::fill_n(line.end() - reach, reach, middle.back());
    for (int k = 0; k <= 2 * reach; ++k) {
      AddRow({line.data() + k, static_cast<std::size_t>(width)},
             weights[static_cast<std::size_t>(std::abs(k - reach))], blurred.Row(y));
    }
  }
  return blurred;
}

vision::GrayImage ToGray(const vision::Image<std::uint16_t>& counts, int bits) {
  EXPECT(bits >= 8 && bits <= 16);
  vision::GrayImage gray(counts.width(), counts.height());
  std::transform(
      counts.values().begin(), counts.values().end(), gray.values().begin(),
      [bits](std::uint16_t count) { return static_cast<std::uint8_t>(count >> (bits - 8)); });
  return gray;
}

PictureReadout::PictureReadout(const PictureCameraParams& params, const PixelRays& rays, int camera,
                               core::TrialKey key)
    : params_(params),
      key_(key),
      readout_(params.imager, 0.0),
      electrons_per_radiance_(
          ElectronsPerRadiance(params.imager, params.PixelArea(), params.wavelength_m)),
      gain_(rays.columns(), rays.rows()) {
  SetGain(rays);
  SetPattern(camera);
}

void PictureReadout::SetGain(const PixelRays& rays) {
  const int middle_column = rays.columns() / 2;
  const int middle_row = rays.rows() / 2;
  const Vector3 axis = rays.At(middle_column, middle_row).direction;
  // Solid angle of a small pixel: |d_column x d_row| of its rays.
  const auto solid_angle = [&rays](int column, int row) {
    return rays.ByColumn(column, row).cross(rays.ByRow(column, row)).norm();
  };
  const double on_axis = solid_angle(middle_column, middle_row);
  double corner_rad = 0.0;
  const auto angle = [&](int column, int row) {
    return math::Acos(std::clamp(axis.dot(rays.At(column, row).direction), -1.0, 1.0));
  };
  for (int row = 0; row < rays.rows(); ++row) {
    for (int column = 0; column < rays.columns(); ++column) {
      if (rays.Sees(column, row)) corner_rad = std::max(corner_rad, angle(column, row));
    }
  }
  for (int row = 0; row < rays.rows(); ++row) {
    for (int column = 0; column < rays.columns(); ++column) {
      if (!rays.Sees(column, row)) continue;
      double gain = 1.0;
      if (params_.vignetting == Vignetting::kNatural) {
        const double cosine = std::max(0.0, axis.dot(rays.At(column, row).direction));
        gain = solid_angle(column, row) * cosine / on_axis;
      } else if (params_.vignetting == Vignetting::kPolynomial) {
        const double x = angle(column, row) / corner_rad;
        gain = 1.0 + x * x * (params_.vignetting_c2 + x * x * params_.vignetting_c4);
      }
      gain_.At(column, row) = static_cast<float>(gain);
    }
  }
}

void PictureReadout::SetPattern(int camera) {
  const int columns = gain_.width();
  const int rows = gain_.height();
  for (int row = 0; row < rows; ++row) {
    pattern_.push_back(readout_.Pattern(camera, row, 0, columns, key_));
  }
  core::RandomStream stream(key_, core::Purpose::kPixelDefect, static_cast<std::uint32_t>(camera));
  const double pixels = static_cast<double>(columns) * rows;
  const std::int64_t count = core::SamplePoisson(stream, params_.stuck_share * pixels);
  for (std::int64_t i = 0; i < count; ++i) {
    const auto column = static_cast<int>(core::SampleUniform(stream, 0.0, columns));
    const auto row = static_cast<int>(core::SampleUniform(stream, 0.0, rows));
    const bool bright = core::SampleBernoulli(stream, 0.5);
    stuck_.push_back({column, row, static_cast<std::uint16_t>(bright ? largest_count() : 0)});
  }
}

vision::Image<float> PictureReadout::Rates(const Picture& picture) const {
  EXPECT(picture.columns() == gain_.width() && picture.rows() == gain_.height());
  vision::Image<float> rates = Blurred(picture.radiance_w_m2_sr, params_.blur_px);
  const auto factor = static_cast<float>(electrons_per_radiance_);
  std::transform(rates.values().begin(), rates.values().end(), gain_.values().begin(),
                 rates.values().begin(),
                 [factor](float radiance, float gain) { return factor * gain * radiance; });
  return rates;
}

double PictureReadout::Exposure(const vision::Image<float>& rates_e_s) const {
  std::vector<double> metered(rates_e_s.values().begin(), rates_e_s.values().end());
  if (params_.flat_field == FlatField::kCorrected) {
    // The delivered image is metered, in which a dark corner is brightened.
    for (std::size_t i = 0; i < metered.size(); ++i) {
      const float gain = gain_.values()[i];
      if (gain > 0.0F) metered[i] /= static_cast<double>(gain);
    }
  }
  return ExposureTime(params_.imager, std::move(metered));
}

RawImage PictureReadout::Read(const vision::Image<float>& rates_e_s, double exposure_s,
                              ImageNumber image) const {
  EXPECT(rates_e_s.width() == gain_.width() && rates_e_s.height() == gain_.height());
  RawImage raw{vision::Image<std::uint16_t>(gain_.width(), gain_.height()), exposure_s};
  const double black = params_.imager.black_level * largest_count();
  std::vector<std::uint16_t> counts;
  for (int row = 0; row < gain_.height(); ++row) {
    const auto rates = rates_e_s.Row(row);
    const RenderedRow line{row, {rates.begin(), rates.end()}, {}};
    const PixelPattern& pattern = pattern_[static_cast<std::size_t>(row)];
    counts.clear();
    readout_.Read(line, pattern, 0, exposure_s, key_, image, {}, counts);
    const auto out = raw.counts.Row(row);
    if (params_.flat_field == FlatField::kRaw) {
      std::copy(counts.begin(), counts.end(), out.begin());
      continue;
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      // A pixel without light has nothing to be corrected by.
      const double gain = gain_.Row(row)[i] * (1.0 + pattern.response[i]);
      const double flat = gain > 0.0 ? (counts[i] - black) / gain + black : counts[i];
      out[i] = static_cast<std::uint16_t>(
          std::clamp(flat + 0.5, 0.0, static_cast<double>(largest_count())));
    }
  }
  for (const Stuck& pixel : stuck_) raw.counts.At(pixel.column, pixel.row) = pixel.count;
  return raw;
}

}  // namespace rockyard::rendering

#include "rendering/cylinder/backdrop.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/random.h"
#include "math/angles.h"
#include "math/functions.h"
#include "rendering/image_readout.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

constexpr double kFinest_m = 0.004;
constexpr int kOctavesOfLine = 5;
// Lattices repeat after 2^15 nodes, the range of PixelNoise.
constexpr int kPeriod = 1 << 15;

int Wrapped(std::int64_t node) { return static_cast<int>(node & (kPeriod - 1)); }

constexpr int kHueOctave = 7;           // 0.5 m
constexpr int kHorizonNodes = 1024;     // along the hills' edge, half on either side
constexpr double kHorizonNode_m = 4.0;  // between them

// The directions of a line of the image: A + (row - c_v) / f V' + (column - c_h) / f H'.
struct LineOfSight {
  double ahead = 1.0;  // per unit along the axis
  double up = 0.0;
  double aside_per_column = 0.0;  // to the left
  double aside_first = 0.0;       // of column 0
};

LineOfSight LineAt(const vision::Cahv& camera, double row) {
  const double middle_row = camera.V.dot(camera.A);
  const Vector3 down_f = camera.V - middle_row * camera.A;
  const double middle_column = camera.H.dot(camera.A);
  const Vector3 right_f = camera.H - middle_column * camera.A;
  const Vector3 direction = camera.A + (row - middle_row) / down_f.squaredNorm() * down_f;
  const double per_column = right_f.y() / right_f.squaredNorm();
  return {direction.x(), direction.z(), per_column, -middle_column * per_column};
}

// Returns how far along the axis a line of the image meets the ground; nothing at or above the
// level.
std::optional<double> ToGround(const vision::Cahv& camera, const LineOfSight& line) {
  if (line.up >= 0.0) return std::nullopt;
  return -camera.C.z() / line.up;
}

}  // namespace

double LatticeTexture::SpacingOf(int octave) { return std::ldexp(kFinest_m, octave); }

void LatticeTexture::AddOctave(const TextureLine& line, int octave, double deviation,
                               std::span<float> values) {
  const double spacing_m = SpacingOf(octave);
  const PixelNoise noise(key_, core::Purpose::kCylinderGround, static_cast<std::uint32_t>(octave));
  const auto pixels = static_cast<double>(values.size());
  const double first = line.first_v_m / spacing_m;
  const double step = line.step_v_m / spacing_m;
  const double last = first + step * (pixels - 1.0);
  const auto low = static_cast<std::int64_t>(std::floor(std::fmin(first, last)));
  const auto high = static_cast<std::int64_t>(std::floor(std::fmax(first, last))) + 1;
  const double u = line.u_m / spacing_m;
  const double row = std::floor(u);
  const auto share = static_cast<float>(u - row);
  // Nodes come by eights, from a multiple of eight on.
  const std::int64_t start = low - (low & (PixelNoise::kBlock - 1));
  nodes_.clear();
  for (std::int64_t node = start; node <= high; node += PixelNoise::kBlock) {
    const int block = PixelNoise::BlockOf(Wrapped(node));
    const auto here = noise.Block(Wrapped(static_cast<std::int64_t>(row)), block);
    const auto next = noise.Block(Wrapped(static_cast<std::int64_t>(row) + 1), block);
    for (std::size_t i = 0; i < here.size(); ++i) {
      nodes_.push_back((1.0F - share) * here[i] + share * next[i]);
    }
  }
  // Linear interpolation has 2/3 of the nodes' variance along either axis, on average.
  const auto scale = static_cast<float>(1.5 * deviation);
  double place = first - static_cast<double>(start);
  for (float& value : values) {
    const auto node = static_cast<std::size_t>(place);
    const auto way = static_cast<float>(place - static_cast<double>(node));
    value += scale * ((1.0F - way) * nodes_[node] + way * nodes_[node + 1]);
    place += step;
  }
}

void LatticeTexture::AddTo(const TextureLine& line, double deviation, std::span<float> values) {
  const double least_m = 2.0 * std::abs(line.step_v_m);
  const double level = math::Log2(std::fmax(least_m / kFinest_m, 1.0));
  const int first = static_cast<int>(std::ceil(level));
  const double fade = static_cast<double>(first) - level;
  const double each = deviation / std::sqrt(static_cast<double>(kOctavesOfLine));
  for (int k = 0; k <= kOctavesOfLine; ++k) {
    const double weight = k == 0 ? fade : (k == kOctavesOfLine ? 1.0 - fade : 1.0);
    if (weight <= 0.0) continue;
    const double spacing_m = SpacingOf(first + k);
    const double kept = std::sqrt(std::fmin(1.0, spacing_m / line.footprint_u_m));
    AddOctave(line, first + k, each * weight * kept, values);
  }
}

Backdrop::Backdrop(const BackdropParams& params, const ColourLight& light, core::TrialKey key)
    : params_(params), sky_(light.sky()), texture_(key) {
  const Colour ground = ToColour(params.ground);
  ground_ = ground * light.On(Vector3::UnitZ());
  const double slope_rad = math::DegToRad(60.0);
  hills_ = ground * light.On({-math::Sin(slope_rad), 0.0, math::Cos(slope_rad)});
  core::RandomStream stream(key, core::Purpose::kCylinderScene, 2);
  for (int i = 0; i < kHorizonNodes; ++i) {
    relief_.push_back(static_cast<float>(core::SampleNormal(stream, 0.0, 1.0)));
  }
}

double Backdrop::HorizonHeight(double y_m) const {
  constexpr double kLast = kHorizonNodes - 1.001;
  const double place = std::clamp(y_m / kHorizonNode_m + 0.5 * kHorizonNodes, 0.0, kLast);
  const auto node = static_cast<std::size_t>(place);
  const double way = place - static_cast<double>(node);
  const double relief = (1.0 - way) * relief_[node] + way * relief_[node + 1];
  return params_.horizon_distance_m * math::Tan(params_.horizon_elevation_rad) +
         params_.horizon_relief_m * relief;
}

void Backdrop::Mottle(const TextureLine& line, const Colour& colour, int row,
                      ColourPlanes& planes) {
  const auto columns = static_cast<std::size_t>(planes[0].width());
  brightness_.assign(columns, 1.0F);
  hue_.assign(columns, 0.0F);
  if (params_.contrast > 0.0) texture_.AddTo(line, params_.contrast, brightness_);
  if (params_.hue_contrast > 0.0) {
    texture_.AddOctave(line, kHueOctave, params_.hue_contrast, hue_);
  }
  const std::array<float, 3> toward_red{1.0F, 0.0F, -1.0F};
  for (std::size_t channel = 0; channel < planes.size(); ++channel) {
    const auto mean = static_cast<float>(colour[static_cast<Eigen::Index>(channel)]);
    const std::span<float> values = planes[channel].Row(row);
    for (std::size_t i = 0; i < columns; ++i) {
      const float light = brightness_[i] * (1.0F + toward_red[channel] * hue_[i]);
      values[i] = mean * std::max(0.1F, light);
    }
  }
}

void Backdrop::FillRow(const vision::Cahv& camera, int row, ColourPlanes& planes) {
  const LineOfSight here = LineAt(camera, row);
  const LineOfSight above = LineAt(camera, row - 0.5);
  const LineOfSight below = LineAt(camera, row + 0.5);
  const double to_hills = (params_.horizon_distance_m - camera.C.x()) / here.ahead;
  const auto to_ground = ToGround(camera, here);
  const bool on_ground = to_ground && *to_ground < to_hills;
  const double along = on_ground ? *to_ground : to_hills;
  TextureLine line;
  line.first_v_m = camera.C.y() + along * here.aside_first;
  line.step_v_m = along * here.aside_per_column;
  if (on_ground) {
    line.u_m = camera.C.x() + along * here.ahead;
    const auto far = ToGround(camera, above);
    const double far_m = far ? std::fmin(*far * above.ahead, params_.horizon_distance_m)
                             : params_.horizon_distance_m;
    line.footprint_u_m = far_m - *ToGround(camera, below) * below.ahead;
  } else {
    line.u_m = camera.C.z() + along * here.up;
    line.footprint_u_m = std::abs(line.step_v_m);
  }
  Mottle(line, on_ground ? ground_ : hills_, row, planes);
  if (!on_ground) MixSky(camera, row, planes);
}

void Backdrop::MixSky(const vision::Cahv& camera, int row, ColourPlanes& planes) {
  const auto height_at = [&](double at_row) {
    const LineOfSight line = LineAt(camera, at_row);
    const double along = (params_.horizon_distance_m - camera.C.x()) / line.ahead;
    return camera.C.z() + along * line.up;
  };
  const double top_m = height_at(row - 0.5);
  const double bottom_m = height_at(row + 0.5);
  const LineOfSight here = LineAt(camera, row);
  const double along = (params_.horizon_distance_m - camera.C.x()) / here.ahead;
  for (int column = 0; column < planes[0].width(); ++column) {
    const double y_m = camera.C.y() + along * (here.aside_first + here.aside_per_column * column);
    const double hidden =
        std::clamp((HorizonHeight(y_m) - bottom_m) / (top_m - bottom_m), 0.0, 1.0);
    if (hidden == 1.0) continue;
    const Colour hills = PixelOf(planes, column, row);
    SetPixel(planes, column, row, hidden * hills + (1.0 - hidden) * sky_);
  }
}

void Backdrop::Fill(const vision::Cahv& camera, ColourPlanes& planes) {
  for (int row = 0; row < planes[0].height(); ++row) FillRow(camera, row, planes);
}

}  // namespace rockyard::rendering

#include "terrain/relief.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/check.h"
#include "core/random.h"
#include "math/functions.h"

namespace rockyard::terrain {

DepressionField::DepressionField(const std::vector<Depression>& depressions) {
  for (const Depression& one : depressions) {
    shapes_.push_back({one.x_m, one.y_m, math::Cos(one.direction_rad), math::Sin(one.direction_rad),
                       one.half_length_m, one.half_width_m, one.flank_m, one.depth_m});
    // S' = 30 s^2 (1 - s)^2 is at most 15/8, |S''| = 60 s (1 - s) |1 - 2 s| at most 10/sqrt(3).
    // Around a round end the slope over the distance, at most 40/9 D/e^2, is less.
    max_slope_ = std::max(max_slope_, 1.875 * one.depth_m / one.flank_m);
    max_curvature_per_m_ =
        std::max(max_curvature_per_m_,
                 10.0 * std::numbers::inv_sqrt3 * one.depth_m / (one.flank_m * one.flank_m));
  }
}

DepressionField::Place DepressionField::PlaceOf(const Shape& shape, double x_m, double y_m) {
  const double dx_m = x_m - shape.x_m;
  const double dy_m = y_m - shape.y_m;
  const double along_m = shape.along_x * dx_m + shape.along_y * dy_m;
  return {std::copysign(std::max(std::abs(along_m) - shape.half_length_m, 0.0), along_m),
          shape.along_x * dy_m - shape.along_y * dx_m};
}

ReliefSample DepressionField::SampleOf(const Shape& shape, double x_m, double y_m) {
  const auto [beyond_m, across_m] = PlaceOf(shape, x_m, y_m);
  // Most points are beside most depressions.
  if (!(std::abs(across_m) < shape.half_width_m)) return {};
  const double r_m = std::sqrt(beyond_m * beyond_m + across_m * across_m);
  if (!(r_m < shape.half_width_m)) return {};
  const double s = (r_m - shape.half_width_m + shape.flank_m) / shape.flank_m;
  if (s <= 0.0) return {-shape.depth_m, 0.0, 0.0};
  const double rest = 1.0 - s;
  const double height_m = -shape.depth_m * (1.0 - s * s * s * (10.0 + s * (6.0 * s - 15.0)));
  // The height rises along the gradient of r: (beyond, across) / r in the frame of the segment.
  const double rise = shape.depth_m * 30.0 * s * s * rest * rest / shape.flank_m / r_m;
  const double rise_along = rise * beyond_m;
  const double rise_across = rise * across_m;
  return {height_m, rise_along * shape.along_x - rise_across * shape.along_y,
          rise_along * shape.along_y + rise_across * shape.along_x};
}

bool DepressionField::Reaches(double x_m, double y_m, double radius_m) const {
  return std::any_of(shapes_.begin(), shapes_.end(), [&](const Shape& shape) {
    const Place place = PlaceOf(shape, x_m, y_m);
    const double reach_m = shape.half_width_m + radius_m;
    return place.beyond_m * place.beyond_m + place.across_m * place.across_m < reach_m * reach_m;
  });
}

ReliefSample DepressionField::Sample(double x_m, double y_m) const {
  ReliefSample deepest;
  for (const Shape& shape : shapes_) {
    const ReliefSample sample = SampleOf(shape, x_m, y_m);
    if (sample.height_m < deepest.height_m) deepest = sample;
  }
  return deepest;
}

namespace {

// Finest wavelength, m: the contact patch of a 13 cm wheel averages shorter roughness. The ground
// of every rough trial depends on it.
constexpr double kFinestWavelength_m = 0.1;
// A bound that is not reached: 100 m, the longest wavelength that parameters allow, has ten
// octaves.
constexpr int kMaxOctaves = 12;
// Integral of the squared cubic B-spline over its support.
constexpr double kSplineMeanSquare = 151.0 / 315.0;

// Weights of the four uniform cubic B-splines over a cell, and their derivatives by t, t in [0, 1)
// of the cell; CellSplines of relief_spline.cc must be the same. With s = 1 - t they are
//   s^3/6,  (4 - 6 t^2 + 3 t^3)/6,  (4 - 6 s^2 + 3 s^3)/6,  t^3/6,   and sum to 1.
struct SplineWeights {
  std::array<double, 4> value;
  std::array<double, 4> slope;
};

SplineWeights WeightsAt(double t) {
  const double s = 1.0 - t;
  return {{s * s * s / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
           (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0, t * t * t / 6.0},
          {-0.5 * s * s, (1.5 * t - 2.0) * t, -(1.5 * s - 2.0) * s, 0.5 * t * t}};
}

int OctaveCount(double longest_wavelength_m) {
  // Wavelengths L, L/2, L/4, ... down to the finest one.
  const double octaves = std::floor(math::Log2(longest_wavelength_m / kFinestWavelength_m)) + 1.0;
  return static_cast<int>(std::clamp(octaves, 1.0, double{kMaxOctaves}));
}

}  // namespace

RoughnessField::RoughnessField(double rms_m, double hurst, double longest_wavelength_m,
                               core::TrialKey key) {
  EXPECT(rms_m > 0.0 && hurst > 0.0 && hurst <= 1.0 && longest_wavelength_m > 0.0);
  octaves_.resize(static_cast<std::size_t>(OctaveCount(longest_wavelength_m)));
  double sum_of_squares = 0.0;
  // Octave j has RMS rms 2^(-j H) / sqrt(sum_i 2^(-2 i H)): the variances of all add up to rms^2.
  for (std::size_t j = 0; j < octaves_.size(); ++j) {
    sum_of_squares += math::Exp2(-2.0 * hurst * static_cast<double>(j));
  }
  for (std::size_t j = 0; j < octaves_.size(); ++j) {
    Octave& octave = octaves_[j];
    const double level = static_cast<double>(j);
    octave.spacing_m = 0.5 * longest_wavelength_m * math::Exp2(-level);
    const double octave_rms_m = rms_m * math::Exp2(-hurst * level) / std::sqrt(sum_of_squares);
    core::RandomStream stream(key, core::Purpose::kGroundRoughness, static_cast<std::uint32_t>(j));
    octave.coefficients_m.resize(std::size_t{kNodes} * kNodes);
    for (double& coefficient : octave.coefficients_m) {
      // Height = sum_ab w_a(x) w_b(y) c_ab with independent c of deviation s has the mean square
      // s^2 (sum w^2)^2, averaged over a cell s^2 (151/315)^2: so s = octave RMS / (151/315).
      coefficient = core::SampleNormal(stream, 0.0, octave_rms_m / kSplineMeanSquare);
    }
    AddBounds(octave);
  }
}

void RoughnessField::AddBounds(const Octave& octave) {
  // The lattice is periodic: the bounds of one period hold everywhere.
  const ReliefBounds bounds =
      BoundsOfSplines(kNodes, kNodes, octave.spacing_m, [&octave](int column, int row) {
        const int index = row % kNodes * kNodes + column % kNodes;
        return octave.coefficients_m[static_cast<std::size_t>(index)];
      });
  bounds_.height_m += bounds.height_m;
  bounds_.slope += bounds.slope;
  bounds_.curvature_per_m += bounds.curvature_per_m;
}

void RoughnessField::AddOctave(const Octave& octave, double x_m, double y_m, ReliefSample& sum) {
  // Position in cells; the fraction within the cell gives the weights, the whole part the
  // coefficients. Masking with 63 wraps negative indices, too.
  const double u = x_m / octave.spacing_m;
  const double v = y_m / octave.spacing_m;
  const double column = std::floor(u);
  const double row = std::floor(v);
  const SplineWeights wx = WeightsAt(u - column);
  const SplineWeights wy = WeightsAt(v - row);
  const auto first_column = static_cast<std::int64_t>(column);
  const auto first_row = static_cast<std::int64_t>(row);
  for (int i = 0; i < 4; ++i) {
    const auto wrapped_row = static_cast<std::size_t>((first_row + i) & (kNodes - 1));
    const double* line = octave.coefficients_m.data() + wrapped_row * kNodes;
    double value = 0.0;
    double slope = 0.0;
    for (int j = 0; j < 4; ++j) {
      const double coefficient = line[(first_column + j) & (kNodes - 1)];
      value += wx.value[static_cast<std::size_t>(j)] * coefficient;
      slope += wx.slope[static_cast<std::size_t>(j)] * coefficient;
    }
    const auto k = static_cast<std::size_t>(i);
    sum.height_m += wy.value[k] * value;
    // d/dx = (1 / spacing) d/dt.
    sum.slope_x += wy.value[k] * slope / octave.spacing_m;
    sum.slope_y += wy.slope[k] * value / octave.spacing_m;
  }
}

ReliefSample RoughnessField::Sample(double x_m, double y_m) const {
  ReliefSample sum;
  for (const Octave& octave : octaves_) AddOctave(octave, x_m, y_m, sum);
  return sum;
}

}  // namespace rockyard::terrain

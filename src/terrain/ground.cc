#include "terrain/ground.h"

#include <algorithm>
#include <cmath>

#include "terrain/roughness_field.h"

namespace rockyard::terrain {
namespace {

// Smallest step of a ray over rough ground, m: far below the finest wavelength of the roughness.
constexpr double kSmallestStep_m = 1e-3;
// Width at which a bracketed crossing is as exact as contacts and pixels will ever need, m.
constexpr double kCrossingWidth_m = 1e-12;
constexpr int kMostCrossingSteps = 100;

// A zero of `gap` between `above`, where it is positive, and `below`, where it is not: false
// position with the Illinois rule (Dowell and Jarratt 1971), which halves the value at an end that
// stays.
template <typename Gap>
double FindCrossing(const Gap& gap, double above, double gap_above, double below,
                    double gap_below) {
  int kept_end = 0;  // -1 below, +1 above: the end that the last step left where it was
  for (int i = 0; i < kMostCrossingSteps && below - above > kCrossingWidth_m; ++i) {
    const double t = below - gap_below * (below - above) / (gap_below - gap_above);
    const double gap_t = gap(t);
    if (std::abs(gap_t) < kCrossingWidth_m) return t;
    if (gap_t > 0.0) {
      above = t;
      gap_above = gap_t;
      if (kept_end == -1) gap_below *= 0.5;
      kept_end = -1;
    } else {
      below = t;
      gap_below = gap_t;
      if (kept_end == 1) gap_above *= 0.5;
      kept_end = 1;
    }
  }
  return above;
}

}  // namespace

Ground::Ground() = default;

Ground::Ground(const GroundParams& params, core::TrialKey key)
    : soil_(params.soil),
      slope_x_(std::tan(params.slope_rad) * std::cos(params.slope_direction_rad)),
      slope_y_(std::tan(params.slope_rad) * std::sin(params.slope_direction_rad)) {
  if (params.roughness_rms_m > 0.0) {
    roughness_ = std::make_shared<const RoughnessField>(
        params.roughness_rms_m, params.hurst_exponent, params.roughness_wavelength_m, key);
  }
}

double Ground::RoughnessHeight(double x_m, double y_m) const {
  return roughness_->Sample(x_m, y_m).height_m;
}

math::Vector3 Ground::Normal(double x_m, double y_m) const {
  math::Vector3 normal(-slope_x_, -slope_y_, 1.0);
  if (roughness_) {
    const RoughnessSample sample = roughness_->Sample(x_m, y_m);
    normal.x() -= sample.slope_x;
    normal.y() -= sample.slope_y;
  }
  return normal.normalized();
}

std::optional<double> Ground::MarchRay(const math::Vector3& origin_W,
                                       const math::Vector3& direction_W,
                                       double max_distance_m) const {
  double gap = Gap(origin_W);
  if (gap <= 0.0) return 0.0;
  // Largest rate at which the gap can close per metre of ray.
  const double horizontal = std::hypot(direction_W.x(), direction_W.y());
  const double plane_descent =
      slope_x_ * direction_W.x() + slope_y_ * direction_W.y() - direction_W.z();
  const double closing = plane_descent + roughness_->MaxSlope() * horizontal;
  if (gap > closing * max_distance_m) return std::nullopt;

  const auto gap_at = [&](double t) { return Gap(origin_W + t * direction_W); };
  double above = 0.0;  // a distance at which the ray is above the ground by `gap`
  while (above < max_distance_m) {
    const double next = std::min(above + std::max(gap / closing, kSmallestStep_m), max_distance_m);
    const double next_gap = gap_at(next);
    if (next_gap <= 0.0) return FindCrossing(gap_at, above, gap, next, next_gap);
    above = next;
    gap = next_gap;
  }
  return std::nullopt;
}

}  // namespace rockyard::terrain

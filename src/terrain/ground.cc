#include "terrain/ground.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "math/functions.h"
#include "terrain/relief.h"
#include "terrain/relief_spline.h"
#include "terrain/soil_draw.h"

namespace rockyard::terrain {
namespace {

// Smallest step of a ray over ground that is no plane, m: far below the finest wavelength of the
// roughness and the narrowest flank. Steps decide how a crossing is bracketed, and so the last bits
// of what is recorded on such ground.
constexpr double kSmallestStep_m = 1e-3;

// Returns a step within which the ray stays above the ground. Where its rate changes by no more
// than `bend` per metre, it does so for all t with gap - rate t - bend t^2 / 2 > 0. The positive
// root is
//   t = (sqrt(rate^2 + 2 bend gap) - rate) / bend,
// nearly Newton's step where the gap is small.
double SafeStep(const Approach& now, double bend_per_m) {
  const double root = std::sqrt(now.rate * now.rate + 2.0 * bend_per_m * now.gap_m);
  // Two forms of the root, each without a difference of nearly equal numbers.
  return now.rate > 0.0 ? 2.0 * now.gap_m / (now.rate + root) : (root - now.rate) / bend_per_m;
}

}  // namespace

Ground::Ground() = default;

Ground::Ground(const GroundParams& params, core::TrialKey key)
    : soil_(params.soil.spread.enabled ? DrawSoil(params.soil, key) : params.soil),
      // z = tan(slope) (x cos(direction) + y sin(direction)).
      slope_x_(math::Tan(params.slope_rad) * math::Cos(params.slope_direction_rad)),
      slope_y_(math::Tan(params.slope_rad) * math::Sin(params.slope_direction_rad)) {
  if (params.roughness_rms_m > 0.0) {
    roughness_ = std::make_shared<const RoughnessField>(
        params.roughness_rms_m, params.hurst_exponent, params.roughness_wavelength_m, key);
  }
  if (params.HasDepressions()) {
    depressions_ =
        std::make_shared<const DepressionField>(ListDepressions(params.ditches, params.pits));
  }
  if (params.elevation.IsGiven()) {
    spline_ = params.elevation.surface->Of(params.elevation);
    // Roughness is another one in every trial, the model alone is shared by all.
    if (roughness_) {
      spline_ = std::make_shared<const ReliefSpline>(spline_->model(), std::move(roughness_));
    }
  } else if (roughness_ && !depressions_) {
    spline_ = std::make_shared<const ReliefSpline>(nullptr, roughness_);
  }
  is_plane_ = !roughness_ && !spline_ && !depressions_;
}

ReliefSample Ground::ReliefAt(double x_m, double y_m) const {
  ReliefSample sum;
  if (roughness_) {
    sum = roughness_->Sample(x_m, y_m);
  } else if (spline_) {
    sum = spline_->Sample(x_m, y_m);
  }
  if (!depressions_) return sum;
  const ReliefSample down = depressions_->Sample(x_m, y_m);
  sum.height_m += down.height_m;
  sum.slope_x += down.slope_x;
  sum.slope_y += down.slope_y;
  return sum;
}

bool Ground::DepressionsReach(double x_m, double y_m, double radius_m) const {
  return depressions_->Reaches(x_m, y_m, radius_m);
}

// Depressions reach no higher than the ground around them.
ReliefBounds Ground::Bounds() const {
  ReliefBounds bounds;
  if (roughness_) {
    bounds = roughness_->bounds();
  } else if (spline_) {
    bounds = spline_->bounds();
  }
  if (depressions_) {
    bounds.slope += depressions_->MaxSlope();
    bounds.curvature_per_m += depressions_->MaxCurvature();
  }
  return bounds;
}

math::Vector3 Ground::Normal(double x_m, double y_m, RayWay way) const {
  // The surface z = h(x, y) has the normal (-dh/dx, -dh/dy, 1), up to its length.
  math::Vector3 normal(-slope_x_, -slope_y_, 1.0);
  if (!IsPlane()) {
    const ReliefSample sample = BySpline(way) ? spline_->Sample(x_m, y_m) : ReliefAt(x_m, y_m);
    normal.x() -= sample.slope_x;
    normal.y() -= sample.slope_y;
  }
  return normal.normalized();
}

std::optional<double> Ground::SplineRay(const math::Vector3& origin_W,
                                        const math::Vector3& direction_W,
                                        double max_distance_m) const {
  const SightLine line{origin_W.x(),
                       origin_W.y(),
                       direction_W.x(),
                       direction_W.y(),
                       origin_W.z() - slope_x_ * origin_W.x() - slope_y_ * origin_W.y(),
                       slope_x_ * direction_W.x() + slope_y_ * direction_W.y() - direction_W.z()};
  return spline_->FirstBelow(line, max_distance_m);
}

std::optional<double> Ground::MarchRay(const math::Vector3& origin_W,
                                       const math::Vector3& direction_W,
                                       double max_distance_m) const {
  const double horizontal = math::Hypot(direction_W.x(), direction_W.y());
  // gap(t) = z(t) - h(t) = plane_gap - t plane_rate - relief; `rate` is minus its derivative. Where
  // depressions overlap, the gap over the deepest is no less than that over the one at hand, for
  // which the bounds below hold.
  const double plane_gap = origin_W.z() - slope_x_ * origin_W.x() - slope_y_ * origin_W.y();
  const double plane_rate =
      slope_x_ * direction_W.x() + slope_y_ * direction_W.y() - direction_W.z();
  const auto at = [&](double t) -> Approach {
    const ReliefSample relief =
        ReliefAt(origin_W.x() + t * direction_W.x(), origin_W.y() + t * direction_W.y());
    return {plane_gap - t * plane_rate - relief.height_m,
            plane_rate + relief.slope_x * direction_W.x() + relief.slope_y * direction_W.y()};
  };
  // Above the highest that the relief can be there is nothing to meet.
  const ReliefBounds bounds = Bounds();
  const double free_gap = plane_gap - bounds.height_m;
  if (free_gap > 0.0 && free_gap > plane_rate * max_distance_m) return std::nullopt;
  double above = free_gap > 0.0 ? free_gap / plane_rate : 0.0;
  Approach now = at(above);
  if (now.gap_m <= 0.0) return above;
  // Nowhere does the gap close faster than this per metre of ray, nor its rate change by more than
  // bend_per_m per metre: the second derivative along the ray counts the horizontal part twice.
  const double max_rate = plane_rate + bounds.slope * horizontal;
  const double bend_per_m = bounds.curvature_per_m * horizontal * horizontal;
  if (now.gap_m > max_rate * (max_distance_m - above)) return std::nullopt;
  while (above < max_distance_m) {
    // The longer of two steps that are both safe, and never less than a millimetre.
    const double step =
        std::max(SafeStep(now, bend_per_m), std::max(now.gap_m / max_rate, kSmallestStep_m));
    const double next = std::min(above + step, max_distance_m);
    const Approach then = at(next);
    if (then.gap_m <= 0.0) {
      const auto gap_at = [&at](double t) { return at(t).gap_m; };
      return FindCrossing(gap_at, above, now.gap_m, next, then.gap_m);
    }
    above = next;
    now = then;
  }
  return std::nullopt;
}

}  // namespace rockyard::terrain

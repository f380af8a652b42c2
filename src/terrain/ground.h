// The ground between the rocks: a plane with a slope, an optional elevation model, fractal
// roughness, ditches and pits, and its soil. Terrain asks it for all users of its rays; wheels ask
// it directly where they touch the ground.
#pragma once

#include <memory>
#include <optional>

#include "core/random.h"
#include "math/pose.h"
#include "terrain/relief.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

class RoughnessField;   // smooth height field, see relief.h
class ReliefSpline;     // an elevation model, and roughness for many rays, see relief_spline.h
class DepressionField;  // ditches and pits, see relief.h

// How a ray finds rough ground. Both ways lead to the same point within 1e-9 m. kMarch has the bits
// that drives are recorded with; kSpline, which pictures use, takes a thirtieth of its time. Ground
// with ditches or pits is always marched over; other ground on an elevation model never is.
enum class RayWay { kMarch, kSpline };

// An immutable ground. Queries are const and thread-safe; copies share roughness and depressions.
class Ground {
 public:
  Ground();  // flat, z = 0
  // Makes the plane through the origin that rises by tan(slope) along the slope direction, plus
  // elevation model and roughness where there are such, less the ditches and pits. Only roughness
  // draws, from Purpose::kGroundRoughness.
  Ground(const GroundParams& params, core::TrialKey key);

  // Returns the height above the world's z = 0 plane, m.
  double Height(double x_m, double y_m) const {
    const double plane_m = slope_x_ * x_m + slope_y_ * y_m;
    return IsPlane() ? plane_m : plane_m + ReliefAt(x_m, y_m).height_m;
  }
  // Returns the unit normal in W, pointing up.
  math::Vector3 Normal(double x_m, double y_m, RayWay way = RayWay::kMarch) const;
  // Returns whether a ditch or a pit may reach into the disc around (x, y).
  bool HasDepressionNear(double x_m, double y_m, double radius_m) const {
    return depressions_ != nullptr && DepressionsReach(x_m, y_m, radius_m);
  }
  // Returns whether the ground is one plane, so that contacts and rays have closed forms.
  bool IsPlane() const { return is_plane_; }
  const SoilParams& soil() const { return soil_; }

  // Returns the distance along the unit ray to the ground, at most max_distance_m; 0 where the
  // origin lies on or below the ground. It is a closed form on a plane. On other ground kMarch
  // advances by steps that bounds on the height, the slope and the curvature show to be safe, but
  // never by less than 1 mm: a crest cut over less than 1 mm of ray can be missed. The crossing
  // itself is bracketed to 1e-12 m.
  std::optional<double> CastRay(const math::Vector3& origin_W, const math::Vector3& direction_W,
                                double max_distance_m, RayWay way = RayWay::kMarch) const {
    if (!IsPlane()) {
      return BySpline(way) ? SplineRay(origin_W, direction_W, max_distance_m)
                           : MarchRay(origin_W, direction_W, max_distance_m);
    }
    const double gap_m = Gap(origin_W);
    if (gap_m <= 0.0) return 0.0;
    const double descent =
        slope_x_ * direction_W.x() + slope_y_ * direction_W.y() - direction_W.z();
    // Written so that a ray along the plane divides nothing by zero.
    if (gap_m > descent * max_distance_m) return std::nullopt;
    return gap_m / descent;
  }

 private:
  std::optional<double> MarchRay(const math::Vector3& origin_W, const math::Vector3& direction_W,
                                 double max_distance_m) const;
  std::optional<double> SplineRay(const math::Vector3& origin_W, const math::Vector3& direction_W,
                                  double max_distance_m) const;
  bool BySpline(RayWay way) const {
    return spline_ && !depressions_ && (way == RayWay::kSpline || !roughness_);
  }
  bool DepressionsReach(double x_m, double y_m, double radius_m) const;
  // Returns upper bounds over all points of what the plane carries.
  ReliefBounds Bounds() const;
  // Returns what model, roughness and depressions add to the plane.
  ReliefSample ReliefAt(double x_m, double y_m) const;
  // Returns the height of a point above the ground, m.
  double Gap(const math::Vector3& p_W) const { return p_W.z() - Height(p_W.x(), p_W.y()); }

  SoilParams soil_;
  double slope_x_ = 0.0;  // dz/dx
  double slope_y_ = 0.0;  // dz/dy
  bool is_plane_ = true;
  std::shared_ptr<const RoughnessField> roughness_;  // only without a model
  // Of the model, with roughness or without; of roughness alone where there are no depressions.
  std::shared_ptr<const ReliefSpline> spline_;
  std::shared_ptr<const DepressionField> depressions_;
};

}  // namespace rockyard::terrain

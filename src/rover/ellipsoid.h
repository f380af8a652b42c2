// A rock prepared for contact: the nearest point of its ellipsoid in closed form up to one scalar
// root.
#pragma once

#include "math/pose.h"
#include "terrain/rock.h"

namespace rockyard::rover {

struct SurfacePoint {
  math::Vector3 point_W;
  math::Vector3 normal_W;   // outward, unit
  double distance_m = 0.0;  // from the query point; negative inside
};

class Ellipsoid {
 public:
  explicit Ellipsoid(const terrain::Rock& rock);

  const math::Vector3& center_W() const { return center_W_; }
  double bounding_radius_m() const { return bounding_radius_m_; }

  // No more than the distance from p to the surface, at the cost of a scaling; negative inside.
  double DistanceBound(const math::Vector3& p_W) const;

  // The nearest point of the surface. Outside, x_i = a_i^2 p_i / (a_i^2 + t) with the root t >= 0
  // of sum (a_i p_i / (a_i^2 + t))^2 = 1 (Hart 1994, Graphics Gems IV), by Newton's method on one
  // over the norm, to 1e-12. Inside, which contact margins make rare, the point on the ray from the
  // centre.
  SurfacePoint Nearest(const math::Vector3& p_W) const;

 private:
  math::Vector3 ToLocal(const math::Vector3& v_W) const {
    return {cos_ * v_W.x() + sin_ * v_W.y(), -sin_ * v_W.x() + cos_ * v_W.y(), v_W.z()};
  }
  math::Vector3 ToWorld(const math::Vector3& v) const {
    return {cos_ * v.x() - sin_ * v.y(), sin_ * v.x() + cos_ * v.y(), v.z()};
  }

  math::Vector3 center_W_;
  double cos_, sin_;
  math::Vector3 axes_m_;
  math::Vector3 axes_squared_m2_;
  math::Vector3 inverse_axes_per_m_;
  double smallest_axis_m_;
  double bounding_radius_m_;
};

}  // namespace rockyard::rover

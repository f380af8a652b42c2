// A rock prepared for contact: the nearest point of its surface, in closed form up to one scalar
// root. The contact finders of both fidelities ask it. Records depend on the bits of Nearest. The
// multibody asks it for all parts, the quasi-static rover for the body alone, as its wheels go by
// quasi_static/wheel_rock_gap.h.
#pragma once

#include "math/pose.h"
#include "terrain/rock.h"

namespace rockyard::rover {

// A point on a rock's surface, found as the nearest one to a query point.
struct SurfacePoint {
  math::Vector3 point_W;
  math::Vector3 normal_W;   // outward, unit
  double distance_m = 0.0;  // from the query point; negative inside
};

// A rock that stands upright and is turned by its yaw: an ellipsoid, or a cap whose surface goes on
// below its base, where the ground is. Positions are in W, m.
class RockBody {
 public:
  explicit RockBody(const terrain::Rock& rock);

  const math::Vector3& center_W() const { return center_W_; }
  double bounding_radius_m() const { return bounding_radius_m_; }

  // Returns a lower bound of the distance from p to the rock above the ground, m, at the cost of a
  // scaling: negative inside the ellipsoid of its semi-axes.
  double DistanceBound(const math::Vector3& p_W) const;

  // Returns the nearest point of the surface. Outside an ellipsoid, x_i = a_i^2 p_i / (a_i^2 + t)
  // with the root t >= 0 of sum (a_i p_i / (a_i^2 + t))^2 = 1 (Hart 1994, Graphics Gems IV), found
  // by Newton's method on one over the norm, to 1e-12. For caps the root is the depth of x. Inside,
  // which contact margins make rare, it returns the point on the ray from the centre. A point of
  // the surface near the one sought, as start_W, spares steps.
  SurfacePoint Nearest(const math::Vector3& p_W, const math::Vector3* start_W = nullptr) const;

 private:
  SurfacePoint NearestOnCap(const math::Vector3& p_W, const math::Vector3* start_W) const;
  // Returns the point of the cap nearest to a p outside, both in the rock's frame; start_m: its
  // depth below the top, about, or not a number.
  math::Vector3 CapPointFromOutside(const math::Vector3& p, double start_m) const;
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
  // A of a cap, 0 for an ellipsoid. At the depth d below its top, m, a cap is
  // (x/a)^2 + (y/b)^2 = 2 slope d + bend d^2, slope = A / 2 h and bend = (1 - A) / h^2.
  double cap_growth_;
  double slope_per_m_;
  double bend_per_m2_;
};

}  // namespace rockyard::rover

// The one rock geometry that physics, sensors and plots share: an ellipsoid with two horizontal
// axes turned by yaw and one vertical axis, partly below the ground, or a cap that stands on the
// ground (ShapeRock). Beside it: points of rocks for drawings, and what holds a loose rock in the
// soil, which the multibody rover pushes against. Records depend on the bits of ShapeRock,
// RockShape, RockMass and HoldingForce. OnRock, ParallelRadius, PlanOutline and PointsAbove serve
// drawings and captures of scans alone.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "math/functions.h"
#include "math/pose.h"
#include "terrain/rock_params.h"

namespace rockyard::terrain {

struct Rock {
  math::Vector3 center_W = math::Vector3::Zero();     // of the ellipsoid or of a cap's base, m
  math::Vector3 semi_axes_m = math::Vector3::Ones();  // along its own x, y, z; x >= y
  double yaw_rad = 0.0;                               // of the rock's x axis from world x
  // 0 for a whole ellipsoid; for a cap the growth A, 0 < A < 2. At the share s of its height
  // semi_axes_m.z() below its top a cap is as wide as sqrt(A s + (1 - A) s^2) times its base. It
  // lies within the ellipsoid of that centre and those semi-axes.
  double cap_growth = 0.0;
  double diameter_m = 0.0;  // as drawn from the size law: the largest horizontal axis, 2 a
  double height_m = 0.0;    // of the top above the ground at the centre
};

// What a rock's profile does not change. Lengths in m.
struct RockOutline {
  double diameter_m = 0.0;     // 2 a
  double width_ratio = 1.0;    // b / a
  double half_height_m = 0.0;  // c of the rock of pointedness 0, buried part included
  double height_m = 0.0;       // h, of the top above the ground
};

// Returns the rock at the origin, without yaw. Its profile between top and ground goes from a dome,
// the ellipsoid at pointedness 0, to nearly a cone, which would be pointedness 1. Above 0 no more
// than half of the outline's full height may be buried.
//
// In the rock's own frame let rho^2 = (x/a)^2 + (y/b)^2 and s = (top - z) / h, so that s is 0 at
// the top and 1 on the ground. All rocks are quadrics
//   rho^2 = A s + B s^2,   widest part rho = 1,   A = (1 - pointedness) 2 h / c.
// The ellipsoid of vertical semi-axis c has A = 2 h / c and B = -A^2 / 4; with the share beta of
// its full height 2 c below the ground A = 4 (1 - beta). Below A = 2 the widest part of such an
// ellipsoid would lie under the ground; there the outline is kept on the ground instead, B = 1 - A:
// a cap of an ellipsoid down to A = 1, a paraboloid, and of a hyperboloid down to A = 0, a cone.
// All of them are convex. Both fidelities of the rover and the replay page work this surface out
// for themselves from the numbers of Rock: another profile must reach them, too.
Rock ShapeRock(const RockOutline& outline, double pointedness);

// Returns a point, in W, from the coordinates of the rock in which its semi-axes are 1.
math::Vector3 OnRock(const Rock& rock, const math::Vector3& unit);

// Returns how wide the rock is at a height above its centre, both as shares of its semi-axes: 1
// where it is widest, 0 at its top, the height 1.
double ParallelRadius(const Rock& rock, double unit_height);

// Returns an octagon on the outline of the rock seen from above, in W, at the height of its centre.
std::vector<math::Vector3> PlanOutline(const Rock& rock);

// Returns points, in W, spread over the surface above a ground of that height, with the top and a
// ring where the rock leaves the ground. What is seen of a rock lies within their convex hull, but
// for 2 % of its width. Returns none where the ground covers the rock.
std::vector<math::Vector3> PointsAbove(const Rock& rock, double ground_m);

// A rock prepared for queries: the linear map that turns its ellipsoid into the unit sphere, or its
// cap into a cap of radius and height 1. The map is q = diag(1/a, 1/b, 1/c) Rz(-yaw) (p - centre).
// The surface of an ellipsoid is |q| = 1, that of a cap q.x^2 + q.y^2 = A s + (1 - A) s^2 with
// s = 1 - q.z, from 0 to 1.
class RockShape {
 public:
  static constexpr double kNoHit = std::numeric_limits<double>::infinity();

  explicit RockShape(const Rock& rock)
      : center_W_(rock.center_W),
        xx_(math::Cos(rock.yaw_rad) / rock.semi_axes_m.x()),
        xy_(math::Sin(rock.yaw_rad) / rock.semi_axes_m.x()),
        yx_(-math::Sin(rock.yaw_rad) / rock.semi_axes_m.y()),
        yy_(math::Cos(rock.yaw_rad) / rock.semi_axes_m.y()),
        zz_(1.0 / rock.semi_axes_m.z()),
        growth_(rock.cap_growth),
        bend_(1.0 - rock.cap_growth) {}

  // Returns a vector of W in the coordinates in which an ellipsoid is the unit sphere.
  math::Vector3 Map(const math::Vector3& v) const {
    return {xx_ * v.x() + xy_ * v.y(), yx_ * v.x() + yy_ * v.y(), zz_ * v.z()};
  }

  // Returns the distance at which the ray meets the surface from outside: the smaller root of |q +
  // t e| = 1 for the origin q and the direction e in unit-sphere coordinates. It is 0 where the
  // origin lies inside, kNoHit where the ray misses. A cap ends at its base, which no ray meets.
  double Distance(const math::Vector3& origin_W, const math::Vector3& direction_W) const {
    if (growth_ > 0.0) return DistanceToCap(origin_W, direction_W);
    const math::Vector3 q = Map(origin_W - center_W_);
    const math::Vector3 e = Map(direction_W);
    const double outside = q.squaredNorm() - 1.0;
    if (outside <= 0.0) return 0.0;
    // t^2 |e|^2 - 2 t B + K = 0 with B = -q . e and K = |q|^2 - 1 has t = (B - sqrt(B^2 - |e|^2 K))
    // / |e|^2; B <= 0 leads away from the rock.
    const double approach = -q.dot(e);
    if (approach <= 0.0) return kNoHit;
    const double speed = e.squaredNorm();
    const double discriminant = approach * approach - speed * outside;
    if (discriminant < 0.0) return kNoHit;
    return (approach - std::sqrt(discriminant)) / speed;
  }

  // Returns the outward unit normal at a point of the surface: along the gradient of |q|^2 / 2,
  // which is the transposed map of q.
  math::Vector3 Normal(const math::Vector3& p_W) const {
    if (growth_ > 0.0) return CapNormal(p_W);
    const math::Vector3 q = Map(p_W - center_W_);
    return math::Vector3(xx_ * q.x() + yx_ * q.y(), xy_ * q.x() + yy_ * q.y(), zz_ * q.z())
        .normalized();
  }

  // Returns the height of the upper surface over (x, y), m; minus infinity beside the rock.
  double Top(double x_m, double y_m) const {
    const double dx = x_m - center_W_.x();
    const double dy = y_m - center_W_.y();
    const double u = xx_ * dx + xy_ * dy;
    const double v = yx_ * dx + yy_ * dy;
    if (growth_ > 0.0) return CapTop(u * u + v * v);
    const double rest = 1.0 - u * u - v * v;
    return rest < 0.0 ? -kNoHit : center_W_.z() + std::sqrt(rest) / zz_;
  }

 private:
  double DistanceToCap(const math::Vector3& origin_W, const math::Vector3& direction_W) const;
  math::Vector3 CapNormal(const math::Vector3& p_W) const;
  // Returns the top of a cap over a point whose distance from the axis is sqrt(rho2) times the
  // outline's.
  double CapTop(double rho2) const;

  math::Vector3 center_W_;
  double xx_, xy_, yx_, yy_, zz_;
  // A and B of a cap; A is 0 for an ellipsoid.
  double growth_, bend_;
};

// Returns the mass of the whole ellipsoid, kg.
double RockMass(const Rock& rock, double density_kg_m3);

// Returns the largest horizontal force, N, that the soil bears before a rock slides along push_W
// (horizontal; its length does not matter, zero stands for the rock's x axis):
//   mu max(0, m g + load) + 1/2 K gamma d^2 w,   K = tan^2(45 deg + phi / 2),   gamma = rho_soil g:
// Coulomb friction under the rock, load_N being the vertical force that the rover puts on it (down
// positive), and the passive pressure (Rankine 1857, no cohesion) on its front, a wall as deep as
// the rock is buried, d = 2 c - height_m, and as wide as the rock is across the push. The buried
// front of an ellipsoid is smaller than that wall, the wedge that it lifts is wider: neither is
// corrected. The ground is level, and nothing holds the rock from behind.
double HoldingForce(const Rock& rock, const RockHoldingParams& params, double gravity_m_s2,
                    double load_N, const math::Vector3& push_W);

}  // namespace rockyard::terrain

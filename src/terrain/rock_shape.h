// A rock prepared for queries: the linear map that turns its ellipsoid into the unit sphere, or its
// cap into one of radius and height 1.
#pragma once

#include <cmath>
#include <limits>

#include "math/pose.h"
#include "terrain/rock.h"

namespace rockyard::terrain {

// The map is q = diag(1/a, 1/b, 1/c) Rz(-yaw) (p - centre), so that |q| = 1 on the surface of an
// ellipsoid. That of a cap is q.x^2 + q.y^2 = A s + (1 - A) s^2 with s = 1 - q.z, from 0 to 1.
class RockShape {
 public:
  static constexpr double kNoHit = std::numeric_limits<double>::infinity();

  explicit RockShape(const Rock& rock)
      : center_W_(rock.center_W),
        xx_(std::cos(rock.yaw_rad) / rock.semi_axes_m.x()),
        xy_(std::sin(rock.yaw_rad) / rock.semi_axes_m.x()),
        yx_(-std::sin(rock.yaw_rad) / rock.semi_axes_m.y()),
        yy_(std::cos(rock.yaw_rad) / rock.semi_axes_m.y()),
        zz_(1.0 / rock.semi_axes_m.z()),
        growth_(rock.cap_growth),
        bend_(1.0 - rock.cap_growth) {}

  // Returns a vector of W in the coordinates in which an ellipsoid is the unit sphere.
  math::Vector3 Map(const math::Vector3& v) const {
    return {xx_ * v.x() + xy_ * v.y(), yx_ * v.x() + yy_ * v.y(), zz_ * v.z()};
  }

  // Returns the distance along the ray to the surface, which it meets from outside: the smaller
  // root of |q + t e| = 1 for the origin q and the direction e in unit-sphere coordinates. It is 0
  // where the origin lies inside, kNoHit where the ray misses. Nothing of a cap lies below its
  // base.
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

  // Returns the outward unit normal at a point of the surface: the transposed map of q, the
  // gradient of |q|^2 / 2.
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
  // Over a point whose distance from the axis is sqrt(rho2) times the outline's.
  double CapTop(double rho2) const;

  math::Vector3 center_W_;
  double xx_, xy_, yx_, yy_, zz_;
  // A and B of a cap; A is 0 for an ellipsoid.
  double growth_, bend_;
};

}  // namespace rockyard::terrain

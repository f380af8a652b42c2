#include "rover/rock_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/functions.h"

namespace rockyard::rover {

using math::Vector3;

RockBody::RockBody(const terrain::Rock& rock)
    : center_W_(rock.center_W),
      cos_(math::Cos(rock.yaw_rad)),
      sin_(math::Sin(rock.yaw_rad)),
      axes_m_(rock.semi_axes_m),
      axes_squared_m2_(rock.semi_axes_m.cwiseAbs2()),
      inverse_axes_per_m_(rock.semi_axes_m.cwiseInverse()),
      smallest_axis_m_(rock.semi_axes_m.minCoeff()),
      bounding_radius_m_(rock.semi_axes_m.maxCoeff()),
      cap_growth_(rock.cap_growth),
      slope_per_m_(0.5 * rock.cap_growth / rock.semi_axes_m.z()),
      bend_per_m2_((1.0 - rock.cap_growth) / (rock.semi_axes_m.z() * rock.semi_axes_m.z())) {}

double RockBody::DistanceBound(const Vector3& p_W) const {
  // Division by the semi-axes a maps the ellipsoid onto the unit sphere and shrinks no length by
  // more than 1 / min(a), so distance >= (|p / a| - 1) min(a) for points outside. A cap lies within
  // the ellipsoid of its semi-axes, so that the bound holds for it as well.
  const Vector3 u = ToLocal(p_W - center_W_).cwiseProduct(inverse_axes_per_m_);
  return (u.norm() - 1.0) * smallest_axis_m_;
}

SurfacePoint RockBody::Nearest(const Vector3& p_W, const Vector3* start_W) const {
  if (cap_growth_ > 0.0) return NearestOnCap(p_W, start_W);
  // All below is in the rock's frame: origin at its centre, axes along the semi-axes a_i (yaw
  // only).
  const Vector3 p = ToLocal(p_W - center_W_);
  const double scale = p.cwiseProduct(inverse_axes_per_m_).norm();
  Vector3 x;
  // Inside: the ray from the centre meets the surface at p / |p / a|; the centre itself maps to the
  // top.
  if (scale <= 1.0) {
    x = scale > 1e-9 ? Vector3(p / scale) : Vector3(0.0, 0.0, axes_m_.z());
  } else {
    // The nearest point x has p - x = t n' with n'_i = x_i / a_i^2, so x_i = a_i^2 p_i / (a_i^2 +
    // t), and x lies on the surface where F(t) = |u(t)| = 1, u_i = a_i p_i / (a_i^2 + t). At this
    // start one |u_i| is 1, so F >= 1: it is no larger than the root.
    const Vector3 ap = axes_m_.cwiseProduct(p);
    double t = std::max(0.0, (ap.cwiseAbs() - axes_squared_m2_).maxCoeff());
    constexpr int kMostSteps = 20;
    for (int i = 0; i < kMostSteps; ++i) {
      const Vector3 inverse = (axes_squared_m2_.array() + t).inverse().matrix();
      const Vector3 u = ap.cwiseProduct(inverse);
      const double norm2 = u.squaredNorm();
      if (std::abs(norm2 - 1.0) < 1e-12) break;
      // F' = -slope / F with slope = sum u_i^2 / (a_i^2 + t). Newton's method on 1/F - 1, which is
      // nearly linear in t and concave, so that every iterate stays left of the root: dt = F^2 (F -
      // 1) / slope.
      const double slope = u.cwiseAbs2().dot(inverse);
      t += norm2 * (std::sqrt(norm2) - 1.0) / slope;
    }
    x = axes_squared_m2_.cwiseProduct(p).cwiseQuotient((axes_squared_m2_.array() + t).matrix());
  }
  // The gradient of sum (x_i / a_i)^2 is along x_i / a_i^2.
  const Vector3 normal =
      x.cwiseProduct(inverse_axes_per_m_).cwiseProduct(inverse_axes_per_m_).normalized();
  return {center_W_ + ToWorld(x), ToWorld(normal), normal.dot(p - x)};
}

SurfacePoint RockBody::NearestOnCap(const Vector3& p_W, const Vector3* start_W) const {
  // In the rock's frame: origin at the centre of the base.
  const Vector3 p = ToLocal(p_W - center_W_);
  const double rho2 = p.head<2>().cwiseProduct(inverse_axes_per_m_.head<2>()).squaredNorm();
  const double depth_m = axes_m_.z() - p.z();
  Vector3 x;
  if (depth_m < 0.0 || rho2 > (2.0 * slope_per_m_ + bend_per_m2_ * depth_m) * depth_m) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    x = CapPointFromOutside(
        p, start_W != nullptr ? axes_m_.z() - (start_W->z() - center_W_.z()) : kNone);
  } else {
    // Inside: the ray from the centre of the base, or level from the axis below it. With zeta = z /
    // h the point l p lies on the cap where l^2 (rho^2 - B zeta^2) + l zeta (2 - A) = 1.
    const Vector3 from(p.x(), p.y(), std::max(p.z(), 0.0));
    const double zeta = from.z() * inverse_axes_per_m_.z();
    const double sum = zeta * (2.0 - cap_growth_) +
                       std::sqrt(cap_growth_ * cap_growth_ * zeta * zeta + 4.0 * rho2);
    x = sum > 1e-9 ? Vector3(from * (2.0 / sum)) : Vector3(0.0, 0.0, axes_m_.z());
  }
  // The gradient of the equation above, halved.
  const double slope = slope_per_m_ + bend_per_m2_ * (axes_m_.z() - x.z());
  const Vector3 normal =
      Vector3(x.x() / axes_squared_m2_.x(), x.y() / axes_squared_m2_.y(), slope).normalized();
  return {center_W_ + ToWorld(x), ToWorld(normal), normal.dot(p - x)};
}

Vector3 RockBody::CapPointFromOutside(const Vector3& p, double start_m) const {
  // p - x = t n' with n' = (x/a^2, y/b^2, slope + bend d), so that the depth d of x gives
  // t = (d - d_p) / (slope + bend d) and x_i = p_i a_i^2 / (a_i^2 + t). The root d is that of
  //   F(d) = sum (x_i / a_i)^2 - 2 slope d - bend d^2.
  // The rock is convex, so its nearest point is the only root with t >= 0. At the level of p, or at
  // the top, F >= 0. Below p itself F <= 0: the nearest point lies no farther out, hence no deeper.
  const Eigen::Array2d axes2 = axes_squared_m2_.head<2>().array();
  const Eigen::Array2d level = p.head<2>().array();
  const double depth_p_m = axes_m_.z() - p.z();
  double low_m = std::max(0.0, depth_p_m);
  // high_m: the depth where F = 0 for t = 0, or where the slope of an ellipsoid ends, at which it
  // is widest.
  const double rho2 = (level.square() / axes2).sum();
  const double square = slope_per_m_ * slope_per_m_ + bend_per_m2_ * rho2;
  double high_m =
      square > 0.0 ? rho2 / (slope_per_m_ + std::sqrt(square)) : -slope_per_m_ / bend_per_m2_;
  high_m = std::max(high_m, low_m);
  const bool started = start_m >= low_m && start_m <= high_m;
  double depth_m = started ? start_m : 0.5 * (low_m + high_m);
  Eigen::Array2d x = level;
  constexpr int kMostSteps = 50;
  constexpr double kFound_m = 1e-9;
  for (int i = 0; i < kMostSteps; ++i) {
    const double slope = slope_per_m_ + bend_per_m2_ * depth_m;
    const double t = (depth_m - depth_p_m) / slope;
    const Eigen::Array2d stretch = axes2 + t;
    x = level * axes2 / stretch;
    const Eigen::Array2d u2 = x.square() / axes2;
    const double F = u2.sum() - (2.0 * slope_per_m_ + bend_per_m2_ * depth_m) * depth_m;
    (F > 0.0 ? low_m : high_m) = depth_m;
    // dt/dd = (slope + bend d_p) / (slope + bend d)^2 and dx_i/dt = -x_i / (a_i^2 + t).
    const double t_slope = (slope_per_m_ + bend_per_m2_ * depth_p_m) / (slope * slope);
    const double F_slope = -2.0 * (t_slope * (u2 / stretch).sum() + slope);
    double next_m = depth_m - F / F_slope;
    // Newton's method, or the middle of the interval that holds the root where Newton's step leaves
    // it. The test is written so that a step that is not a number counts as leaving it.
    if (!(next_m >= low_m && next_m <= high_m)) next_m = 0.5 * (low_m + high_m);
    const double step_m = std::abs(next_m - depth_m);
    depth_m = next_m;
    if (step_m < kFound_m) break;
  }
  const double t = (depth_m - depth_p_m) / (slope_per_m_ + bend_per_m2_ * depth_m);
  x = level * axes2 / (axes2 + t);
  return {x.x(), x.y(), axes_m_.z() - depth_m};
}

}  // namespace rockyard::rover

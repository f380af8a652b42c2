#include "rover/ellipsoid.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {

using math::Vector3;

Ellipsoid::Ellipsoid(const terrain::Rock& rock)
    : center_W_(rock.center_W),
      cos_(std::cos(rock.yaw_rad)),
      sin_(std::sin(rock.yaw_rad)),
      axes_m_(rock.semi_axes_m),
      axes_squared_m2_(rock.semi_axes_m.cwiseAbs2()),
      inverse_axes_per_m_(rock.semi_axes_m.cwiseInverse()),
      smallest_axis_m_(rock.semi_axes_m.minCoeff()),
      bounding_radius_m_(rock.semi_axes_m.maxCoeff()) {}

double Ellipsoid::DistanceBound(const Vector3& p_W) const {
  // Division by the semi-axes a maps the ellipsoid onto the unit sphere and shrinks no length by
  // more than 1 / min(a), so distance >= (|p / a| - 1) min(a) for points outside.
  const Vector3 u = ToLocal(p_W - center_W_).cwiseProduct(inverse_axes_per_m_);
  return (u.norm() - 1.0) * smallest_axis_m_;
}

SurfacePoint Ellipsoid::Nearest(const Vector3& p_W) const {
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
    constexpr int kMaxIterations = 20;
    for (int i = 0; i < kMaxIterations; ++i) {
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

}  // namespace rockyard::rover

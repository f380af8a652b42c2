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
  const Vector3 u = ToLocal(p_W - center_W_).cwiseProduct(inverse_axes_per_m_);
  return (u.norm() - 1.0) * smallest_axis_m_;
}

SurfacePoint Ellipsoid::Nearest(const Vector3& p_W) const {
  const Vector3 p = ToLocal(p_W - center_W_);
  const double scale = p.cwiseProduct(inverse_axes_per_m_).norm();
  Vector3 x;
  if (scale <= 1.0) {
    x = scale > 1e-9 ? Vector3(p / scale) : Vector3(0.0, 0.0, axes_m_.z());
  } else {
    const Vector3 ap = axes_m_.cwiseProduct(p);
    double t = std::max(0.0, (ap.cwiseAbs() - axes_squared_m2_).maxCoeff());
    constexpr int kMaxIterations = 20;
    for (int i = 0; i < kMaxIterations; ++i) {
      const Vector3 inverse = (axes_squared_m2_.array() + t).inverse().matrix();
      const Vector3 u = ap.cwiseProduct(inverse);
      const double norm2 = u.squaredNorm();
      if (std::abs(norm2 - 1.0) < 1e-12) break;
      const double slope = u.cwiseAbs2().dot(inverse);
      t += norm2 * (std::sqrt(norm2) - 1.0) / slope;
    }
    x = axes_squared_m2_.cwiseProduct(p).cwiseQuotient((axes_squared_m2_.array() + t).matrix());
  }
  const Vector3 normal =
      x.cwiseProduct(inverse_axes_per_m_).cwiseProduct(inverse_axes_per_m_).normalized();
  return {center_W_ + ToWorld(x), ToWorld(normal), normal.dot(p - x)};
}

}  // namespace rockyard::rover

// Closed-form eigenvalues of a symmetric 3 x 3 matrix.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "math/pose.h"

namespace rockyard::math {

struct SymmetricMatrix3 {
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
};

struct SymmetricEigen3 {
  std::array<double, 3> values{};            // ascending
  Vector3 smallest_axis = Vector3::UnitZ();  // unit eigenvector of values[0], of either sign
};

namespace internal {

// cos(acos(t)/3) for t in [0, 1]: the root in [cos 30 deg, 1] of 4 c^3 - 3 c = t. The slope
// 12 c^2 - 3 lies in [6, 9] there, so that two Newton steps from a cubic that is off by 4.1e-5 at
// most (interpolation at Chebyshev points) leave rounding alone. Without libm, whose cosine differs
// between processors in its last bit.
inline double CosOfThird(double t) {
  double c = 0.866066 + t * (0.16533 + t * (-0.040691 + t * 0.00932));
  for (int step = 0; step < 2; ++step) c = (8.0 * c * c * c + t) / (12.0 * c * c - 3.0);
  return c;
}

// The unit vector v of a matrix k v v^T, k > 0: its column with the largest diagonal element.
inline Vector3 AxisOf(const SymmetricMatrix3& m) {
  Vector3 column(m.xz, m.yz, m.zz);
  if (m.xx > m.zz && m.xx >= m.yy) {
    column = Vector3(m.xx, m.xy, m.xz);
  } else if (m.yy > m.zz) {
    column = Vector3(m.xy, m.yy, m.yz);
  }
  const double square =
      (column.x() * column.x() + column.y() * column.y()) + column.z() * column.z();
  return column * (1.0 / std::sqrt(square));
}

// The adjugate of m - mu I.
inline SymmetricMatrix3 AdjugateLess(const SymmetricMatrix3& m, double mu) {
  const double xx = m.xx - mu;
  const double yy = m.yy - mu;
  const double zz = m.zz - mu;
  return {yy * zz - m.yz * m.yz,   xx * zz - m.xz * m.xz,   xx * yy - m.xy * m.xy,
          m.xz * m.yz - m.xy * zz, m.xy * m.yz - m.xz * yy, m.xy * m.xz - m.yz * xx};
}

// factor m + identity I + projector v v^T.
inline SymmetricMatrix3 Combine(double factor, const SymmetricMatrix3& m, double identity,
                                double projector, const Vector3& v) {
  return {factor * m.xx + (identity + projector * (v.x() * v.x())),
          factor * m.yy + (identity + projector * (v.y() * v.y())),
          factor * m.zz + (identity + projector * (v.z() * v.z())),
          factor * m.xy + projector * (v.x() * v.y()),
          factor * m.xz + projector * (v.x() * v.z()),
          factor * m.yz + projector * (v.y() * v.z())};
}

inline SymmetricMatrix3 Scaled(double factor, const SymmetricMatrix3& m) {
  return {factor * m.xx, factor * m.yy, factor * m.zz, factor * m.xy, factor * m.xz, factor * m.yz};
}

// Sum of the squares of all nine elements.
inline double SquareNorm(const SymmetricMatrix3& m) {
  return ((m.xx * m.xx + m.yy * m.yy) + m.zz * m.zz) +
         2.0 * ((m.xz * m.xz + m.yz * m.yz) + m.xy * m.xy);
}

// Of a matrix with trace 0 and square norm 6: its eigenvalues are 2 cos(phi + 2 k pi/3) with
// cos(3 phi) = det/2. One of them, mu, lies at least 1.7 from both others, is well conditioned, and
// has the adjugate of m - mu I as projector on its axis v. What m does across v, less its mean
// there, has the eigenvalues +-half: found as a norm, so that close eigenvalues stay accurate.
inline SymmetricEigen3 NormalizedEigen(const SymmetricMatrix3& m) {
  const double det = (m.zz * (m.xx * m.yy - m.xy * m.xy) + 2.0 * (m.xy * (m.xz * m.yz))) -
                     (m.xx * (m.yz * m.yz) + m.yy * (m.xz * m.xz));
  const double mu = std::copysign(2.0 * CosOfThird(std::min(1.0, std::abs(0.5 * det))), det);
  const Vector3 v = AxisOf(AdjugateLess(m, mu));
  const SymmetricMatrix3 across = Combine(1.0, m, 0.5 * mu, -1.5 * mu, v);
  const double half = std::sqrt(0.5 * SquareNorm(across));
  if (mu < 0.0) return {{mu, -0.5 * mu - half, -0.5 * mu + half}, v};
  // half (I - v v^T) - across projects on the axis of the smallest. Rounding tilts it towards v
  // where the two others are close, so that part is taken out; where they are equal but for
  // rounding any axis across v serves.
  const bool equal = !(half > 4e-15);
  Vector3 axis =
      AxisOf(equal ? Combine(0.0, m, 1.0, -1.0, v) : Combine(-1.0, across, half, -half, v));
  axis -= axis.dot(v) * v;
  return {{-0.5 * mu - half, -0.5 * mu + half, mu}, axis.normalized()};
}

}  // namespace internal

// Eigenvalues, each to about 1e-15 of the largest magnitude among the elements, and the axis of the
// smallest. Elements must be finite and below 1e300; matrices below 1e-300 count as zero. Where the
// smallest eigenvalue is not simple the axis is one of many. Swapping x and y swaps the result bit
// for bit but where two directions are equally good. About 60 flops, three roots, no libm.
inline SymmetricEigen3 EigenOf(const SymmetricMatrix3& m) {
  const double scale = std::max({std::abs(m.xx), std::abs(m.yy), std::abs(m.zz), std::abs(m.xy),
                                 std::abs(m.xz), std::abs(m.yz)});
  if (!(scale > 1e-300)) return {};
  const double inverse = 1.0 / scale;
  const double mean = ((m.xx * inverse + m.yy * inverse) + m.zz * inverse) / 3.0;
  const SymmetricMatrix3 deviator{m.xx * inverse - mean, m.yy * inverse - mean,
                                  m.zz * inverse - mean, m.xy * inverse,
                                  m.xz * inverse,        m.yz * inverse};
  const double spread = std::sqrt(internal::SquareNorm(deviator) / 6.0);
  if (!(spread > 1e-30)) return {{scale * mean, scale * mean, scale * mean}, Vector3::UnitZ()};
  SymmetricEigen3 eigen = internal::NormalizedEigen(internal::Scaled(1.0 / spread, deviator));
  for (double& value : eigen.values) value = scale * (mean + spread * value);
  return eigen;
}

}  // namespace rockyard::math

// Closed-form eigenvalues of symmetric 3 x 3 matrices, two at a time.
#pragma once

#include <array>

#include "math/pair.h"
#include "math/pose.h"

namespace rockyard::math {

template <typename Number>
struct SymmetricMatrix {
  Number xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
};
using SymmetricMatrix3 = SymmetricMatrix<double>;
using SymmetricMatrixPair = SymmetricMatrix<Pair>;

struct PairVector {
  Pair x, y, z;
};

struct SymmetricEigenPair {
  Pair smallest, middle, largest;  // eigenvalues
  PairVector smallest_axis;        // unit eigenvectors of the smallest, of either sign
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
inline Pair CosOfThird(Pair t) {
  Pair c = 0.866066 + t * (0.16533 + t * (-0.040691 + t * 0.00932));
  for (int step = 0; step < 2; ++step) c = (8.0 * c * c * c + t) / (12.0 * c * c - 3.0);
  return c;
}

inline PairVector Normalized(const PairVector& v) {
  const Pair inverse = 1.0 / Sqrt((v.x * v.x + v.y * v.y) + v.z * v.z);
  return {v.x * inverse, v.y * inverse, v.z * inverse};
}

// Returns the unit vector v of a matrix k v v^T, k > 0: its column with the largest diagonal
// element.
inline PairVector AxisOf(const SymmetricMatrixPair& m) {
  const auto use_x = (m.xx > m.zz) & (m.xx >= m.yy);
  const auto use_y = ~use_x & (m.yy > m.zz);
  return Normalized({use_x ? m.xx : (use_y ? m.xy : m.xz), use_x ? m.xy : (use_y ? m.yy : m.yz),
                     use_x ? m.xz : (use_y ? m.yz : m.zz)});
}

// Returns the adjugate of m - mu I.
inline SymmetricMatrixPair AdjugateLess(const SymmetricMatrixPair& m, Pair mu) {
  const Pair xx = m.xx - mu;
  const Pair yy = m.yy - mu;
  const Pair zz = m.zz - mu;
  return {yy * zz - m.yz * m.yz,   xx * zz - m.xz * m.xz,   xx * yy - m.xy * m.xy,
          m.xz * m.yz - m.xy * zz, m.xy * m.yz - m.xz * yy, m.xy * m.xz - m.yz * xx};
}

// Returns factor m + identity I + projector v v^T.
inline SymmetricMatrixPair Combine(Pair factor, const SymmetricMatrixPair& m, Pair identity,
                                   Pair projector, const PairVector& v) {
  return {factor * m.xx + (identity + projector * (v.x * v.x)),
          factor * m.yy + (identity + projector * (v.y * v.y)),
          factor * m.zz + (identity + projector * (v.z * v.z)),
          factor * m.xy + projector * (v.x * v.y),
          factor * m.xz + projector * (v.x * v.z),
          factor * m.yz + projector * (v.y * v.z)};
}

// Returns the sum of the squares of all nine elements.
inline Pair SquareNorm(const SymmetricMatrixPair& m) {
  return ((m.xx * m.xx + m.yy * m.yy) + m.zz * m.zz) +
         2.0 * ((m.xz * m.xz + m.yz * m.yz) + m.xy * m.xy);
}

// Returns, for `m` with the eigenvalues mu > 0 (axis v) and -mu/2 +- half, the axis of the
// smallest. half (I - v v^T) - across projects on it. Rounding tilts it towards v where the two
// others are close, so that part is taken out; where they are equal but for rounding any axis
// across v serves.
inline PairVector SmallestAcross(const SymmetricMatrixPair& across, Pair half,
                                 const PairVector& v) {
  const auto equal = ~(half > 4e-15);
  const Pair size = equal ? Both(1.0) : half;
  const PairVector axis = AxisOf(Combine(equal ? Both(0.0) : Both(-1.0), across, size, -size, v));
  const Pair along = (axis.x * v.x + axis.y * v.y) + axis.z * v.z;
  return Normalized({axis.x - along * v.x, axis.y - along * v.y, axis.z - along * v.z});
}

// Solves matrices with trace 0 and square norm 6: their eigenvalues are 2 cos(phi + 2 k pi/3) with
// cos(3 phi) = det/2. One of them, mu, lies at least 1.7 from both others, is well conditioned, and
// has the adjugate of m - mu I as projector on its axis v. What m does across v, less its mean
// there, has the eigenvalues +-half: found as a norm, so that close eigenvalues stay accurate.
inline SymmetricEigenPair NormalizedEigen(const SymmetricMatrixPair& m) {
  const Pair det = (m.zz * (m.xx * m.yy - m.xy * m.xy) + 2.0 * (m.xy * (m.xz * m.yz))) -
                   (m.xx * (m.yz * m.yz) + m.yy * (m.xz * m.xz));
  const Pair size = 2.0 * CosOfThird(Min(Both(1.0), Abs(0.5 * det)));
  const auto positive = det > 0.0;
  const Pair mu = positive ? size : -size;
  const PairVector v = AxisOf(AdjugateLess(m, mu));
  const SymmetricMatrixPair across = Combine(Both(1.0), m, 0.5 * mu, -1.5 * mu, v);
  const Pair half = Sqrt(0.5 * SquareNorm(across));
  const Pair lower = -0.5 * mu - half;
  const Pair upper = -0.5 * mu + half;
  SymmetricEigenPair eigen{positive ? lower : mu, positive ? upper : lower, positive ? mu : upper,
                           v};
  if (positive[0] == 0 && positive[1] == 0) return eigen;
  const PairVector other = SmallestAcross(across, half, v);
  eigen.smallest_axis = {positive ? other.x : v.x, positive ? other.y : v.y,
                         positive ? other.z : v.z};
  return eigen;
}

}  // namespace internal

// Returns the eigenvalues, each to about 4e-15 of the largest magnitude among the elements, and the
// axis of the smallest. Elements must be finite and below 1e300; matrices below 1e-300 count as
// zero. Where the smallest eigenvalue is not simple the axis is one of many: z for a multiple of
// the identity. Swapping x and y swaps the result bit for bit but where two directions are equally
// good. Cost: about 150 flops and three roots a matrix, about 200 and five where the largest
// eigenvalue is the one apart.
inline SymmetricEigenPair EigenOf(const SymmetricMatrixPair& m) {
  const Pair scale =
      Max(Max(Max(Abs(m.xx), Abs(m.yy)), Max(Abs(m.zz), Abs(m.xy))), Max(Abs(m.xz), Abs(m.yz)));
  const auto is_zero = ~(scale > 1e-300);
  const Pair inverse = is_zero ? Both(0.0) : 1.0 / scale;
  const Pair mean = ((m.xx * inverse + m.yy * inverse) + m.zz * inverse) / 3.0;
  const SymmetricMatrixPair deviator{m.xx * inverse - mean, m.yy * inverse - mean,
                                     m.zz * inverse - mean, m.xy * inverse,
                                     m.xz * inverse,        m.yz * inverse};
  const Pair spread = Sqrt(internal::SquareNorm(deviator) / 6.0);
  const auto is_round = ~(spread > 1e-30);
  const Pair stretch = is_round ? Both(0.0) : 1.0 / spread;
  SymmetricEigenPair eigen = internal::NormalizedEigen(
      {stretch * deviator.xx, stretch * deviator.yy, stretch * deviator.zz, stretch * deviator.xy,
       stretch * deviator.xz, stretch * deviator.yz});
  eigen.smallest = scale * (mean + spread * eigen.smallest);
  eigen.middle = scale * (mean + spread * eigen.middle);
  eigen.largest = scale * (mean + spread * eigen.largest);
  return eigen;
}

inline SymmetricEigen3 EigenOf(const SymmetricMatrix3& m) {
  const SymmetricEigenPair eigen = EigenOf(
      SymmetricMatrixPair{Both(m.xx), Both(m.yy), Both(m.zz), Both(m.xy), Both(m.xz), Both(m.yz)});
  const PairVector& axis = eigen.smallest_axis;
  return {{eigen.smallest[0], eigen.middle[0], eigen.largest[0]},
          Vector3(axis.x[0], axis.y[0], axis.z[0])};
}

}  // namespace rockyard::math

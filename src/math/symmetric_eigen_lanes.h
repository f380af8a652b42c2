// Closed-form eigenvalues of symmetric 3 x 3 matrices, as many at a time as a Number has lanes
// (math/lanes.h), for fits of planes. Must not include Eigen or containers: files that are compiled
// for wider registers include this header, and the linker could give their code to other files.
//
// Must stay without libm and in the order of its operations: the normals of planes, and with them
// the records of drives, have the same bits on every processor.
#pragma once

#include "math/lanes.h"

namespace rockyard::math {

template <typename Number>
struct SymmetricMatrix {
  Number xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
};

template <typename Number>
struct LaneVector {
  Number x, y, z;
};

// Whether the axis of the smallest eigenvalue is asked for.
enum class EigenParts { kValues, kValuesAndAxis };

template <typename Number>
struct SymmetricEigenLanes {
  Number smallest, middle, largest;  // eigenvalues
  LaneVector<Number> smallest_axis;  // unit eigenvector of the smallest, of either sign
};

namespace internal {

// Returns cos(acos(t)/3) for t in [0, 1]: the root in [cos 30 deg, 1] of 4 c^3 - 3 c = t. The slope
// 12 c^2 - 3 lies in [6, 9] there, so that two Newton steps from a cubic that is off by 4.1e-5 at
// most (interpolation at Chebyshev points) leave rounding alone. The cosine of libm would differ
// between processors in its last bit.
template <typename Number>
Number CosOfThird(Number t) {
  Number c = 0.866066 + t * (0.16533 + t * (-0.040691 + t * 0.00932));
  for (int step = 0; step < 2; ++step) c = (8.0 * c * c * c + t) / (12.0 * c * c - 3.0);
  return c;
}

template <typename Number>
LaneVector<Number> Normalized(const LaneVector<Number>& v) {
  const Number inverse = 1.0 / Sqrt((v.x * v.x + v.y * v.y) + v.z * v.z);
  return {v.x * inverse, v.y * inverse, v.z * inverse};
}

// Returns the unit vector v of a matrix k v v^T, k > 0: its column with the largest diagonal
// element. Must stay: of equal elements z goes first, then x. Normals of planes depend on it.
template <typename Number>
LaneVector<Number> AxisOf(const SymmetricMatrix<Number>& m) {
  const auto use_x = (m.xx > m.zz) & (m.xx >= m.yy);
  const auto use_y = ~use_x & (m.yy > m.zz);
  const auto column = [&](const Number& x, const Number& y, const Number& z) {
    return Select(use_x, x, Select(use_y, y, z));
  };
  return Normalized<Number>(
      {column(m.xx, m.xy, m.xz), column(m.xy, m.yy, m.yz), column(m.xz, m.yz, m.zz)});
}

// Returns the adjugate of m - mu I.
template <typename Number>
SymmetricMatrix<Number> AdjugateLess(const SymmetricMatrix<Number>& m, Number mu) {
  const Number xx = m.xx - mu;
  const Number yy = m.yy - mu;
  const Number zz = m.zz - mu;
  return {yy * zz - m.yz * m.yz,   xx * zz - m.xz * m.xz,   xx * yy - m.xy * m.xy,
          m.xz * m.yz - m.xy * zz, m.xy * m.yz - m.xz * yy, m.xy * m.xz - m.yz * xx};
}

// Returns factor m + identity I + projector v v^T.
template <typename Number>
SymmetricMatrix<Number> Combine(Number factor, const SymmetricMatrix<Number>& m, Number identity,
                                Number projector, const LaneVector<Number>& v) {
  return {factor * m.xx + (identity + projector * (v.x * v.x)),
          factor * m.yy + (identity + projector * (v.y * v.y)),
          factor * m.zz + (identity + projector * (v.z * v.z)),
          factor * m.xy + projector * (v.x * v.y),
          factor * m.xz + projector * (v.x * v.z),
          factor * m.yz + projector * (v.y * v.z)};
}

// Returns the sum of the squares of all nine elements.
template <typename Number>
Number SquareNorm(const SymmetricMatrix<Number>& m) {
  return ((m.xx * m.xx + m.yy * m.yy) + m.zz * m.zz) +
         2.0 * ((m.xz * m.xz + m.yz * m.yz) + m.xy * m.xy);
}

// Returns the axis of the smallest eigenvalue of a matrix with the eigenvalues mu > 0 (axis v) and
// -mu/2 +- half; `across` is what the matrix does across v, less its mean there. half (I - v v^T) -
// across projects on the axis. Where the other two eigenvalues are close, rounding tilts the axis
// towards v, so that its part along v is taken out. Where they are equal but for rounding, any axis
// across v serves.
template <typename Number>
LaneVector<Number> SmallestAcross(const SymmetricMatrix<Number>& across, Number half,
                                  const LaneVector<Number>& v) {
  const auto equal = ~(half > 4e-15);
  const Number size = Select(equal, All<Number>(1.0), half);
  const LaneVector<Number> axis = AxisOf(
      Combine<Number>(Select(equal, All<Number>(0.0), All<Number>(-1.0)), across, size, -size, v));
  const Number along = (axis.x * v.x + axis.y * v.y) + axis.z * v.z;
  return Normalized<Number>({axis.x - along * v.x, axis.y - along * v.y, axis.z - along * v.z});
}

// Solves matrices with trace 0 and square norm 6: their eigenvalues are 2 cos(phi + 2 k pi/3) with
// cos(3 phi) = det/2. One of them, mu, lies at least 1.7 from both others and is well conditioned;
// the adjugate of m - mu I is, up to a factor, the projector on its axis v. What m does across v,
// less its mean there, has the eigenvalues +-half. `half` is found as a norm, so that close
// eigenvalues stay accurate.
template <EigenParts kParts, typename Number>
SymmetricEigenLanes<Number> NormalizedEigen(const SymmetricMatrix<Number>& m) {
  const Number det = (m.zz * (m.xx * m.yy - m.xy * m.xy) + 2.0 * (m.xy * (m.xz * m.yz))) -
                     (m.xx * (m.yz * m.yz) + m.yy * (m.xz * m.xz));
  const Number size = 2.0 * CosOfThird(Min(All<Number>(1.0), Abs(0.5 * det)));
  const auto positive = det > 0.0;
  const Number mu = Select<Number>(positive, size, -size);
  const LaneVector<Number> v = AxisOf(AdjugateLess(m, mu));
  const SymmetricMatrix<Number> across =
      Combine<Number>(All<Number>(1.0), m, 0.5 * mu, -1.5 * mu, v);
  const Number half = Sqrt(0.5 * SquareNorm(across));
  const Number lower = -0.5 * mu - half;
  const Number upper = -0.5 * mu + half;
  SymmetricEigenLanes<Number> eigen{Select(positive, lower, mu), Select(positive, upper, lower),
                                    Select(positive, mu, upper), v};
  if (kParts == EigenParts::kValues || !Any(positive)) return eigen;
  const LaneVector<Number> other = SmallestAcross(across, half, v);
  eigen.smallest_axis = {Select(positive, other.x, v.x), Select(positive, other.y, v.y),
                         Select(positive, other.z, v.z)};
  return eigen;
}

}  // namespace internal

// Returns the eigenvalues, each to about 4e-15 of the largest magnitude among the elements, and the
// axis of the smallest. Magnitudes of elements must be below 1e300; where all are below
// 1e-300 the matrix counts as zero. Where the smallest eigenvalue is not simple the axis is one of
// many: z for a multiple of the identity. With kValues the axis is undefined. Swapping x and y
// swaps the result bit for bit, except where two directions are equally good. Cost: about 150 flops
// and three roots a matrix, about 200 flops and five roots where the largest eigenvalue is the one
// apart.
template <EigenParts kParts = EigenParts::kValuesAndAxis, typename Number>
SymmetricEigenLanes<Number> EigenOf(const SymmetricMatrix<Number>& m) {
  const Number scale =
      Max(Max(Max(Abs(m.xx), Abs(m.yy)), Max(Abs(m.zz), Abs(m.xy))), Max(Abs(m.xz), Abs(m.yz)));
  const auto is_zero = ~(scale > 1e-300);
  const Number inverse = Select<Number>(is_zero, All<Number>(0.0), 1.0 / scale);
  const Number mean = ((m.xx * inverse + m.yy * inverse) + m.zz * inverse) / 3.0;
  const SymmetricMatrix<Number> deviator{m.xx * inverse - mean, m.yy * inverse - mean,
                                         m.zz * inverse - mean, m.xy * inverse,
                                         m.xz * inverse,        m.yz * inverse};
  const Number spread = Sqrt(internal::SquareNorm(deviator) / 6.0);
  const auto is_round = ~(spread > 1e-30);
  const Number stretch = Select<Number>(is_round, All<Number>(0.0), 1.0 / spread);
  SymmetricEigenLanes<Number> eigen = internal::NormalizedEigen<kParts, Number>(
      {stretch * deviator.xx, stretch * deviator.yy, stretch * deviator.zz, stretch * deviator.xy,
       stretch * deviator.xz, stretch * deviator.yz});
  eigen.smallest = scale * (mean + spread * eigen.smallest);
  eigen.middle = scale * (mean + spread * eigen.middle);
  eigen.largest = scale * (mean + spread * eigen.largest);
  return eigen;
}

}  // namespace rockyard::math

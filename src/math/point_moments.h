// Sums over points from which planes are fitted: the ten moments of Goldberg 2002, section 4, step
// 2. The cells of GESTALT's maps hold them. Records of drives with such a map depend on the bits of
// Spread and Merged, but not on the order in which points are added.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/pose.h"
#include "math/symmetric_eigen.h"

namespace rockyard::math {

// Coordinates enter the moments in whole micrometres: far finer than any range sensor, and whole
// numbers add up exactly in every order. Maps and records depend on the unit; Spread and
// CovarianceOf in spread_lanes.h have its square, 1e-12, as a number.
inline constexpr double kMomentUnitsPerMetre = 1e6;

// Returns a coordinate to the nearest unit, halves away from zero: mirrored points have mirrored
// coordinates. The coordinate must be smaller than 9e12 m.
inline std::int64_t ToMomentUnits(double coordinate_m) {
  return static_cast<std::int64_t>(coordinate_m * kMomentUnitsPerMetre +
                                   std::copysign(0.5, coordinate_m));
}

// Count, mean and covariance (with the count as divisor) of points.
struct PointSpread {
  std::int64_t count = 0;
  Vector3 mean_m = Vector3::Zero();
  SymmetricMatrix3 covariance_m2;
};

// The number of points, the sums of their coordinates and the sums of the products of coordinates,
// about the origin of the frame, modulo 2^64. Sums may pass 2^64 (squares do from 4 km on): what is
// derived from them is exact nevertheless while
//   the absolute sum of a coordinate stays below 2^63 um (9e12 m), and
//   count times the mean square distance from the mean stays below 2^63 um^2 (9e6 m^2).
struct PointMoments {
  enum Index { kCount, kX, kY, kZ, kXX, kYY, kZZ, kXY, kXZ, kYZ, kSize };
  std::array<std::uint64_t, kSize> sums{};

  std::int64_t count() const { return static_cast<std::int64_t>(sums[kCount]); }
  bool empty() const { return sums[kCount] == 0; }

  // Takes a point, its coordinates in moment units.
  void AddPoint(std::int64_t x, std::int64_t y, std::int64_t z) {
    const auto ux = static_cast<std::uint64_t>(x);
    const auto uy = static_cast<std::uint64_t>(y);
    const auto uz = static_cast<std::uint64_t>(z);
    sums[kCount] += 1;
    sums[kX] += ux;
    sums[kY] += uy;
    sums[kZ] += uz;
    sums[kXX] += ux * ux;
    sums[kYY] += uy * uy;
    sums[kZZ] += uz * uz;
    sums[kXY] += ux * uy;
    sums[kXZ] += ux * uz;
    sums[kYZ] += uy * uz;
  }

  PointMoments& operator+=(const PointMoments& other) {
    for (std::size_t i = 0; i < kSize; ++i) sums[i] += other.sums[i];
    return *this;
  }
  // Takes back what += of `other` has added.
  PointMoments& operator-=(const PointMoments& other) {
    for (std::size_t i = 0; i < kSize; ++i) sums[i] -= other.sums[i];
    return *this;
  }
  bool operator==(const PointMoments&) const = default;

  // Returns the mean height of the points. There must be one.
  double MeanZ_m() const {
    return static_cast<double>(static_cast<std::int64_t>(sums[kZ])) / static_cast<double>(count()) /
           kMomentUnitsPerMetre;
  }
};

// So many points have exact moments wherever they are, if they span less than 23 m along each axis:
// their mean square distance from the mean is at most (23/2 m)^2, and 65536 times that is 8.7e6
// m^2.
inline constexpr std::int64_t kExactPoints = 65536;

// Returns mean and covariance; there must be a point. The second moments are shifted in whole
// numbers to the unit next to the mean before anything is rounded, so that nothing cancels however
// far the origin is. CovarianceOf in spread_lanes.h must have the same operations in the same
// order, as both must give the same bits.
inline PointSpread Spread(const PointMoments& moments) {
  using M = PointMoments;
  const auto& s = moments.sums;
  const double inverse_count = 1.0 / static_cast<double>(moments.count());
  std::array<std::uint64_t, 3> near{};  // the unit next to the mean
  std::array<std::uint64_t, 3> rest{};  // sums about it
  std::array<double, 3> offset{};       // of the mean from it
  for (std::size_t i = 0; i < 3; ++i) {
    const double mean =
        static_cast<double>(static_cast<std::int64_t>(s[M::kX + i])) * inverse_count;
    near[i] = static_cast<std::uint64_t>(static_cast<std::int64_t>(mean));
    rest[i] = s[M::kX + i] - s[M::kCount] * near[i];
    offset[i] = static_cast<double>(static_cast<std::int64_t>(rest[i])) * inverse_count;
  }
  const auto covariance = [&](std::size_t product, std::size_t i, std::size_t j) {
    // sum (x_i - near_i)(x_j - near_j) = sum x_i x_j - near_i sum x_j - near_j sum (x_i - near_i),
    // all modulo 2^64. The product of both offsets of the mean is then taken away.
    const std::uint64_t about_near = s[product] - near[i] * s[M::kX + j] - near[j] * rest[i];
    const double square = static_cast<double>(static_cast<std::int64_t>(about_near));
    return (square * inverse_count - offset[i] * offset[j]) * 1e-12;
  };
  PointSpread spread;
  spread.count = moments.count();
  for (std::size_t i = 0; i < 3; ++i) {
    const double mean = static_cast<double>(static_cast<std::int64_t>(near[i])) + offset[i];
    spread.mean_m(static_cast<Eigen::Index>(i)) = mean / kMomentUnitsPerMetre;
  }
  spread.covariance_m2 = {covariance(M::kXX, 0, 0), covariance(M::kYY, 1, 1),
                          covariance(M::kZZ, 2, 2), covariance(M::kXY, 0, 1),
                          covariance(M::kXZ, 0, 2), covariance(M::kYZ, 1, 2)};
  return spread;
}

// Returns the spread of all points of several sets, in floating point: for sets whose sum is past
// the bound of PointMoments while each set is not. There must be a point. With n_i, m_i and C_i of
// each set and d_i = m_i - mean: mean = sum n_i m_i / n, covariance = sum n_i (C_i + d_i d_i^T) /
// n.
inline PointSpread Merged(std::span<const PointSpread> sets) {
  PointSpread all;
  for (const PointSpread& set : sets) {
    all.count += set.count;
    all.mean_m += static_cast<double>(set.count) * set.mean_m;
  }
  all.mean_m /= static_cast<double>(all.count);
  SymmetricMatrix3& sum_m2 = all.covariance_m2;
  for (const PointSpread& set : sets) {
    const Vector3 d = set.mean_m - all.mean_m;
    const double share = static_cast<double>(set.count) / static_cast<double>(all.count);
    sum_m2.xx += share * (set.covariance_m2.xx + d.x() * d.x());
    sum_m2.yy += share * (set.covariance_m2.yy + d.y() * d.y());
    sum_m2.zz += share * (set.covariance_m2.zz + d.z() * d.z());
    sum_m2.xy += share * (set.covariance_m2.xy + d.x() * d.y());
    sum_m2.xz += share * (set.covariance_m2.xz + d.x() * d.z());
    sum_m2.yz += share * (set.covariance_m2.yz + d.y() * d.z());
  }
  return all;
}

}  // namespace rockyard::math

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "navigation/gestalt/point_sieve.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "math/point_moments.h"
#include "navigation/gestalt/point_sieve.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::navigation::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<double> kNumbers;
constexpr hn::RebindToSigned<decltype(kNumbers)> kWholes;
using Numbers = hn::Vec<decltype(kNumbers)>;
using Mask = hn::Mask<decltype(kNumbers)>;

HWY_INLINE Numbers All(double value) { return hn::Set(kNumbers, value); }

HWY_INLINE Mask UpTo(Numbers x, double largest) { return hn::Le(hn::Abs(x), All(largest)); }

// A cell along one axis.
struct Places {
  Numbers in_window;
  Numbers square_m2;  // of the distance of its centre from the rover
  Mask inside;
  Numbers slot;
};

HWY_INLINE Places PlaceOn(const SieveAxis& axis, Numbers at_m) {
  const auto cell = hn::Floor(hn::Div(hn::Sub(at_m, All(axis.origin_m)), All(axis.step_m)));
  const auto in_window = hn::Sub(cell, All(axis.first));
  const auto centre_m =
      hn::Add(All(axis.origin_m), hn::Mul(hn::Add(cell, All(0.5)), All(axis.step_m)));
  const auto distance_m = hn::Sub(centre_m, All(axis.rover_m));
  const auto wrapped = hn::Add(in_window, All(axis.wrap));
  const auto slot =
      hn::IfThenElse(hn::Lt(wrapped, All(axis.cells)), wrapped, hn::Sub(wrapped, All(axis.cells)));
  return {in_window, hn::Mul(distance_m, distance_m),
          hn::And(hn::Ge(in_window, hn::Zero(kNumbers)), hn::Lt(in_window, All(axis.cells))), slot};
}

// math::ToMomentUnits.
HWY_INLINE auto ToUnits(Numbers coordinate_m) {
  const auto scaled = hn::Mul(coordinate_m, All(math::kMomentUnitsPerMetre));
  return hn::ConvertTo(kWholes, hn::Add(scaled, hn::CopySign(All(0.5), coordinate_m)));
}

class Sifter {
 public:
  Sifter(const PointSieve& sieve, const double* pose, SiftedPoints& sifted)
      : sieve_(sieve), pose_(pose), sifted_(sifted) {}

  // Takes the first `count` lanes as points from `first` on.
  HWY_INLINE void Take(Numbers x_R, Numbers y_R, Numbers z_R, std::size_t first,
                       std::size_t count) {
    const auto x = Moved(0, x_R, y_R, z_R);
    const auto y = Moved(1, x_R, y_R, z_R);
    const auto z = Moved(2, x_R, y_R, z_R);
    // Comparisons fail for what is no number.
    const auto sound = hn::And(hn::And(UpTo(x, sieve_.largest_xy_m), UpTo(y, sieve_.largest_xy_m)),
                               hn::And(UpTo(hn::Sub(z, All(pose_[11])), sieve_.largest_height_m),
                                       UpTo(z, sieve_.largest_z_m)));
    const Places column = PlaceOn(sieve_.x, x);
    const Places row = PlaceOn(sieve_.y, y);
    const auto near =
        hn::Le(hn::Add(column.square_m2, row.square_m2), All(sieve_.largest_square_m2));
    const auto kept = hn::And(hn::And(hn::And(sound, near), hn::And(column.inside, row.inside)),
                              hn::FirstN(kNumbers, count));
    const auto slot = hn::Add(hn::Mul(row.slot, All(sieve_.x.cells)), column.slot);
    const auto save = [&](auto values, auto& to) {
      hn::StoreU(values, kWholes, to.data() + first);
    };
    save(hn::ConvertTo(kWholes, slot), sifted_.slots);
    save(ToUnits(x), sifted_.x);
    save(ToUnits(y), sifted_.y);
    save(ToUnits(z), sifted_.z);
    // Where a point falls is as good as random to a processor that guesses branches: none here.
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(kNumbers, kept, bytes);
    for (std::size_t i = 0; i < hn::MaxLanes(kNumbers); ++i) {
      sifted_.taken[sifted_.count] = static_cast<std::uint8_t>(first + i);
      sifted_.count += (bytes[0] >> i) & 1U;
    }
    first_x_ = hn::Min(first_x_, hn::IfThenElse(kept, column.in_window, first_x_));
    last_x_ = hn::Max(last_x_, hn::IfThenElse(kept, column.in_window, last_x_));
    first_y_ = hn::Min(first_y_, hn::IfThenElse(kept, row.in_window, first_y_));
    last_y_ = hn::Max(last_y_, hn::IfThenElse(kept, row.in_window, last_y_));
  }

  HWY_INLINE void Finish() {
    sifted_.first_x = hn::GetLane(hn::MinOfLanes(kNumbers, first_x_));
    sifted_.last_x = hn::GetLane(hn::MaxOfLanes(kNumbers, last_x_));
    sifted_.first_y = hn::GetLane(hn::MinOfLanes(kNumbers, first_y_));
    sifted_.last_y = hn::GetLane(hn::MaxOfLanes(kNumbers, last_y_));
  }

 private:
  // Returns a coordinate of X_WR p, in the order of Eigen's sums.
  HWY_INLINE Numbers Moved(std::size_t row, Numbers x, Numbers y, Numbers z) const {
    const auto turned =
        hn::Add(hn::Add(hn::Mul(All(pose_[row]), x), hn::Mul(All(pose_[3 + row]), y)),
                hn::Mul(All(pose_[6 + row]), z));
    return hn::Add(turned, All(pose_[9 + row]));
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  const PointSieve& sieve_;
  const double* pose_;  // three columns of the rotation, then the translation
  SiftedPoints& sifted_;
  Numbers first_x_ = All(kInfinity);
  Numbers last_x_ = All(-kInfinity);
  Numbers first_y_ = All(kInfinity);
  Numbers last_y_ = All(-kInfinity);
};

void SiftAll(const PointSieve& sieve, const double* points_R, std::size_t count, const double* pose,
             SiftedPoints& sifted) {
  sifted.count = 0;
  Sifter sifter(sieve, pose, sifted);
  const std::size_t lanes = hn::Lanes(kNumbers);
  Numbers x, y, z;
  std::size_t point = 0;
  for (; point + lanes <= count; point += lanes) {
    hn::LoadInterleaved3(kNumbers, points_R + 3 * point, x, y, z);
    sifter.Take(x, y, z, point, lanes);
  }
  if (point < count) {
    HWY_ALIGN double rest[3 * hn::MaxLanes(kNumbers)] = {};
    for (std::size_t i = 0; i < 3 * (count - point); ++i) rest[i] = points_R[3 * point + i];
    hn::LoadInterleaved3(kNumbers, rest, x, y, z);
    sifter.Take(x, y, z, point, count - point);
  }
  sifter.Finish();
}

}  // namespace rockyard::navigation::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rockyard::navigation {

HWY_EXPORT(SiftAll);

static_assert(sizeof(math::Vector3) == 3 * sizeof(double));

void Sift(const PointSieve& sieve, std::span<const math::Vector3> points_R,
          const math::Transform& X_WR, SiftedPoints& sifted) {
  EXPECT(points_R.size() <= SiftedPoints::kMost);
  std::array<double, 12> pose{};
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      pose[static_cast<std::size_t>(3 * j + i)] = X_WR.linear()(i, j);
    }
    pose[static_cast<std::size_t>(9 + i)] = X_WR.translation()[i];
  }
  if (points_R.empty()) {
    sifted.count = 0;
    return;
  }
  HWY_DYNAMIC_DISPATCH(SiftAll)
  (sieve, points_R.front().data(), points_R.size(), pose.data(), sifted);
}

}  // namespace rockyard::navigation

#endif  // HWY_ONCE

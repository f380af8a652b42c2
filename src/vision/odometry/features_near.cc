#include "vision/odometry/features_near.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/features_near.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "vision/odometry/set_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::int32_t> kPixels;

// Writes the indices of the places with columns from limits[0] to limits[1] and rows from limits[2]
// to limits[3], and returns how many they are; the arrays have whole vectors.
std::size_t FindInside(const std::int32_t* columns, const std::int32_t* rows, std::size_t count,
                       const std::int32_t* limits, std::int32_t* found) {
  const auto is_out = [](hn::Vec<decltype(kPixels)> pixels, const std::int32_t* range) HWY_ATTR {
    return hn::Or(hn::Lt(pixels, hn::Set(kPixels, range[0])),
                  hn::Gt(pixels, hn::Set(kPixels, range[1])));
  };
  std::size_t number = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(kPixels)) {
    const auto inside = hn::Not(hn::Or(is_out(hn::Load(kPixels, columns + i), limits),
                                       is_out(hn::Load(kPixels, rows + i), limits + 2)));
    if (hn::AllFalse(kPixels, inside)) continue;
    number += WriteSetLanes(kPixels, inside, static_cast<std::int32_t>(i), found + number);
  }
  return number;
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(FindInside);

namespace {

// Fills up the last vector: no feature is there.
constexpr std::int32_t kNowhere = std::numeric_limits<std::int32_t>::min();

// Returns the first and the last whole pixel within `reach` of a finite place, clamped to what the
// 16 bits of a feature hold, so that a place beyond has none.
std::array<std::int32_t, 2> RangeAbout(double place, double reach) {
  constexpr double kMost = std::numeric_limits<std::int16_t>::max();
  return {static_cast<std::int32_t>(std::clamp(std::ceil(place - reach), -kMost, kMost + 1.0)),
          static_cast<std::int32_t>(std::clamp(std::floor(place + reach), -kMost, kMost))};
}

}  // namespace

FeaturesNear::FeaturesNear(const Features& features)
    : count_(features.size()),
      columns_(count_ + kMostLanes<std::int32_t>),
      rows_(count_ + kMostLanes<std::int32_t>),
      found_(count_ + kMostLanes<std::int32_t>) {
  std::fill_n(columns_.data(), columns_.size(), kNowhere);
  for (std::size_t i = 0; i < count_; ++i) {
    columns_.data()[i] = features[i].column;
    rows_.data()[i] = features[i].row;
  }
}

std::span<const std::int32_t> FeaturesNear::Find(const Pixel& place, double columns_px,
                                                 double rows_px) {
  if (!place.allFinite()) return {};
  const auto columns = RangeAbout(place.x(), columns_px);
  const auto rows = RangeAbout(place.y(), rows_px);
  const std::array<std::int32_t, 4> limits{columns[0], columns[1], rows[0], rows[1]};
  const std::size_t number = HWY_DYNAMIC_DISPATCH(FindInside)(columns_.data(), rows_.data(), count_,
                                                              limits.data(), found_.data());
  return {found_.data(), number};
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE

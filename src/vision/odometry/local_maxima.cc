// LocalMaxima (harris.h), for every instruction set.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "vision/odometry/harris.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/local_maxima.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "vision/odometry/set_lanes.h"
#include "vision/stereo/aligned_buffer.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::int32_t> kResponses;

// Sets the first of `count` rows of `largest` to the largest of the 2 reach + 1 values about each
// column, and raises the other rows to at least that. `values` has `reach` more to either side.
void RaiseToLargest(const std::int32_t* values, int reach, std::size_t width,
                    std::int32_t* const* largest, int count) {
  for (std::size_t x = 0; x < width; x += hn::Lanes(kResponses)) {
    auto most = hn::Load(kResponses, values + x);
    for (int i = 1; i <= reach; ++i) {
      most = hn::Max(most, hn::Max(hn::LoadU(kResponses, values + x - i),
                                   hn::LoadU(kResponses, values + x + i)));
    }
    hn::Store(most, kResponses, largest[0] + x);
    for (int i = 1; i < count; ++i) {
      std::int32_t* const row = largest[i] + x;
      hn::Store(hn::Max(most, hn::Load(kResponses, row)), kResponses, row);
    }
  }
}

// Returns whether one of `count` values from `values` on is `value`.
HWY_INLINE bool Has(const std::int32_t* values, int count, std::int32_t value) {
  const auto wanted = hn::Set(kResponses, value);
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(kResponses))) {
    const auto counted = hn::FirstN(kResponses, static_cast<std::size_t>(count - i));
    const auto equal = hn::Eq(hn::LoadU(kResponses, values + i), wanted);
    if (!hn::AllFalse(kResponses, hn::And(equal, counted))) return true;
  }
  return false;
}

// Writes the columns of the row `here` where the value is at least the threshold, larger than all
// within `reach` columns before it and than `before`, and not smaller than `from` and `below`.
// Returns how many they are. The three arrays hold the largest values about every column: `before`
// of the `reach` rows above, `from` of as many rows from this one on, `below` of as many rows below
// it. `columns` has room for a whole vector more.
std::size_t FindPeaks(const std::int32_t* here, const std::int32_t* before,
                      const std::int32_t* from, const std::int32_t* below, int reach,
                      std::int32_t threshold, std::size_t width, std::int32_t* columns) {
  const auto least = hn::Set(kResponses, threshold);
  std::size_t found = 0;
  for (std::size_t x = 0; x < width; x += hn::Lanes(kResponses)) {
    const auto value = hn::Load(kResponses, here + x);
    const auto largest =
        hn::Max(hn::Max(least, hn::Load(kResponses, from + x)), hn::Load(kResponses, below + x));
    const auto peaks =
        hn::And(hn::Eq(value, largest), hn::Gt(value, hn::Load(kResponses, before + x)));
    found += WriteSetLanes(kResponses, peaks, static_cast<std::int32_t>(x), columns + found);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found; ++i) {
    const std::int32_t column = columns[i];
    columns[kept] = column;
    kept += Has(here + column - reach, reach, here[column]) ? 0 : 1;
  }
  return kept;
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(RaiseToLargest);
HWY_EXPORT(FindPeaks);

namespace {

// The rows of responses about the row whose peaks are asked for, and for every one the largest
// values about each column over `reach` rows from that row on.
class ResponseRows {
 public:
  // Peaks will be asked for rows from `top` on, in order.
  ResponseRows(const ResponseWriter& write, const ImageArea& all, int top, int reach)
      : write_(write),
        all_(all),
        reach_(reach),
        first_(top - reach),
        next_(first_),
        width_(static_cast<std::size_t>(all.width())),
        pad_(WholeVectors<std::int32_t>(static_cast<std::size_t>(reach))),
        stride_(WholeVectors<std::int32_t>(width_) + 2 * pad_),
        values_(stride_ * static_cast<std::size_t>(reach + 1)),
        largest_(stride_ * static_cast<std::size_t>(2 * reach + 1)),
        columns_(WholeVectors<std::int32_t>(width_) + kMostLanes<std::int32_t>),
        raised_(static_cast<std::size_t>(reach)) {}

  // Returns the columns of the peaks of a row, counted from the first column of `all`.
  std::span<const std::int32_t> Peaks(int row, std::int32_t threshold) {
    for (; next_ <= row + reach_; ++next_) Add(next_);
    const std::size_t count = HWY_DYNAMIC_DISPATCH(FindPeaks)(
        Values(row), Largest(row - reach_), Largest(row), Largest(row + 1), reach_, threshold,
        width_, columns_.data());
    return {columns_.data(), count};
  }

  std::int32_t Value(int row, int column) { return Values(row)[column]; }

 private:
  // The value outside of `all`, smaller than any response.
  static constexpr std::int32_t kNothing = std::numeric_limits<std::int32_t>::min();

  void Add(int row) {
    if (row < all_.top || row >= all_.bottom) {
      std::fill_n(Largest(row) - pad_, stride_, kNothing);
      return;
    }
    std::int32_t* const values = Values(row);
    write_(row, values);
    std::fill(values - pad_, values, kNothing);
    std::fill(values + width_, values - pad_ + stride_, kNothing);
    for (int i = 0; i < reach_; ++i) raised_[static_cast<std::size_t>(i)] = Largest(row - i);
    HWY_DYNAMIC_DISPATCH(RaiseToLargest)(values, reach_, width_, raised_.data(), reach_);
  }

  // Returns where a row begins in a buffer of `height` rows, in which later rows replace earlier
  // ones; first_ - reach_ is the first row that is written.
  std::size_t Offset(int row, int height) const {
    return static_cast<std::size_t>((row - first_ + reach_) % height) * stride_ + pad_;
  }
  std::int32_t* Values(int row) { return values_.data() + Offset(row, reach_ + 1); }
  std::int32_t* Largest(int row) { return largest_.data() + Offset(row, 2 * reach_ + 1); }

  const ResponseWriter& write_;
  ImageArea all_;
  int reach_;
  int first_;  // first row that a peak is compared with
  int next_;   // next row to add
  std::size_t width_;
  std::size_t pad_;
  std::size_t stride_;
  AlignedBuffer<std::int32_t> values_;  // of the row whose peaks are asked for and those below
  AlignedBuffer<std::int32_t> largest_;
  AlignedBuffer<std::int32_t> columns_;
  std::vector<std::int32_t*> raised_;  // rows of largest_
};

}  // namespace

Features LocalMaxima(const ResponseWriter& write, const ImageArea& all, const ImageArea& area,
                     int reach, std::int32_t threshold) {
  EXPECT(all.left <= area.left && area.right <= all.right);
  EXPECT(all.top <= area.top && area.bottom <= all.bottom);
  EXPECT(reach >= 1);
  Features peaks;
  ResponseRows rows(write, all, area.top, reach);
  for (int row = area.top; row < area.bottom; ++row) {
    for (const std::int32_t column : rows.Peaks(row, threshold)) {
      const int x = all.left + column;
      if (x < area.left || x >= area.right) continue;
      peaks.push_back(
          {static_cast<std::int16_t>(x), static_cast<std::int16_t>(row), rows.Value(row, column)});
    }
  }
  return peaks;
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE

#include "vision/odometry/local_maxima.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

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
using Responses = hn::Vec<decltype(kResponses)>;

// The largest of some rows in every column.
void LargestOfRows(const std::int32_t* const* rows, int count, std::size_t width,
                   std::int32_t* largest) {
  for (std::size_t x = 0; x < width; x += hn::Lanes(kResponses)) {
    auto most = hn::Load(kResponses, rows[0] + x);
    for (int i = 1; i < count; ++i) most = hn::Max(most, hn::Load(kResponses, rows[i] + x));
    hn::Store(most, kResponses, largest + x);
  }
}

// Columns whose value is at least the threshold, and none larger within `reach` columns; their
// number. There are `reach` more values to either side, and whole vectors.
std::size_t FindLargest(const std::int32_t* values, int reach, std::int32_t threshold,
                        std::size_t width, std::int32_t* columns) {
  const auto least = hn::Set(kResponses, threshold);
  std::size_t found = 0;
  for (std::size_t x = 0; x < width; x += hn::Lanes(kResponses)) {
    const auto value = hn::Load(kResponses, values + x);
    auto most = hn::Max(value, least);
    for (int i = 1; i <= reach; ++i) {
      most = hn::Max(most, hn::Max(hn::LoadU(kResponses, values + x - i),
                                   hn::LoadU(kResponses, values + x + i)));
    }
    found += WriteSetLanes(kResponses, hn::Eq(value, most), static_cast<std::int32_t>(x),
                           columns + found);
  }
  return found;
}

// The larger lanes of `most` and of `count` values from `values` on; a whole vector is read.
HWY_INLINE Responses Largest(const std::int32_t* values, int count, Responses most) {
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(kResponses))) {
    const auto counted = hn::FirstN(kResponses, static_cast<std::size_t>(count - i));
    most = hn::IfThenElse(counted, hn::Max(most, hn::LoadU(kResponses, values + i)), most);
  }
  return most;
}

// Whether the value of a column of rows[at] is larger than all within `reach` rows and columns that
// come before it in the order of rows, and not smaller than those behind; none of its row is
// larger.
HWY_INLINE bool IsPeak(const std::int32_t* const* rows, int count, int at, int column, int reach) {
  const auto value = hn::Set(kResponses, rows[at][column]);
  const int left = column - reach;
  auto before = hn::Set(kResponses, std::numeric_limits<std::int32_t>::min());
  auto after = before;
  for (int i = std::max(at - reach, 0); i < at; ++i) {
    before = Largest(rows[i] + left, 2 * reach + 1, before);
  }
  before = Largest(rows[at] + left, reach, before);
  for (int i = at + 1; i < std::min(at + reach + 1, count); ++i) {
    after = Largest(rows[i] + left, 2 * reach + 1, after);
  }
  return hn::AllTrue(kResponses, hn::Gt(value, before)) &&
         hn::AllFalse(kResponses, hn::Gt(after, value));
}

// Of `columns`, whose largest values in rows[first] to before rows[end] are known, those in which
// the first such value is a peak, and the rows of these; their number.
std::size_t KeepPeaks(const std::int32_t* const* rows, int count, int first, int reach,
                      const std::int32_t* largest, std::size_t candidates, std::int32_t* columns,
                      std::int32_t* rows_of_peaks) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < candidates; ++i) {
    const std::int32_t column = columns[i];
    int row = first;
    while (rows[row][column] != largest[column]) ++row;
    columns[kept] = column;
    rows_of_peaks[kept] = row;
    kept += IsPeak(rows, count, row, column, reach) ? 1 : 0;
  }
  return kept;
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(LargestOfRows);
HWY_EXPORT(FindLargest);
HWY_EXPORT(KeepPeaks);

namespace {

// Most lanes of 32 bits that any vector has.
constexpr std::size_t kMostResponses = 32;

std::size_t WholeVectors(std::size_t count) {
  return (count + kMostResponses - 1) / kMostResponses * kMostResponses;
}

// Peaks of reach + 1 rows at a time: all that lie in one column of them are within reach of each
// other, so that a column has one peak at most, its largest value, and those that are smaller than
// the largest value of a column within reach have none (after Neubeck and Van Gool 2006). What is
// left, some columns in seven, is looked at in both directions.
class PeaksOfRows {
 public:
  PeaksOfRows(const ResponseWriter& write, const ImageArea& all, int reach)
      : write_(write),
        all_(all),
        reach_(reach),
        next_(all.top),
        height_(3 * reach + 1),
        width_(static_cast<std::size_t>(all.width())),
        pad_(WholeVectors(static_cast<std::size_t>(reach))),
        stride_(WholeVectors(width_) + 2 * pad_),
        values_(stride_ * static_cast<std::size_t>(height_)),
        largest_(stride_),
        columns_(WholeVectors(width_)),
        peak_rows_(columns_.size()) {}

  // Of rows `top` to before `bottom`, at most reach + 1 and none before the last call's.
  void AddPeaks(int top, int bottom, const ImageArea& area, std::int32_t threshold,
                Features& peaks) {
    const int first = std::max(top - reach_, all_.top);
    const int end = std::min(bottom + reach_, all_.bottom);
    for (next_ = std::max(next_, first); next_ < end; ++next_) Write(next_);
    rows_.clear();
    for (int row = first; row < end; ++row) rows_.push_back(Row(row));
    std::int32_t* const largest = largest_.data() + pad_;
    HWY_DYNAMIC_DISPATCH(LargestOfRows)
    (rows_.data() + (top - first), bottom - top, width_, largest);
    FillAround(largest);
    const std::size_t candidates =
        HWY_DYNAMIC_DISPATCH(FindLargest)(largest, reach_, threshold, width_, columns_.data());
    const std::size_t count = HWY_DYNAMIC_DISPATCH(KeepPeaks)(
        rows_.data(), static_cast<int>(rows_.size()), top - first, reach_, largest, candidates,
        columns_.data(), peak_rows_.data());
    for (std::size_t i = 0; i < count; ++i) {
      const std::int32_t column = columns_.data()[i];
      const int x = all_.left + column;
      if (x < area.left || x >= area.right) continue;
      peaks.push_back({static_cast<std::int16_t>(x),
                       static_cast<std::int16_t>(first + peak_rows_.data()[i]), largest[column]});
    }
  }

 private:
  void Write(int row) {
    std::int32_t* const values = Row(row);
    write_(row, values);
    FillAround(values);
  }

  // What lies outside is smaller than any response.
  void FillAround(std::int32_t* values) const {
    constexpr std::int32_t kNothing = std::numeric_limits<std::int32_t>::min();
    std::fill(values - pad_, values, kNothing);
    std::fill(values + width_, values - pad_ + stride_, kNothing);
  }

  std::int32_t* Row(int row) {
    return values_.data() + static_cast<std::size_t>(row % height_) * stride_ + pad_;
  }

  const ResponseWriter& write_;
  ImageArea all_;
  int reach_;
  int next_;    // row that comes
  int height_;  // rows that are there at once
  std::size_t width_;
  std::size_t pad_;
  std::size_t stride_;
  AlignedBuffer<std::int32_t> values_;
  AlignedBuffer<std::int32_t> largest_;  // of the rows that are looked at
  AlignedBuffer<std::int32_t> columns_;
  AlignedBuffer<std::int32_t> peak_rows_;
  std::vector<const std::int32_t*> rows_;
};

}  // namespace

Features LocalMaxima(const ResponseWriter& write, const ImageArea& all, const ImageArea& area,
                     int reach, std::int32_t threshold) {
  EXPECT(all.left <= area.left && area.right <= all.right);
  EXPECT(all.top <= area.top && area.bottom <= all.bottom);
  EXPECT(reach >= 1);
  Features peaks;
  PeaksOfRows rows(write, all, reach);
  for (int top = area.top; top < area.bottom; top += reach + 1) {
    rows.AddPeaks(top, std::min(top + reach + 1, area.bottom), area, threshold, peaks);
  }
  return peaks;
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE

#include "vision/odometry/local_maxima.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/local_maxima.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "vision/stereo/aligned_buffer.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::int32_t> kResponses;

// The largest of 2 reach + 1 columns about each; there are `reach` more to either side.
void LargestOfColumns(const std::int32_t* values, int reach, std::size_t width,
                      std::int32_t* largest) {
  for (std::size_t x = 0; x < width; x += hn::Lanes(kResponses)) {
    auto most = hn::Load(kResponses, values + x);
    for (int i = 1; i <= reach; ++i) {
      most = hn::Max(most, hn::Max(hn::LoadU(kResponses, values + x - i),
                                   hn::LoadU(kResponses, values + x + i)));
    }
    hn::Store(most, kResponses, largest + x);
  }
}

// Whether one of `count` values from `values` on is `value`.
HWY_INLINE bool Has(const std::int32_t* values, int count, std::int32_t value) {
  const auto wanted = hn::Set(kResponses, value);
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(kResponses))) {
    const auto counted = hn::FirstN(kResponses, static_cast<std::size_t>(count - i));
    const auto equal = hn::Eq(hn::LoadU(kResponses, values + i), wanted);
    if (!hn::AllFalse(kResponses, hn::And(equal, counted))) return true;
  }
  return false;
}

// Columns of the row `here` where the value is at least the threshold, no value is as large within
// `reach` rows and columns before it in the order of rows, and none larger behind it; their number.
// `before` and `from` have the largest values about every column of the rows before, and of this
// and those that come. Rows have room for two whole vectors.
std::size_t FindPeaks(const std::int32_t* here, const std::int32_t* const* before, int rows_before,
                      const std::int32_t* const* from, int rows_from, int reach,
                      std::int32_t threshold, std::size_t width, std::int32_t* columns) {
  const auto least = hn::Set(kResponses, threshold);
  const auto nothing = hn::Set(kResponses, std::numeric_limits<std::int32_t>::min());
  std::size_t found = 0;
  for (std::size_t x = 0; x < width; x += hn::Lanes(kResponses)) {
    auto most = least;
    for (int i = 0; i < rows_from; ++i) {
      most = hn::Max(most, hn::Load(kResponses, from[i] + x));
    }
    auto most_before = nothing;
    for (int i = 0; i < rows_before; ++i) {
      most_before = hn::Max(most_before, hn::Load(kResponses, before[i] + x));
    }
    const auto value = hn::Load(kResponses, here + x);
    const auto peaks = hn::And(hn::Eq(value, most), hn::Gt(value, most_before));
    if (hn::AllFalse(kResponses, peaks)) continue;
    const auto at = hn::Iota(kResponses, static_cast<std::int32_t>(x));
    found += hn::CompressStore(at, peaks, kResponses, columns + found);
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

HWY_EXPORT(LargestOfColumns);
HWY_EXPORT(FindPeaks);

namespace {

// Most lanes of 32 bits that any vector has.
constexpr std::size_t kMostResponses = 32;

// The rows of responses about the one that is looked at.
class ResponseRows {
 public:
  ResponseRows(const ResponseWriter& write, const ImageArea& all, int reach)
      : write_(write),
        all_(all),
        reach_(reach),
        height_(2 * reach + 1),
        width_(static_cast<std::size_t>(all.width())),
        pad_(Whole(static_cast<std::size_t>(reach))),
        stride_(Whole(width_) + 2 * pad_),
        values_(stride_ * static_cast<std::size_t>(height_)),
        largest_(stride_ * static_cast<std::size_t>(height_)),
        columns_(Whole(width_) + kMostResponses) {}

  // Columns of the peaks of a row, counted from the first of the sums.
  std::span<const std::int32_t> Peaks(int row, std::int32_t threshold) {
    const int first = std::max(row - reach_, all_.top);
    const int last = std::min(row + reach_, all_.bottom - 1);
    next_ = std::max(next_, first);
    for (; next_ <= last; ++next_) Find(next_);
    before_.clear();
    from_.clear();
    for (int y = first; y < row; ++y) before_.push_back(Row(largest_, y));
    for (int y = row; y <= last; ++y) from_.push_back(Row(largest_, y));
    const std::size_t count = HWY_DYNAMIC_DISPATCH(FindPeaks)(
        Row(values_, row), before_.data(), static_cast<int>(before_.size()), from_.data(),
        static_cast<int>(from_.size()), reach_, threshold, width_, columns_.data());
    return {columns_.data(), count};
  }

  std::int32_t Value(int row, int column) const { return Row(values_, row)[column]; }

 private:
  static std::size_t Whole(std::size_t count) {
    return (count + kMostResponses - 1) / kMostResponses * kMostResponses;
  }

  // What lies outside is smaller than any response.
  void Find(int row) {
    constexpr std::int32_t kNothing = std::numeric_limits<std::int32_t>::min();
    std::int32_t* const values = Row(values_, row);
    write_(row, values);
    std::fill(values - pad_, values, kNothing);
    std::fill(values + width_, values - pad_ + stride_, kNothing);
    HWY_DYNAMIC_DISPATCH(LargestOfColumns)(values, reach_, width_, Row(largest_, row));
  }

  std::size_t Offset(int row) const {
    return static_cast<std::size_t>(row % height_) * stride_ + pad_;
  }
  std::int32_t* Row(AlignedBuffer<std::int32_t>& rows, int row) {
    return rows.data() + Offset(row);
  }
  const std::int32_t* Row(const AlignedBuffer<std::int32_t>& rows, int row) const {
    return rows.data() + Offset(row);
  }

  const ResponseWriter& write_;
  ImageArea all_;
  int reach_;
  int height_;
  int next_ = 0;
  std::size_t width_;
  std::size_t pad_;
  std::size_t stride_;
  AlignedBuffer<std::int32_t> values_;
  AlignedBuffer<std::int32_t> largest_;  // of the columns about each
  AlignedBuffer<std::int32_t> columns_;
  std::vector<const std::int32_t*> before_;  // rows of largest_ above the one that is looked at
  std::vector<const std::int32_t*> from_;    // and from it on
};

}  // namespace

Features LocalMaxima(const ResponseWriter& write, const ImageArea& all, const ImageArea& area,
                     int reach, std::int32_t threshold) {
  EXPECT(all.left <= area.left && area.right <= all.right);
  EXPECT(all.top <= area.top && area.bottom <= all.bottom);
  EXPECT(reach >= 1);
  Features peaks;
  ResponseRows rows(write, all, reach);
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

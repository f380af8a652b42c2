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

// Columns of the last of the rows `values` where the value is at least the threshold, none of the
// `largest` of the rows about is larger, and none within `reach` columns in the rows `values`
// before it is as large; their number. Rows have room for two whole vectors.
std::size_t FindPeaks(const std::int32_t* const* values, int value_rows,
                      const std::int32_t* const* largest, int largest_rows, int reach,
                      std::int32_t threshold, std::size_t width, std::int32_t* columns) {
  const std::int32_t* const here = values[value_rows - 1];
  const auto least = hn::Set(kResponses, threshold);
  std::size_t found = 0;
  const std::size_t lanes = hn::Lanes(kResponses);
  const auto append = [&](std::size_t x, hn::Vec<decltype(kResponses)> most) HWY_ATTR {
    const auto peaks = hn::Eq(hn::Load(kResponses, here + x), most);
    if (hn::AllFalse(kResponses, peaks)) return;
    const auto at = hn::Iota(kResponses, static_cast<std::int32_t>(x));
    found += hn::CompressStore(at, peaks, kResponses, columns + found);
  };
  for (std::size_t x = 0; x < width; x += 2 * lanes) {
    auto first = least;
    auto second = least;
    for (int i = 0; i < largest_rows; ++i) {
      first = hn::Max(first, hn::Load(kResponses, largest[i] + x));
      second = hn::Max(second, hn::Load(kResponses, largest[i] + x + lanes));
    }
    append(x, first);
    append(x + lanes, second);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found; ++i) {
    const std::int32_t column = columns[i];
    const std::int32_t value = here[column];
    bool repeated = Has(here + column - reach, reach, value);
    for (int row = 0; row + 1 < value_rows && !repeated; ++row) {
      repeated = Has(values[row] + column - reach, 2 * reach + 1, value);
    }
    columns[kept] = column;
    kept += repeated ? 0 : 1;
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
  ResponseRows(const GradientSums& sums, std::int32_t weight, int reach)
      : sums_(sums),
        weight_(weight),
        reach_(reach),
        height_(2 * reach + 1),
        width_(static_cast<std::size_t>(sums.area().width())),
        pad_(Whole(static_cast<std::size_t>(reach))),
        stride_(Whole(width_) + 2 * pad_),
        values_(stride_ * static_cast<std::size_t>(height_)),
        largest_(stride_ * static_cast<std::size_t>(height_)),
        columns_(Whole(width_) + kMostResponses) {}

  // Columns of the peaks of a row, counted from the first of the sums.
  std::span<const std::int32_t> Peaks(int row, std::int32_t threshold) {
    const int first = std::max(row - reach_, sums_.area().top);
    const int last = std::min(row + reach_, sums_.area().bottom - 1);
    next_ = std::max(next_, first);
    for (; next_ <= last; ++next_) Find(next_);
    before_.clear();
    about_.clear();
    for (int y = first; y <= row; ++y) before_.push_back(Row(values_, y));
    for (int y = first; y <= last; ++y) about_.push_back(Row(largest_, y));
    const std::size_t count = HWY_DYNAMIC_DISPATCH(FindPeaks)(
        before_.data(), static_cast<int>(before_.size()), about_.data(),
        static_cast<int>(about_.size()), reach_, threshold, width_, columns_.data());
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
    sums_.WriteResponse(row, weight_, values);
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

  const GradientSums& sums_;
  std::int32_t weight_;
  int reach_;
  int height_;
  int next_ = 0;
  std::size_t width_;
  std::size_t pad_;
  std::size_t stride_;
  AlignedBuffer<std::int32_t> values_;
  AlignedBuffer<std::int32_t> largest_;  // of the columns about each
  AlignedBuffer<std::int32_t> columns_;
  std::vector<const std::int32_t*> before_;  // rows of values, up to the one that is looked at
  std::vector<const std::int32_t*> about_;   // rows of largest_ about it
};

}  // namespace

Features LocalMaxima(const GradientSums& sums, std::int32_t weight, const ImageArea& area,
                     int reach, std::int32_t threshold) {
  const ImageArea& all = sums.area();
  EXPECT(all.left <= area.left && area.right <= all.right);
  EXPECT(all.top <= area.top && area.bottom <= all.bottom);
  EXPECT(reach >= 1);
  Features peaks;
  ResponseRows rows(sums, weight, reach);
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

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

// Columns whose value is at least the threshold and none of the rows' values is larger; their
// number.
std::size_t LargestOfRows(const std::int32_t* values, const std::int32_t* const* rows, int count,
                          std::int32_t threshold, std::size_t width, std::int32_t* columns) {
  const auto least = hn::Set(kResponses, threshold);
  std::size_t found = 0;
  for (std::size_t x = 0; x < width; x += hn::Lanes(kResponses)) {
    auto most = least;
    for (int i = 0; i < count; ++i) most = hn::Max(most, hn::Load(kResponses, rows[i] + x));
    const auto peaks = hn::Eq(hn::Load(kResponses, values + x), most);
    if (hn::AllFalse(kResponses, peaks)) continue;
    const auto at = hn::Iota(kResponses, static_cast<std::int32_t>(x));
    found += hn::CompressStore(at, peaks, kResponses, columns + found);
  }
  return found;
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(LargestOfColumns);
HWY_EXPORT(LargestOfRows);

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

  // Columns, counted from the first of the sums, where none of the values about is larger.
  std::span<const std::int32_t> Peaks(int row, std::int32_t threshold) {
    const int first = std::max(row - reach_, sums_.area().top);
    const int last = std::min(row + reach_, sums_.area().bottom - 1);
    next_ = std::max(next_, first);
    for (; next_ <= last; ++next_) Find(next_);
    rows_.clear();
    for (int y = first; y <= last; ++y) rows_.push_back(Row(largest_, y));
    const std::size_t count = HWY_DYNAMIC_DISPATCH(LargestOfRows)(
        Row(values_, row), rows_.data(), static_cast<int>(rows_.size()), threshold, width_,
        columns_.data());
    return {columns_.data(), count};
  }

  // Whether a pixel before a peak has as much as that.
  bool IsRepeated(int row, int column) const {
    const std::int32_t value = Row(values_, row)[column];
    const std::int32_t* const here = Row(values_, row) + column;
    if (std::find(here - reach_, here, value) != here) return true;
    for (int y = std::max(row - reach_, sums_.area().top); y < row; ++y) {
      const std::int32_t* const before = Row(values_, y) + column;
      if (std::find(before - reach_, before + reach_ + 1, value) != before + reach_ + 1) {
        return true;
      }
    }
    return false;
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
  std::int32_t* Row(AlignedBuffer<std::int32_t>& rows, int row) { return rows.data() + Offset(row); }
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
  std::vector<const std::int32_t*> rows_;
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
      if (x < area.left || x >= area.right || rows.IsRepeated(row, column)) continue;
      peaks.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(row),
                       rows.Value(row, column)});
    }
  }
  return peaks;
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE

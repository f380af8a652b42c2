// Sums of absolute differences along a row, for every instruction set.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/row_difference.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "vision/odometry/row_difference.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::uint16_t> kSums;
constexpr hn::Rebind<std::uint8_t, decltype(kSums)> kPixels;

// `left` is the upper left pixel of the window; `rows` are the rows of the other eye, `rows_stride`
// apart, from the upper left pixel of the window of the last disparity on. Writes sums from the
// last disparity to the first; `count` is of whole vectors.
void AlongRow(const std::uint8_t* left, std::size_t left_stride, const std::uint8_t* rows,
              std::size_t rows_stride, std::size_t count, std::uint16_t* sums) {
  for (std::size_t first = 0; first < count; first += hn::Lanes(kSums)) {
    auto sum = hn::Zero(kSums);
    for (std::size_t y = 0; y < kRowSide; ++y) {
      const std::uint8_t* const l = left + y * left_stride;
      const std::uint8_t* const r = rows + y * rows_stride + first;
      for (std::size_t x = 0; x < kRowSide; ++x) {
        const auto seen = hn::PromoteTo(kSums, hn::LoadU(kPixels, r + x));
        const auto wanted = hn::Set(kSums, l[x]);
        // One of the two differences is 0.
        sum = hn::Add(sum, hn::Or(hn::SaturatedSub(seen, wanted), hn::SaturatedSub(wanted, seen)));
      }
    }
    hn::StoreU(sum, kSums, sums + first);
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(AlongRow);

namespace {

// Most lanes of 16 bits that any vector has.
constexpr std::size_t kMostLanes = 64;

}  // namespace

void RowDifferences(const GrayImage& left, const GrayImage& right, int column, int row,
                    int first_disparity, std::span<std::uint16_t> differences) {
  const auto count = differences.size();
  const int first = column - first_disparity;
  const int last = first - static_cast<int>(count) + 1;
  EXPECT(row >= kRowReach && row + kRowReach < left.height() && left.height() == right.height());
  EXPECT(column >= kRowReach && column + kRowReach < left.width());
  EXPECT(last >= kRowReach && first + kRowReach < right.width());
  // Whole vectors read behind the last window: the rows are copied to where they may.
  const std::size_t whole = (count + kMostLanes - 1) / kMostLanes * kMostLanes;
  const std::size_t used = count + kRowSide - 1;
  const std::size_t stride = whole + kRowSide - 1;
  std::vector<std::uint8_t> rows(kRowSide * stride);
  for (std::size_t y = 0; y < kRowSide; ++y) {
    const std::uint8_t* const from =
        &right.At(last - kRowReach, row - kRowReach + static_cast<int>(y));
    std::copy_n(from, used, rows.data() + y * stride);
  }
  std::vector<std::uint16_t> sums(whole);
  HWY_DYNAMIC_DISPATCH(AlongRow)
  (&left.At(column - kRowReach, row - kRowReach), static_cast<std::size_t>(left.width()),
   rows.data(), stride, whole, sums.data());
  std::reverse_copy(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(count),
                    differences.begin());
}

}  // namespace rockyard::vision
#endif

// Sums of absolute differences along a row, for every instruction set.
#include <array>
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/row_difference.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "vision/odometry/row_difference.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A row of a window, and a pixel more that is taken out.
constexpr hn::FixedTag<std::uint8_t, 16> kRow;
constexpr hn::Repartition<std::uint64_t, decltype(kRow)> kRowSums;

// `left` is the upper left pixel of the window, `right` that of the one at the first disparity.
void AlongRow(const std::uint8_t* left, const std::uint8_t* right, std::size_t left_stride,
              std::size_t right_stride, std::span<std::uint32_t> differences) {
  const auto inside = hn::FirstN(kRow, 15);
  for (std::size_t d = 0; d < differences.size(); ++d) {
    auto sum = hn::Zero(kRowSums);
    for (std::size_t y = 0; y < 15; ++y) {
      const auto l = hn::LoadU(kRow, left + y * left_stride);
      const auto r = hn::LoadU(kRow, right + y * right_stride - d);
      // One of the two differences is 0.
      const auto difference = hn::Or(hn::SaturatedSub(l, r), hn::SaturatedSub(r, l));
      sum = hn::Add(sum, hn::SumsOf8(hn::IfThenElseZero(inside, difference)));
    }
    differences[d] = static_cast<std::uint32_t>(hn::GetLane(hn::SumOfLanes(kRowSums, sum)));
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(AlongRow);

void RowDifferences(const GrayImage& left, const GrayImage& right, int column, int row,
                    int first_disparity, std::span<std::uint32_t> differences) {
  const int first = column - first_disparity;
  EXPECT(row >= kRowReach && row + kRowReach < left.height() && left.height() == right.height());
  EXPECT(column >= kRowReach && column + kRowReach + 1 < left.width());
  EXPECT(first - static_cast<int>(differences.size()) + 1 >= kRowReach &&
         first + kRowReach + 1 < right.width());
  HWY_DYNAMIC_DISPATCH(AlongRow)
  (&left.At(column - kRowReach, row - kRowReach), &right.At(first - kRowReach, row - kRowReach),
   static_cast<std::size_t>(left.width()), static_cast<std::size_t>(right.width()), differences);
}

}  // namespace rockyard::vision
#endif

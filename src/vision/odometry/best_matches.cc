#include "vision/odometry/best_matches.h"

#include <algorithm>
#include <array>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/best_matches.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::uint16_t> kDifferences;

HWY_INLINE void Offer(hn::Vec<decltype(kDifferences)> value, hn::Vec<decltype(kDifferences)> at,
                      hn::Vec<decltype(kDifferences)>& difference,
                      hn::Vec<decltype(kDifferences)>& second,
                      hn::Vec<decltype(kDifferences)>& index) {
  index = hn::IfThenElse(hn::Lt(value, difference), at, index);
  second = hn::Min(second, hn::Max(value, difference));
  difference = hn::Min(value, difference);
}

// Takes the differences of window `row` of a block, padded by kNoDifference to whole vectors. Three
// arrays `stride` apart, of differences, second differences and indices, hold the best of every
// column; `best` becomes the same of this row. A lane holds every so many columns: of equal
// differences that of the smallest index counts.
void OfferRow(const std::uint16_t* differences, std::size_t count, std::uint16_t row,
              std::size_t stride, std::uint16_t* columns, std::uint16_t* best) {
  auto difference = hn::Set(kDifferences, kNoDifference);
  auto second = difference;
  auto index = hn::Zero(kDifferences);
  auto at = hn::Iota(kDifferences, 0);
  const auto here = hn::Set(kDifferences, row);
  const auto step = hn::Set(kDifferences, static_cast<std::uint16_t>(hn::Lanes(kDifferences)));
  for (std::size_t x = 0; x < count; x += hn::Lanes(kDifferences)) {
    const auto value = hn::Load(kDifferences, differences + x);
    Offer(value, at, difference, second, index);
    at = hn::Add(at, step);
    std::uint16_t* const column = columns + x;
    auto column_difference = hn::Load(kDifferences, column);
    auto column_second = hn::Load(kDifferences, column + stride);
    auto column_index = hn::Load(kDifferences, column + 2 * stride);
    Offer(value, here, column_difference, column_second, column_index);
    hn::Store(column_difference, kDifferences, column);
    hn::Store(column_second, kDifferences, column + stride);
    hn::Store(column_index, kDifferences, column + 2 * stride);
  }
  const auto least = hn::MinOfLanes(kDifferences, difference);
  const auto is_least = hn::Eq(difference, least);
  const auto none = hn::Set(kDifferences, kNoDifference);
  const auto winner = hn::MinOfLanes(kDifferences, hn::IfThenElse(is_least, index, none));
  const auto is_winner = hn::And(is_least, hn::Eq(index, winner));
  const auto others = hn::IfThenElse(is_winner, second, difference);
  best[0] = hn::GetLane(least);
  best[1] = hn::GetLane(hn::MinOfLanes(kDifferences, others));
  best[2] = hn::GetLane(winner);
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(OfferRow);

namespace {

// Windows of the first set whose differences are there at once; of the second that stay in the
// first cache meanwhile; and of the second at most at once: all indices fit into 16 bits.
constexpr std::size_t kBlock = 256;
constexpr std::size_t kTile = 128;
constexpr std::size_t kPanel = 4096;
// Most lanes of 16 bits that any vector has.
constexpr std::size_t kMostLanes = 64;

// Some windows of one set, from the first on.
struct Part {
  std::size_t first = 0;
  std::size_t count = 0;
};

Part PartFrom(std::size_t first, std::size_t most, const WindowSet& windows) {
  return {first, std::min(most, windows.size() - first)};
}

BestWindow BestAt(const std::uint16_t* best, std::size_t stride, std::size_t at,
                  std::size_t first) {
  return {static_cast<std::int32_t>(first + best[at + 2 * stride]), best[at], best[at + stride]};
}

class BestFinder {
 public:
  BestFinder(const WindowSet& first, const WindowSet& second)
      : first_(first),
        second_(second),
        stride_((std::min(second.size(), kPanel) + kMostLanes - 1) / kMostLanes * kMostLanes),
        differences_(std::min(first.size(), kBlock) * stride_, Filled::kAnything),
        columns_(3 * stride_) {}

  void Compare(const Part& block, const Part& panel, BestWindows& best) {
    FindDifferences(block, panel);
    std::fill_n(columns_.data(), 2 * stride_, kNoDifference);
    for (std::size_t i = 0; i < block.count; ++i) {
      std::array<std::uint16_t, 3> of_row{};
      HWY_DYNAMIC_DISPATCH(OfferRow)
      (Row(i), stride_, static_cast<std::uint16_t>(i), stride_, columns_.data(), of_row.data());
      best.of_first[block.first + i].Merge(BestAt(of_row.data(), 1, 0, panel.first));
    }
    for (std::size_t j = 0; j < panel.count; ++j) {
      best.of_second[panel.first + j].Merge(BestAt(columns_.data(), stride_, j, block.first));
    }
  }

 private:
  std::uint16_t* Row(std::size_t i) { return differences_.data() + i * stride_; }

  void FindDifferences(const Part& block, const Part& panel) {
    for (std::size_t from = 0; from < panel.count; from += kTile) {
      const std::size_t count = std::min(kTile, panel.count - from);
      for (std::size_t i = 0; i < block.count; ++i) {
        WindowDifferences(first_.At(block.first + i), second_, panel.first + from,
                          {Row(i) + from, count});
      }
    }
    for (std::size_t i = 0; i < block.count; ++i) {
      std::fill(Row(i) + panel.count, Row(i) + stride_, kNoDifference);
    }
  }

  const WindowSet& first_;
  const WindowSet& second_;
  std::size_t stride_;
  AlignedBuffer<std::uint16_t> differences_;  // of a block to a panel
  AlignedBuffer<std::uint16_t> columns_;
};

}  // namespace

BestWindows FindBestWindows(const WindowSet& first, const WindowSet& second) {
  BestWindows best{std::vector<BestWindow>(first.size()), std::vector<BestWindow>(second.size())};
  BestFinder finder(first, second);
  for (std::size_t j = 0; j < second.size(); j += kPanel) {
    for (std::size_t i = 0; i < first.size(); i += kBlock) {
      finder.Compare(PartFrom(i, kBlock, first), PartFrom(j, kPanel, second), best);
    }
  }
  return best;
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE

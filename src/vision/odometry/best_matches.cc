#include "vision/odometry/best_matches.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

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

// Takes in the differences of window `row` of a block, padded by kNoDifference to whole vectors.
// `columns` are three arrays `stride` apart, of differences, second differences and indices: the
// best of every column. `best` becomes these three numbers for the row. Must stay: of equal
// differences the smallest index is the best, also among columns in different lanes.
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

// Sets the bits of those of `count` columns (whole words of bits) whose bound is at most the limit
// of the column or that of the row, and clears the others. A bound equal to a limit must count, as
// an equal difference wins by a smaller index.
void MarkPossible(const std::uint16_t* bounds, const std::uint16_t* limits, std::uint16_t row_limit,
                  std::size_t count, std::uint8_t* bits) {
  const auto of_row = hn::Set(kDifferences, row_limit);
  for (std::size_t x = 0; x < count; x += hn::Lanes(kDifferences)) {
    const auto bound = hn::Load(kDifferences, bounds + x);
    const auto limit = hn::Max(of_row, hn::Load(kDifferences, limits + x));
    hn::StoreMaskBits(kDifferences, hn::Eq(hn::Min(bound, limit), bound), bits + x / 8);
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(OfferRow);
HWY_EXPORT(MarkPossible);

namespace {

// kBlock: windows of the first set whose differences are kept at once. kTile: windows of the second
// set that fit into the first cache. kPanel: windows of the second set at once, so that all indices
// fit into 16 bits.
constexpr std::size_t kBlock = 256;
constexpr std::size_t kTile = 128;
constexpr std::size_t kPanel = 4096;

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
        stride_(WholeVectors<std::uint16_t>(std::min(second.size(), kPanel))),
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

// Compares every window first with that of the least bound, which is the best one in most cases,
// then with those whose bound is not above the least difference found.
class LeastFinder {
 public:
  LeastFinder(const WindowSet& first, const WindowSet& second, BestWindows& best)
      : first_(first),
        second_(second),
        best_(best),
        signatures_(second),
        stride_(WholeVectors<std::uint16_t>(std::min(second.size(), kPanel))),
        bounds_(std::min(first.size(), kBlock) * stride_, Filled::kAnything),
        columns_(3 * stride_),
        limits_(stride_),
        bits_(stride_ / 8),
        differences_(stride_) {
    possible_.reserve(stride_);
  }

  void Compare(const Part& block, const Part& panel) {
    FindBounds(block, panel);
    CompareLeastBounds(block, panel);
    for (std::size_t j = 0; j < panel.count; ++j) {
      limits_.data()[j] = best_.of_second[panel.first + j].difference;
    }
    for (std::size_t i = 0; i < block.count; ++i) ComparePossible(block.first + i, Row(i), panel);
  }

 private:
  std::uint16_t* Row(std::size_t i) { return bounds_.data() + i * stride_; }

  void FindBounds(const Part& block, const Part& panel) {
    const std::size_t groups = (panel.count + SignatureSet::kGroup - 1) / SignatureSet::kGroup;
    for (std::size_t i = 0; i < block.count; ++i) {
      signatures_.FindBounds(SignatureOf(first_.At(block.first + i)), panel.first,
                             {Row(i), groups * SignatureSet::kGroup});
      std::fill(Row(i) + panel.count, Row(i) + stride_, kNoDifference);
    }
  }

  void CompareLeastBounds(const Part& block, const Part& panel) {
    std::fill_n(columns_.data(), 2 * stride_, kNoDifference);
    for (std::size_t i = 0; i < block.count; ++i) {
      std::array<std::uint16_t, 3> of_row{};
      HWY_DYNAMIC_DISPATCH(OfferRow)
      (Row(i), stride_, static_cast<std::uint16_t>(i), stride_, columns_.data(), of_row.data());
      CompareOne(block.first + i, panel.first + of_row[2]);
    }
    for (std::size_t j = 0; j < panel.count; ++j) {
      CompareOne(block.first + columns_.data()[2 * stride_ + j], panel.first + j);
    }
  }

  void CompareOne(std::size_t i, std::size_t j) {
    const auto column = static_cast<std::int32_t>(j);
    std::uint16_t difference = 0;
    ChosenDifferences(first_.At(i), second_, {&column, 1}, {&difference, 1});
    Offer(i, j, difference);
  }

  void ComparePossible(std::size_t i, const std::uint16_t* bounds, const Part& panel) {
    HWY_DYNAMIC_DISPATCH(MarkPossible)
    (bounds, limits_.data(), best_.of_first[i].difference, stride_, bits_.data());
    possible_.clear();
    for (std::size_t x = 0; x < stride_; x += 64) {
      std::uint64_t word = 0;
      std::memcpy(&word, bits_.data() + x / 8, sizeof(word));
      for (; word != 0; word &= word - 1) {
        const std::size_t bit = static_cast<std::size_t>(std::countr_zero(word));
        possible_.push_back(static_cast<std::int32_t>(panel.first + x + bit));
      }
    }
    ChosenDifferences(first_.At(i), second_, possible_, differences_);
    for (std::size_t k = 0; k < possible_.size(); ++k) {
      const auto j = static_cast<std::size_t>(possible_[k]);
      Offer(i, j, differences_[k]);
      limits_.data()[j - panel.first] = best_.of_second[j].difference;
    }
  }

  // Takes a difference into the best of both windows. Must stay: of equal differences the smaller
  // index is the best, whatever came first.
  void Offer(std::size_t i, std::size_t j, std::uint16_t difference) {
    const auto take = [difference](std::size_t index, BestWindow& best) {
      const auto other = static_cast<std::int32_t>(index);
      if (difference < best.difference || (difference == best.difference && other < best.index)) {
        best = {other, difference, kNoDifference};
      }
    };
    take(j, best_.of_first[i]);
    take(i, best_.of_second[j]);
  }

  const WindowSet& first_;
  const WindowSet& second_;
  BestWindows& best_;
  SignatureSet signatures_;
  std::size_t stride_;
  AlignedBuffer<std::uint16_t> bounds_;  // of a block to a panel
  AlignedBuffer<std::uint16_t> columns_;
  AlignedBuffer<std::uint16_t> limits_;  // of a panel: the least differences so far
  std::vector<std::uint8_t> bits_;
  std::vector<std::int32_t> possible_;
  std::vector<std::uint16_t> differences_;
};

// Calls `compare` for all parts in ascending order, as BestWindow::Merge needs it. Sizes of parts
// change no result.
template <typename Compare>
void ForAllParts(const WindowSet& first, const WindowSet& second, Compare compare) {
  for (std::size_t j = 0; j < second.size(); j += kPanel) {
    for (std::size_t i = 0; i < first.size(); i += kBlock) {
      compare(PartFrom(i, kBlock, first), PartFrom(j, kPanel, second));
    }
  }
}

}  // namespace

BestWindows FindBestWindows(const WindowSet& first, const WindowSet& second) {
  BestWindows best{std::vector<BestWindow>(first.size()), std::vector<BestWindow>(second.size())};
  BestFinder finder(first, second);
  ForAllParts(first, second,
              [&](const Part& block, const Part& panel) { finder.Compare(block, panel, best); });
  return best;
}

BestWindows FindLeastDifferent(const WindowSet& first, const WindowSet& second) {
  BestWindows best{std::vector<BestWindow>(first.size()), std::vector<BestWindow>(second.size())};
  LeastFinder finder(first, second, best);
  ForAllParts(first, second,
              [&](const Part& block, const Part& panel) { finder.Compare(block, panel); });
  return best;
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE

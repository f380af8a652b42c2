// Sums of absolute differences by sliding sums, and the best of left and right in one pass.
#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/stereo/correlator_scores.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "vision/stereo/correlator.h"
#include "vision/stereo/correlator_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::uint16_t> kWords;
constexpr hn::RebindToSigned<decltype(kWords)> kSignedWords;
using Words = hn::Vec<decltype(kWords)>;

const char* TargetName() { return hwy::TargetName(HWY_TARGET); }

int Lanes() { return static_cast<int>(hn::Lanes(kWords)); }

// |left - right| of two vectors of pixels.
HWY_INLINE Words AbsoluteDifference(Words left, const std::uint16_t* right) {
  const auto difference = hn::Sub(left, hn::Load(kWords, right));
  return hn::BitCast(kWords, hn::Abs(hn::BitCast(kSignedWords, difference)));
}

// The rows that come and go, at vector j = 0.
struct RowPair {
  const std::uint16_t* left_in;
  const std::uint16_t* left_out;
  const std::uint16_t* right_in;
  const std::uint16_t* right_out;
};

RowPair RowsOf(int slot_in, int slot_out, CorrelatorState& state) {
  const std::ptrdiff_t zero = state.layout.Wide(0);
  return {state.Left(slot_in), state.Left(slot_out), state.Right(slot_in) + zero,
          state.Right(slot_out) + zero};
}

// Column sums of a group: C(x, d) += |l - r| of the row that comes, -= that of the row that goes.
void SlideGroup(const RowPair& rows, int group, CorrelatorState& state) {
  const std::ptrdiff_t lanes = Lanes();
  const std::ptrdiff_t d = lanes * (state.layout.min_disparity + kGroup * group);
  std::uint16_t* const columns = state.Columns(kGroup * group);
  const auto stride = static_cast<std::ptrdiff_t>(state.column_stride);
  for (std::ptrdiff_t j = 0; j < lanes * state.layout.segment; j += lanes) {
    const auto left_in = hn::Load(kWords, rows.left_in + j);
    const auto left_out = hn::Load(kWords, rows.left_out + j);
    for (std::ptrdiff_t k = 0; k < kGroup; ++k) {
      const std::ptrdiff_t right = j - d - k * lanes;
      std::uint16_t* const column = columns + k * stride + j;
      const auto in = AbsoluteDifference(left_in, rows.right_in + right);
      const auto out = AbsoluteDifference(left_out, rows.right_out + right);
      hn::Store(hn::Sub(hn::Add(hn::Load(kWords, column), in), out), kWords, column);
    }
  }
}

// Columns before and after the segment, from the neighbouring lane.
void FillHalo(const LaneLayout& layout, std::uint16_t* columns) {
  const std::ptrdiff_t lanes = Lanes();
  const std::ptrdiff_t segment = lanes * layout.segment;
  for (std::ptrdiff_t j = -lanes; j >= -lanes * layout.before; j -= lanes) {
    hn::Store(hn::LoadU(kWords, columns + j + segment - 1), kWords, columns + j);
  }
  for (std::ptrdiff_t j = segment; j < segment + lanes * layout.after; j += lanes) {
    hn::Store(hn::LoadU(kWords, columns + j - segment + 1), kWords, columns + j);
  }
}

// Takes `key` of `group` into the best so far where its score is smaller.
HWY_INLINE void Improve(Words key, Words group, std::uint16_t* best_key,
                        std::uint16_t* best_group) {
  const auto old = hn::Load(kWords, best_key);
  const auto better = hn::Lt(hn::Or(key, hn::Set(kWords, kGroup - 1)), old);
  hn::Store(hn::IfThenElse(better, key, old), kWords, best_key);
  hn::Store(hn::IfThenElse(better, group, hn::Load(kWords, best_group)), kWords, best_group);
}

// Where the arrays of a group begin.
struct GroupArrays {
  const std::uint16_t* columns;
  std::ptrdiff_t column_stride;
  std::uint16_t* scores;
  std::ptrdiff_t score_stride;
  const std::uint16_t* left_mask;
  const std::uint16_t* right_mask;  // of the group's first disparity, at j = 0
  std::uint16_t* left_key;
  std::uint16_t* left_group;
  std::uint16_t* right_key;
  std::uint16_t* right_group;
};

GroupArrays ArraysOf(int group, CorrelatorState& state) {
  const LaneLayout& layout = state.layout;
  const std::ptrdiff_t right = layout.Wide(-layout.min_disparity - kGroup * group);
  return {state.Columns(kGroup * group),  static_cast<std::ptrdiff_t>(state.column_stride),
          state.Scores(kGroup * group),   static_cast<std::ptrdiff_t>(layout.row_size()),
          state.left_mask.data(),         state.right_mask.data() + right,
          state.left_key.data(),          state.left_group.data(),
          state.right_key.data() + right, state.right_group.data() + right};
}

// Window sums before the first pixel's last column is added; the place in the group in the low
// bits.
HWY_INLINE Words FirstSum(const GroupArrays& arrays, const LaneLayout& layout, std::ptrdiff_t k) {
  auto sum = hn::Set(kWords, static_cast<std::uint16_t>(k));
  for (int i = -layout.before; i < layout.after; ++i) {
    sum = hn::Add(sum, hn::Load(kWords, arrays.columns + k * arrays.column_stride + i * Lanes()));
  }
  return sum;
}

// Scores of the group's disparities along the row. S(x, d) = sum of C(x + i, d) over the window:
// S(x + 1) = S(x) + C(x + after + 1) - C(x - before). The left pixel of vector j compares its own
// four; the right one of vector j - d gets them one after the other, at j, j + 1, j + 2 and j + 3,
// so that its partial minima wait in registers. Disparities from `in_range` on are masked.
void ScoreGroup(const LaneLayout& layout, int group, std::ptrdiff_t in_range,
                const GroupArrays& arrays) {
  const std::ptrdiff_t lanes = Lanes();
  const std::ptrdiff_t after = lanes * layout.after;
  const std::ptrdiff_t before = lanes * layout.before;
  const auto number = hn::Set(kWords, static_cast<std::uint16_t>(group));
  const auto none = hn::Set(kWords, kNoKey);
  Words sum[kGroup] = {FirstSum(arrays, layout, 0), FirstSum(arrays, layout, 1),
                       FirstSum(arrays, layout, 2), FirstSum(arrays, layout, 3)};
  Words waiting[kGroup - 1] = {none, none, none};
  const std::ptrdiff_t end = lanes * layout.segment;
  for (std::ptrdiff_t j = 0; j < end; j += lanes) {
    const auto left_mask = hn::Load(kWords, arrays.left_mask + j);
    Words key[kGroup] = {none, none, none, none};
    for (std::ptrdiff_t k = 0; k < kGroup; ++k) {
      const std::uint16_t* const column = arrays.columns + k * arrays.column_stride + j;
      sum[k] = hn::Add(sum[k], hn::Load(kWords, column + after));
      const auto right_mask = hn::Load(kWords, arrays.right_mask + j - k * lanes);
      if (k < in_range) key[k] = hn::Or3(sum[k], left_mask, right_mask);
      sum[k] = hn::Sub(sum[k], hn::Load(kWords, column - before));
      hn::Store(key[k], kWords, arrays.scores + k * arrays.score_stride + j);
    }
    const auto left = hn::Min(hn::Min(key[0], key[1]), hn::Min(key[2], key[3]));
    Improve(left, number, arrays.left_key + j, arrays.left_group + j);
    const std::ptrdiff_t right = j - (kGroup - 1) * lanes;
    Improve(hn::Min(waiting[2], key[3]), number, arrays.right_key + right,
            arrays.right_group + right);
    waiting[2] = hn::Min(waiting[1], key[2]);
    waiting[1] = hn::Min(waiting[0], key[1]);
    waiting[0] = key[0];
  }
  for (int i = kGroup - 2; i >= 0; --i) {
    const std::ptrdiff_t right = end - lanes * (i + 1);
    Improve(waiting[i], number, arrays.right_key + right, arrays.right_group + right);
  }
}

void SlideColumns(int slot_in, int slot_out, CorrelatorState& state) {
  const RowPair rows = RowsOf(slot_in, slot_out, state);
  for (int group = 0; group < state.layout.groups; ++group) SlideGroup(rows, group, state);
}

void ScoreRow(int slot_in, int slot_out, CorrelatorState& state) {
  const LaneLayout& layout = state.layout;
  const RowPair rows = RowsOf(slot_in, slot_out, state);
  std::fill_n(state.left_key.data(), layout.row_size(), kNoKey);
  std::fill_n(state.right_key.data(), layout.wide_size(), kNoKey);
  for (int group = 0; group < layout.groups; ++group) {
    SlideGroup(rows, group, state);
    for (int k = 0; k < kGroup; ++k) FillHalo(layout, state.Columns(kGroup * group + k));
    ScoreGroup(layout, group, layout.disparities - kGroup * group, ArraysOf(group, state));
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(TargetName);
HWY_EXPORT(Lanes);
HWY_EXPORT(SlideColumns);
HWY_EXPORT(ScoreRow);

const char* InstructionSet() { return HWY_DYNAMIC_DISPATCH(TargetName)(); }

int VectorLanes() { return HWY_DYNAMIC_DISPATCH(Lanes)(); }

void SlideColumns(int slot_in, int slot_out, CorrelatorState& state) {
  HWY_DYNAMIC_DISPATCH(SlideColumns)(slot_in, slot_out, state);
}

void ScoreRow(int slot_in, int slot_out, CorrelatorState& state) {
  HWY_DYNAMIC_DISPATCH(ScoreRow)(slot_in, slot_out, state);
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE

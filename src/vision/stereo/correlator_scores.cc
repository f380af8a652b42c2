// The scores of CorrelateRows (correlator.h): sums of absolute differences by sliding sums, and the
// best match of left and right pixels in one pass.
#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/stereo/correlator_scores.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "vision/stereo/correlator.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::uint16_t> kWords;
constexpr hn::RebindToSigned<decltype(kWords)> kSignedWords;
using Words = hn::Vec<decltype(kWords)>;

const char* TargetName() { return hwy::TargetName(HWY_TARGET); }

int Lanes() { return static_cast<int>(hn::Lanes(kWords)); }

// Returns |left - right| of two vectors of pixels.
HWY_INLINE Words AbsoluteDifference(Words left, const std::uint16_t* right) {
  const auto difference = hn::Sub(left, hn::Load(kWords, right));
  return hn::BitCast(kWords, hn::Abs(hn::BitCast(kSignedWords, difference)));
}

// The rows that enter and leave the window, at vector j = 0.
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

// Writes how the sums of each column of the window change, for the disparities of a group:
// E(x, d) = |l - r| of the row that enters - |l - r| of the row that leaves.
void FindChanges(const RowPair& rows, int group, CorrelatorState& state) {
  const std::ptrdiff_t lanes = Lanes();
  const std::ptrdiff_t d = lanes * (state.layout.min_disparity + kGroup * group);
  std::uint16_t* const changes = state.Changes(0);
  const auto stride = static_cast<std::ptrdiff_t>(state.change_stride);
  for (std::ptrdiff_t j = 0; j < lanes * state.layout.segment; j += lanes) {
    const auto left_in = hn::Load(kWords, rows.left_in + j);
    const auto left_out = hn::Load(kWords, rows.left_out + j);
    for (std::ptrdiff_t k = 0; k < kGroup; ++k) {
      const std::ptrdiff_t right = j - d - k * lanes;
      const auto in = AbsoluteDifference(left_in, rows.right_in + right);
      const auto out = AbsoluteDifference(left_out, rows.right_out + right);
      hn::Store(hn::Sub(in, out), kWords, changes + k * stride + j);
    }
  }
}

// Fills the columns before and after the segment from the neighbouring lane.
void FillHalo(const LaneLayout& layout, std::uint16_t* changes) {
  const std::ptrdiff_t lanes = Lanes();
  const std::ptrdiff_t segment = lanes * layout.segment;
  for (std::ptrdiff_t j = -lanes; j >= -lanes * layout.before; j -= lanes) {
    hn::Store(hn::LoadU(kWords, changes + j + segment - 1), kWords, changes + j);
  }
  for (std::ptrdiff_t j = segment; j < segment + lanes * layout.after; j += lanes) {
    hn::Store(hn::LoadU(kWords, changes + j - segment + 1), kWords, changes + j);
  }
}

// Takes `key` of `group` into the best so far where its score is smaller. Must stay: of equal
// scores the smaller disparity, which came earlier, is kept.
HWY_INLINE void Improve(Words key, Words group, std::uint16_t* best_key,
                        std::uint16_t* best_group) {
  const auto old = hn::Load(kWords, best_key);
  const auto better = hn::Lt(hn::Or(key, hn::Set(kWords, kGroup - 1)), old);
  hn::Store(hn::IfThenElse(better, key, old), kWords, best_key);
  hn::Store(hn::IfThenElse(better, group, hn::Load(kWords, best_group)), kWords, best_group);
}

// Where the arrays of a group begin.
struct GroupArrays {
  const std::uint16_t* changes;
  std::ptrdiff_t change_stride;
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
  return {state.Changes(0),
          static_cast<std::ptrdiff_t>(state.change_stride),
          state.Scores(kGroup * group),
          static_cast<std::ptrdiff_t>(layout.row_size()),
          state.left_mask.data(),
          state.right_mask.data() + right,
          state.left_key.data(),
          state.left_group.data(),
          state.right_key.data() + right,
          state.right_group.data() + right};
}

// Returns the window's change at the first pixel, without its last column.
HWY_INLINE Words FirstChange(const GroupArrays& arrays, const LaneLayout& layout,
                             std::ptrdiff_t k) {
  auto change = hn::Zero(kWords);
  for (int i = -layout.before; i < layout.after; ++i) {
    const std::uint16_t* const column = arrays.changes + k * arrays.change_stride + i * Lanes();
    change = hn::Add(change, hn::Load(kWords, column));
  }
  return change;
}

// The scores of one disparity along the row. The window's change slides along the row,
// G(x + 1) = G(x) + E(x + after + 1) - E(x - before), and the score down the image,
// S(x, y + 1) = S(x, y) + G(x).
struct SlidingScore {
  HWY_INLINE Words At(std::ptrdiff_t j) {
    change = hn::Add(change, hn::Load(kWords, changes_in + j));
    const auto score = hn::Add(hn::Load(kWords, scores + j), change);
    hn::Store(score, kWords, scores + j);
    change = hn::Sub(change, hn::Load(kWords, changes_out + j));
    return score;
  }

  Words change;
  const std::uint16_t* changes_in;
  const std::uint16_t* changes_out;
  std::uint16_t* scores;
};

HWY_INLINE SlidingScore ScoreOf(const GroupArrays& arrays, const LaneLayout& layout,
                                std::ptrdiff_t k) {
  const std::uint16_t* const changes = arrays.changes + k * arrays.change_stride;
  return {FirstChange(arrays, layout, k), changes + Lanes() * layout.after,
          changes - Lanes() * layout.before, arrays.scores + k * arrays.score_stride};
}

// Updates the scores of a group without looking for the best.
void SlideGroup(const LaneLayout& layout, const GroupArrays& arrays) {
  for (std::ptrdiff_t k = 0; k < kGroup; ++k) {
    SlidingScore score = ScoreOf(arrays, layout, k);
    for (std::ptrdiff_t j = 0; j < Lanes() * layout.segment; j += Lanes()) score.At(j);
  }
}

// Updates the scores of a group and the best of left and right pixels. A left pixel of vector j has
// its four keys at j. A right pixel of vector j - d gets its four keys at j, j + 1, j + 2 and
// j + 3, so that its partial minima wait in registers. Disparities from the kInRange-th on are
// masked.
template <std::ptrdiff_t kInRange>
void ScoreGroup(const LaneLayout& layout, int group, const GroupArrays& arrays) {
  const std::ptrdiff_t lanes = Lanes();
  const auto number = hn::Set(kWords, static_cast<std::uint16_t>(group));
  const auto none = hn::Set(kWords, kNoKey);
  SlidingScore score[kGroup] = {ScoreOf(arrays, layout, 0), ScoreOf(arrays, layout, 1),
                                ScoreOf(arrays, layout, 2), ScoreOf(arrays, layout, 3)};
  Words waiting[kGroup - 1] = {none, none, none};
  const std::ptrdiff_t end = lanes * layout.segment;
  for (std::ptrdiff_t j = 0; j < end; j += lanes) {
    const auto left_mask = hn::Load(kWords, arrays.left_mask + j);
    Words key[kGroup] = {none, none, none, none};
    for (std::ptrdiff_t k = 0; k < kInRange; ++k) {
      const auto right_mask = hn::Load(kWords, arrays.right_mask + j - k * lanes);
      key[k] = hn::Or3(score[k].At(j), left_mask, right_mask);
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

// Scores the disparities of the group that are in the range, `in_range` or all four.
void ScoreGroup(int in_range, const LaneLayout& layout, int group, const GroupArrays& arrays) {
  switch (in_range) {
    case 1:
      return ScoreGroup<1>(layout, group, arrays);
    case 2:
      return ScoreGroup<2>(layout, group, arrays);
    case 3:
      return ScoreGroup<3>(layout, group, arrays);
    default:
      return ScoreGroup<kGroup>(layout, group, arrays);
  }
}

void PrepareGroup(const RowPair& rows, int group, CorrelatorState& state) {
  FindChanges(rows, group, state);
  for (int k = 0; k < kGroup; ++k) FillHalo(state.layout, state.Changes(k));
}

void SlideRow(int slot_in, int slot_out, CorrelatorState& state) {
  const RowPair rows = RowsOf(slot_in, slot_out, state);
  for (int group = 0; group < state.layout.groups; ++group) {
    PrepareGroup(rows, group, state);
    SlideGroup(state.layout, ArraysOf(group, state));
  }
}

void ScoreRow(int slot_in, int slot_out, CorrelatorState& state) {
  const LaneLayout& layout = state.layout;
  const RowPair rows = RowsOf(slot_in, slot_out, state);
  std::fill_n(state.left_key.data(), layout.row_size(), kNoKey);
  std::fill_n(state.right_key.data(), layout.wide_size(), kNoKey);
  for (int group = 0; group < layout.groups; ++group) {
    PrepareGroup(rows, group, state);
    ScoreGroup(layout.disparities - kGroup * group, layout, group, ArraysOf(group, state));
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(TargetName);
HWY_EXPORT(Lanes);
HWY_EXPORT(SlideRow);
HWY_EXPORT(ScoreRow);

const char* InstructionSet() { return HWY_DYNAMIC_DISPATCH(TargetName)(); }

int VectorLanes() { return HWY_DYNAMIC_DISPATCH(Lanes)(); }

void SlideRow(int slot_in, int slot_out, CorrelatorState& state) {
  HWY_DYNAMIC_DISPATCH(SlideRow)(slot_in, slot_out, state);
}

void ScoreRow(int slot_in, int slot_out, CorrelatorState& state) {
  HWY_DYNAMIC_DISPATCH(ScoreRow)(slot_in, slot_out, state);
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE

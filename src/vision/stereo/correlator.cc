#include "vision/stereo/correlator.h"

#include <algorithm>

#include "core/check.h"
#include "vision/stereo/correlator_state.h"

namespace rockyard::vision {
namespace {

void DropRow(std::span<std::int16_t> row) {
  std::fill(row.begin(), row.end(), Dropped(Drop::kOutside));
}

}  // namespace

void CorrelateRows(const GrayImage& left, const GrayImage& right,
                   const StereoPipelineParams& params, int first_row, int end_row,
                   DisparityImage& out) {
  EXPECT(left.width() == right.width() && left.height() == right.height());
  EXPECT(out.width() == left.width() && out.height() == left.height());
  EXPECT(0 <= first_row && end_row <= left.height());
  EXPECT(ScoresFit(params.dog, params.correlator));
  if (first_row >= end_row || left.width() == 0) return;
  CorrelatorState state(VectorLanes(), left.width(), params.correlator);
  const LaneLayout& layout = state.layout;
  const PeakLimits limits = MakePeakLimits(params.filters, params.correlator);
  const int first = std::clamp(layout.before, first_row, end_row);
  const int end = std::clamp(left.height() - layout.after, first, end_row);
  for (int y = first_row; y < first; ++y) DropRow(out.Row(y));
  for (int y = end; y < end_row; ++y) DropRow(out.Row(y));

  const int slots = state.slots();
  for (int y = first - layout.before; first < end && y < end + layout.after; ++y) {
    LoadRow(left.Row(y), right.Row(y), y % slots, state);
    const int oldest = y - slots + 1;
    const int out_slot = oldest < first - layout.before ? state.zero_slot() : oldest % slots;
    const int centre = y - layout.after;
    if (centre < first) {
      SlideRow(y % slots, out_slot, state);
      continue;
    }
    ScoreRow(y % slots, out_slot, state);
    GatherRightBest(state);
    DecideRow(limits, state);
    std::copy_n(state.row.data(), out.width(), out.Row(centre).data());
  }
}

}  // namespace rockyard::vision

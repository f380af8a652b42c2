#include "vision/stereo/correlator.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

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
    // Until the window is full no row leaves it, and the slot of zeros is taken off.
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

namespace {

// Writes kNoKey for each pixel of vectors first ... last whose window is not inside the image.
void FillMask(const LaneLayout& layout, int first, int last, std::uint16_t* mask) {
  for (int j = first; j <= last; ++j) {
    for (int lane = 0; lane < layout.lanes; ++lane) {
      *mask++ = layout.WindowInside(lane * layout.segment + j) ? 0 : kNoKey;
    }
  }
}

}  // namespace

PeakLimits MakePeakLimits(const StereoFilterParams& filters, const CorrelatorParams& correlator) {
  const auto side = static_cast<double>(correlator.window_side_px);
  return {filters.interpolation, static_cast<int>(filters.line_of_sight_px),
          static_cast<std::int32_t>(std::ceil(filters.min_curvature * side * side)),
          static_cast<std::int32_t>(std::ceil(filters.min_curvature_ratio * 256.0))};
}

LaneLayout::LaneLayout(int lanes_in, int width_in, const CorrelatorParams& params)
    : lanes(lanes_in),
      width(width_in),
      segment((width_in + 4 * lanes_in - 1) / (4 * lanes_in) * 4),
      before(static_cast<int>(params.window_side_px) / 2),
      after(static_cast<int>(params.window_side_px) - 1 - before),
      min_disparity(static_cast<int>(params.min_disparity_px)),
      disparities(static_cast<int>(params.disparities)),
      groups((disparities + kGroup - 1) / kGroup),
      first(std::min(0, -(min_disparity + kGroup * groups - 1))),
      last(std::max(segment - 1, segment - 1 - min_disparity)) {}

CorrelatorState::CorrelatorState(int lanes, int width, const CorrelatorParams& params)
    : layout(lanes, width, params),
      change_stride(Size(layout.segment + layout.before + layout.after + 2) * layout.lane_count()),
      left_rows(layout.row_size() * Size(slots() + 1)),
      right_rows(layout.wide_size() * Size(slots() + 1)),
      changes(change_stride * kGroup),
      scores(layout.row_size() * Size(kGroup * layout.groups + 2)),
      left_key(layout.row_size()),
      left_group(layout.row_size()),
      right_key(layout.wide_size()),
      right_group(layout.wide_size()),
      right_index(layout.wide_size()),
      left_mask(layout.row_size()),
      right_mask(layout.wide_size()),
      result(layout.row_size()),
      pixels(layout.row_size()),
      row(layout.row_size()) {
  FillMask(layout, 0, layout.segment - 1, left_mask.data());
  FillMask(layout, layout.first, layout.last, right_mask.data());
  for (int i = 0; i < kGroup * layout.groups; ++i) {
    std::fill_n(Scores(i), layout.row_size(), static_cast<std::uint16_t>(i % kGroup));
  }
}

}  // namespace rockyard::vision

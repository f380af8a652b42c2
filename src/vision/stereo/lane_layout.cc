#include "vision/stereo/lane_layout.h"

#include <algorithm>

namespace rockyard::vision {

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

}  // namespace rockyard::vision

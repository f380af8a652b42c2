#include "vision/stereo/subpixel.h"

#include <cmath>

namespace rockyard::vision {

PeakLimits MakePeakLimits(const StereoFilterParams& filters, const CorrelatorParams& correlator) {
  const auto side = static_cast<double>(correlator.window_side_px);
  return {filters.interpolation, static_cast<int>(filters.line_of_sight_px),
          static_cast<std::int32_t>(std::ceil(filters.min_curvature * side * side)),
          static_cast<std::int32_t>(std::ceil(filters.min_curvature_ratio * 256.0))};
}

}  // namespace rockyard::vision

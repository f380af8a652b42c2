// How a camera chooses its exposure time.
#pragma once

#include <vector>

#include "rendering/imager_params.h"

namespace rockyard::rendering {

// Returns the time, s, at which the loop of exposure control settles: where the metered pixels,
// less the brightest_share of them, reach target_fill of the full well by sunlight alone,
//   t = target_fill * full_well / (rate + dark current),
// within the limits. The loop sees nothing but how bright pixels are. `rates_e_s` are the
// photoelectrons per second of the metered pixels, in any order; where there are none, the time is
// the longest.
double ExposureTime(const ImagerParams& imager, std::vector<double> rates_e_s);

}  // namespace rockyard::rendering

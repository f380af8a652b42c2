// How the sensor chooses its exposure time.
#pragma once

#include <vector>

#include "sensing/imager_params.h"

namespace rockyard::sensing {

// Where the loop of exposure control settles: the time at which the metered pixels, less the
// brightest_share of them, reach target_fill of the full well without laser light,
//   t = target_fill * full_well / (rate + dark current),
// within the limits. It sees nothing but how bright pixels are. `rates_e_s`: photoelectrons per
// second of the metered pixels, in any order; the longest exposure where there are none.
double ExposureTime(const ImagerParams& imager, std::vector<double> rates_e_s);

}  // namespace rockyard::sensing

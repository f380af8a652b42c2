// What the experiment "stereo_sensing" writes down.
#pragma once

#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell: first the factors that name a cell, of which a scenario
// has those of its lists (StereoSensingParams::Factors), then what StereoSums holds.
const truth::RecordSchema& StereoColumns();

}  // namespace rockyard::experiments

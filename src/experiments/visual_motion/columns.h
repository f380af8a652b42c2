// What the experiment "visual_motion" writes down.
#pragma once

#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell: first the factors that name a cell, of which a scenario
// has those of its lists (VisualMotionStudyParams::Factors), then what VisualSums holds.
const truth::RecordSchema& VisualMotionColumns();

}  // namespace rockyard::experiments

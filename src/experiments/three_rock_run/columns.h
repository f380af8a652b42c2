// What the experiment "three_rock_run" writes down of one run.
#pragma once

#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell, in the order of ThreeRockRecord (three_rock_record.h).
const truth::RecordSchema& ThreeRockColumns();

}  // namespace rockyard::experiments

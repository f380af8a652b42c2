// What the experiment "dead_reckoning" writes down.
#pragma once

#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell: first the factors that name a cell, then what WalkSums
// holds.
const truth::RecordSchema& DeadReckoningColumns();

}  // namespace rockyard::experiments

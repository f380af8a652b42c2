// What the studies of the experiment "hazard_detection" write down.
#pragma once

#include "truth/record.h"

namespace rockyard::experiments {

// Every column of any study but the number of the cell: first the factors that name a cell, then
// the bases, and counts and sums of these. A study takes those that it measures
// (HazardStudyRunner::columns), and its factors those of their lists (CellFactor::column).
const truth::RecordSchema& HazardColumns();

}  // namespace rockyard::experiments

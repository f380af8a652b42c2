// What the experiment "cylinder_sighting" writes down.
#pragma once

#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell: the factors that may name a cell, then the sums of
// SightingSums in their order.
const truth::RecordSchema& CylinderSightingColumns();

}  // namespace rockyard::experiments

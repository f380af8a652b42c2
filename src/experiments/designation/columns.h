// What the experiment "designation" writes down.
#pragma once

#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell: the range that names a cell, then what DesignationSums
// holds, in its order.
const truth::RecordSchema& DesignationColumns();

}  // namespace rockyard::experiments

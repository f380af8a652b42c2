// What the experiment "mission" writes down of one mission.
#pragma once

#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell and those of sols (mission.sol_columns), in the order of
// ForEachMissionColumn (mission_record.h).
const truth::RecordSchema& MissionColumns();

}  // namespace rockyard::experiments

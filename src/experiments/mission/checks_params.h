// What the experiment "mission" takes for granted of its drives.
#pragma once

#include "core/fields.h"
#include "experiments/mission/mission_params.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// Requires fixed rocks in an open arena that holds every goal, drives to one goal each, one
// activity at a time, a day that the evening fits into, and a sun that rises. Each failure names
// the parameter, what is wrong and a remedy.
void RequireMission(const MissionParams& mission, const trial::DriveParams& drive,
                    core::FieldVisitor& v);

}  // namespace rockyard::experiments

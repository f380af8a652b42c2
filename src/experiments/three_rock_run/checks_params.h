// What the experiment "three_rock_run" takes for granted of its drive.
#pragma once

#include "core/fields.h"
#include "experiments/three_rock_run/three_rock_run_params.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// Requires the light stripe and a navigator that reads its reports, level ground without rocks of
// its own in an open arena that holds the longest course, and a straight course from the origin.
// Each failure names the parameter, what is wrong and a remedy.
void RequireThreeRockRun(const ThreeRockRunParams& run, const trial::DriveParams& drive,
                         core::FieldVisitor& v);

}  // namespace rockyard::experiments

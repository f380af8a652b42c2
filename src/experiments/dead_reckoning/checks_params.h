// What the experiment "dead_reckoning" takes for granted of the drive whose odometry it runs.
#pragma once

#include "core/fields.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// Requires that the drive's estimator is the dead reckoning that is measured. A failure names the
// parameter, what is wrong and a remedy.
void RequireDeadReckoning(const trial::DriveParams& drive, core::FieldVisitor& v);

}  // namespace rockyard::experiments

// What the experiment "visual_motion" takes for granted of the drive whose cameras it measures.
#pragma once

#include "core/fields.h"
#include "experiments/visual_motion/visual_motion_study_params.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// Requires level ground, on which the experiment stands the rover. A failure names the parameter,
// what is wrong and a remedy.
void RequireVisualMotion(const VisualMotionStudyParams& study, const trial::DriveParams& drive,
                         core::FieldVisitor& v);

}  // namespace rockyard::experiments

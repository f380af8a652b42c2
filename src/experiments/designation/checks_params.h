// What the experiment "designation" takes for granted of the lander's cameras.
#pragma once

#include "core/fields.h"
#include "experiments/designation/designation_study_params.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// Requires that both cameras image the goal of every range, wide of the image's edges. Each failure
// names the parameter, what is wrong and a remedy.
void RequireDesignable(const DesignationStudyParams& study, const trial::DriveParams& drive,
                       core::FieldVisitor& v);

}  // namespace rockyard::experiments

// What the experiment "stereo_sensing" takes for granted of the drive whose cameras it measures.
#pragma once

#include "core/fields.h"
#include "experiments/stereo_sensing/stereo_sensing_params.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// Requires that stereo is the sensor in use, with both its eyes and all that they see, on level
// ground with round rocks; that the navigator reads points; and that the cells are something that
// the cameras can measure. Each failure names the parameter, what is wrong and a remedy.
void RequireStereoMeasurable(const StereoSensingParams& study, const trial::DriveParams& drive,
                             core::FieldVisitor& v);

}  // namespace rockyard::experiments

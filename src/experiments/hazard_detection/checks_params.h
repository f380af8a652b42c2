// What the experiment "hazard_detection" takes for granted of the drive whose sensor it measures.
#pragma once

#include "core/fields.h"
#include "experiments/hazard_detection/hazard_detection_params.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// Requires that the light stripe is the sensor in use, on flat ground, with scans that each pose
// takes for itself, and of the study in use that its lists ask for what sensor, rocks and course
// can show. Each failure names the parameter, what is wrong and a remedy.
void RequireMeasurable(const HazardDetectionParams& study, const trial::DriveParams& drive,
                       core::FieldVisitor& v);

}  // namespace rockyard::experiments

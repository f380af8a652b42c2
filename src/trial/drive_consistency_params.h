// Conditions across modules without which no trial can be built or would mean anything.
#pragma once

#include "core/fields.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// When the light stripe sensor has a part in an experiment.
enum class LightStripeUse {
  kAsTerrainSensor,  // where sensors.terrain_sensor chooses it
  kAlways,           // the experiment measures it
};

// Requires, for every experiment:
// - start and goal lie in the arena, between the mirror lines of a virtual one;
// - no more than one control step per step of the physics, and rocks that move only in multibody;
// - the goal radius holds the tolerance of the navigator in use;
// - the behaviour controller names every stripe of the array that it judges;
// - where the light stripe is used: its finder averages no more lines than are read, and the rover
//   hides no point of flat ground from its images.
// Each failure names the parameter, what is wrong and a remedy.
void RequireConsistency(const DriveParams& drive, LightStripeUse light_stripe,
                        core::FieldVisitor& v);

}  // namespace rockyard::trial

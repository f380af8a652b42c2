// What the experiment "cylinder_sighting" takes for granted of its views.
#pragma once

#include "core/fields.h"
#include "experiments/cylinder_sighting/cylinder_sighting_params.h"

namespace rockyard::experiments {

// Requires that the whole cylinder lies in both images at every distance and bearing. A failure
// names the parameter, what is wrong and a remedy.
void RequireSightable(const CylinderSightingParams& study, core::FieldVisitor& v);

}  // namespace rockyard::experiments

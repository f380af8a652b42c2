// The part of the light stripe sensor's parameters that says where stripes are looked for, and how
// often that goes wrong at the geometric level.
#pragma once

#include "core/fields.h"
#include "sensing/light_stripe_params.h"

namespace rockyard::sensing {

// Visits search range, greatest range and errors of detection.
void VisitStripeDetection(LightStripeParams& params, core::FieldVisitor& v);

}  // namespace rockyard::sensing

// What the rover of a trial believes of its own geometry: the truth plus the errors of the scenario
// (perception.calibration).
#pragma once

#include "messages/calibration.h"
#include "perception/calibration_params.h"
#include "rover/rover_params.h"
#include "sensing/light_stripe_params.h"

namespace rockyard::trial {

// Equal to the truth, bit for bit, where all errors are zero.
messages::DriveCalibration OnboardDriveCalibration(
    const rover::RoverParams& rover, const perception::DriveCalibrationErrors& errors);
messages::StripeCalibration OnboardStripeCalibration(
    const sensing::LightStripeParams& sensor, const perception::CalibrationErrorParams& errors);

}  // namespace rockyard::trial

// What the rover of a trial believes of its own geometry: the truth plus the errors of the scenario
// (perception.calibration). Must stay: the one place where truth and these errors meet. Estimators,
// wheel driver, detectors and readers of all sensors take the errors from here, studies without a
// drive too. Every error is what is believed less what is true, steering_offset_rad the reverse;
// records depend on signs and axes (perception/calibration_params.h). Stereo cameras without their
// errors are sensing::CalibratedRig and MakeStereoView.
#pragma once

#include <optional>

#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/look_images.h"
#include "messages/point_cloud.h"
#include "perception/calibration_params.h"
#include "perception/hazard_params.h"
#include "rover/rover_params.h"
#include "sensing/light_stripe_params.h"
#include "sensing/stereo_params.h"

namespace rockyard::trial {

// Return the believed drive geometry and light stripe sensor. Must stay: where all errors are zero
// they equal the truth bit for bit.
messages::DriveCalibration OnboardDriveCalibration(
    const rover::RoverParams& rover, const perception::DriveCalibrationErrors& errors);
messages::StripeCalibration OnboardStripeCalibration(
    const sensing::LightStripeParams& sensor, const perception::CalibrationErrorParams& errors);

// Returns what the rover believes of its body, for navigators.
messages::RoverBelief OnboardRoverBelief(const rover::RoverParams& rover,
                                         const perception::DriveCalibrationErrors& errors,
                                         const perception::VehicleHazardParams& felt);

// Returns how a wrong mount displaces the points that a pair of stereo cameras sees,
//   p_believed = X_RC_believed X_RC_true^-1 p_true,
// with C at the middle of the pair, x along its optical axis, y to its left. Nothing where all
// errors are zero, so that points stay as they are, bit for bit. What the pair sees follows its
// true mount.
std::optional<math::Transform> StereoMisplacement(const sensing::StereoParams& sensor,
                                                  const perception::CalibrationErrorParams& errors,
                                                  messages::LookDirection direction);

// The cameras of a pair in R, linear ones, as the rover believes that they are mounted.
struct BelievedCameras {
  messages::LinearCamera left;
  messages::LinearCamera right;
};

// Returns the calibrated cameras (sensing::CalibratedCameras) where a wrong mount puts them.
BelievedCameras OnboardCameras(const sensing::StereoParams& sensor,
                               const perception::CalibrationErrorParams& errors,
                               messages::LookDirection direction);

}  // namespace rockyard::trial

#include "localization/dead_reckoning.h"

#include <algorithm>
#include <cmath>

namespace rockyard::localization {

DeadReckoning::DeadReckoning(const messages::DriveCalibration& calibration,
                             const DeadReckoningParams& params, const math::Pose2& initial)
    : calibration_(calibration), params_(params) {
  Apply({initial.x_m, initial.y_m, initial.heading_rad});
}

double DeadReckoning::MeanRoll(const messages::MotionMeasurement& motion) const {
  const bool all_steered = std::all_of(calibration_.steered.begin(), calibration_.steered.end(),
                                       [](bool steered) { return steered; });
  const bool every_wheel = params_.wheels != OdometryWheels::kUnsteered || all_steered;
  const bool forward = params_.wheels == OdometryWheels::kForward;
  double sum = 0.0;
  int count = 0;
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    // kUnsteered: wheels that do not steer roll the rover's own way on an arc.
    if (!every_wheel && calibration_.steered[wheel]) continue;
    // A steered wheel rolls along its own heading; its forward part is the cosine of the steering
    // angle.
    const double share = forward ? std::cos(motion.steer_rad[wheel]) : 1.0;
    sum += motion.wheel_turn_rad[wheel] * calibration_.radius_ratio[wheel] * share;
    ++count;
  }
  return sum / count;
}

void DeadReckoning::Integrate(const messages::MotionMeasurement& motion) {
  // dr = mean wheel turn (rad) times believed radius (m) times scale.
  const double forward_m = MeanRoll(motion) * calibration_.wheel_radius_m * params_.distance_scale;
  // Midpoint: exact to second order on an arc. The paper's equations use the heading at the start.
  const double along_rad =
      estimate_.heading_rad +
      (params_.step_heading == StepHeading::kMidpoint ? 0.5 * motion.turn_rad : 0.0);
  estimate_.x_m += forward_m * std::cos(along_rad);
  estimate_.y_m += forward_m * std::sin(along_rad);
  estimate_.heading_rad = math::WrapAngle(estimate_.heading_rad + motion.turn_rad);
  // The odometer counts driving backwards as well.
  estimate_.distance_m += std::abs(forward_m);
}

void DeadReckoning::Apply(const messages::PoseUpdate& update) {
  estimate_.x_m = update.x_m;
  estimate_.y_m = update.y_m;
  estimate_.heading_rad = math::WrapAngle(update.heading_rad);
}

}  // namespace rockyard::localization

#include "localization/dead_reckoning.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/check.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::localization {

double ForwardStep(const messages::PoseEstimate& before, const messages::PoseEstimate& after) {
  const double turn_rad = math::WrapAngle(after.heading_rad - before.heading_rad);
  // On an arc the chord points along the mean of both headings.
  const double along_rad = before.heading_rad + 0.5 * turn_rad;
  return (after.x_m - before.x_m) * math::Cos(along_rad) +
         (after.y_m - before.y_m) * math::Sin(along_rad);
}

void AttitudeEstimator::Filter(const math::Vector3& force_R, double duration_s) {
  // The first measurement is taken as it is, and every one where there is no filter.
  if (!force_R_ || params_.filter_s <= 0.0) {
    force_R_ = force_R;
    return;
  }
  // First-order low pass over a tick: f += (1 - e^(-dt/T)) (f_now - f), exact for a force that
  // stays.
  *force_R_ += -math::Expm1(-duration_s / params_.filter_s) * (force_R - *force_R_);
}

void AttitudeEstimator::Integrate(const messages::VehicleState& state, double forward_m,
                                  double duration_s) {
  EXPECT(duration_s > 0.0);
  if (params_.source == AttitudeSource::kAccelerometers && state.specific_force_R) {
    Filter(*state.specific_force_R, duration_s);
    const math::Vector3& f = *force_R_;
    if (f.squaredNorm() > 0.0) {
      // f = g (-sin p, sin r cos p, cos r cos p) at rest, in R. |(f_y, f_z)| = g cos p >= 0, so
      // pitch stays within +-90 deg; roll needs no g.
      estimate_.pitch_rad = math::Atan2(-f.x(), math::Hypot(f.y(), f.z()));
      estimate_.roll_rad = math::Atan2(f.y(), f.z());
    }
  }
  if (params_.height == HeightSource::kIntegrated) {
    // Positive pitch has the nose down, so driving forward loses height.
    estimate_.z_m -= forward_m * math::Sin(estimate_.pitch_rad);
  }
}

namespace {

// Returns the mean of the wheels' turns as if all had wheel_radius_m, rad.
double MeanRoll(const messages::MotionMeasurement& motion,
                const messages::DriveCalibration& calibration, OdometryWheels wheels) {
  const bool all_steered = std::all_of(calibration.steered.begin(), calibration.steered.end(),
                                       [](bool steered) { return steered; });
  // Where all wheels steer, none would be left to take the mean of.
  const bool every_wheel = wheels != OdometryWheels::kUnsteered || all_steered;
  const bool forward = wheels == OdometryWheels::kForward;
  double sum = 0.0;
  int count = 0;
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    // kUnsteered: wheels that do not steer roll the rover's own way on an arc.
    if (!every_wheel && calibration.steered[wheel]) continue;
    // A steered wheel rolls along its own heading; its forward part is the cosine of the steering
    // angle.
    const double share = forward ? math::Cos(motion.steer_rad[wheel]) : 1.0;
    sum += motion.wheel_turn_rad[wheel] * calibration.radius_ratio[wheel] * share;
    ++count;
  }
  return sum / count;
}

}  // namespace

double ForwardIncrement(const messages::MotionMeasurement& motion,
                        const messages::DriveCalibration& calibration,
                        const DeadReckoningParams& params) {
  // dr = mean wheel turn (rad) times believed radius (m) times scale.
  return MeanRoll(motion, calibration, params.wheels) * calibration.wheel_radius_m *
         params.distance_scale;
}

void Advance(double forward_m, double turn_rad, StepHeading step_heading,
             messages::PoseEstimate& pose) {
  // The midpoint is exact to second order on an arc; Matthies 1995 takes the heading at the start.
  const double along_rad =
      pose.heading_rad + (step_heading == StepHeading::kMidpoint ? 0.5 * turn_rad : 0.0);
  pose.x_m += forward_m * math::Cos(along_rad);
  pose.y_m += forward_m * math::Sin(along_rad);
  pose.heading_rad = math::WrapAngle(pose.heading_rad + turn_rad);
  pose.distance_m += std::abs(forward_m);
}

DeadReckoning::DeadReckoning(const messages::DriveCalibration& calibration,
                             const DeadReckoningParams& params, const math::Pose2& initial)
    : calibration_(calibration), params_(params) {
  Apply({initial.x_m, initial.y_m, initial.heading_rad});
}

void DeadReckoning::Integrate(const messages::MotionMeasurement& motion) {
  Advance(ForwardIncrement(motion, calibration_, params_), motion.turn_rad, params_.step_heading,
          estimate_);
}

void DeadReckoning::Apply(const messages::PoseUpdate& update) {
  estimate_.x_m = update.x_m;
  estimate_.y_m = update.y_m;
  estimate_.heading_rad = math::WrapAngle(update.heading_rad);
}

DeadReckoningEstimator::DeadReckoningEstimator(const EstimatorSetup& setup)
    : dead_reckoning_(setup.calibration, setup.dead_reckoning, setup.start),
      attitude_(setup.attitude),
      felt_pose_(dead_reckoning_.estimate()) {
  TakePose();
}

void DeadReckoningEstimator::Propagate(const messages::MotionMeasurement& motion) {
  dead_reckoning_.Integrate(motion);
  TakePose();
}

void DeadReckoningEstimator::Feel(const messages::VehicleState& felt, double duration_s) {
  attitude_.Integrate(felt, ForwardStep(felt_pose_, dead_reckoning_.estimate()), duration_s);
  felt_pose_ = dead_reckoning_.estimate();
  estimate_.attitude = attitude_.estimate();
}

void DeadReckoningEstimator::Place(const messages::PoseUpdate& update) {
  dead_reckoning_.Apply(update);
  attitude_.Restart();
  felt_pose_ = dead_reckoning_.estimate();
  TakePose();
}

void DeadReckoningEstimator::TakePose() {
  estimate_.pose = dead_reckoning_.estimate();
  estimate_.odometry = estimate_.pose;
}

EstimatorDescription<core::NoParams> DescribeDeadReckoning() {
  return {
      .name = "dead_reckoning",
      .doc = "wheels, gyro and accelerometers",
      .make = [](const core::NoParams&, const EstimatorSetup& setup) -> std::unique_ptr<Estimator> {
        return std::make_unique<DeadReckoningEstimator>(setup);
      }};
}

}  // namespace rockyard::localization

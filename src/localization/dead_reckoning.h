// Dead reckoning: the pose from wheels and gyro; roll, pitch and height from accelerometers and the
// distance driven. It is an estimator of its own; the other estimators on board build on its parts,
// and so does the experiment that measures how the error of dead reckoning grows.
//
// Pose (Matthies 1995, section 5): x += dr cos(h), y += dr sin(h), heading += dtheta, with dr the
// mean wheel increment times the believed wheel radius and the distance scale, dtheta the
// integrated gyro rate, and h the heading at the middle or at the start of the step. When the rover
// turns in place the increments of left and right wheels cancel in the mean. Must stay: the
// error-state filter goes on by ForwardIncrement and Advance as well, so that without aids its pose
// is that of DeadReckoning to the last bit.
//
// Attitude: at rest the specific force f points up. With R turned by heading, pitch and roll as in
// math::MakePose, its direction is (-sin p, sin r cos p, cos r cos p), so that
//   pitch = atan2(-f_x, |(f_y, f_z)|),  roll = atan2(f_y, f_z),
// of f after a first-order low pass, f += (1 - exp(-dt / filter_s)) (f_now - f). Height grows by
// the distance driven times the sine of the climb: z -= dr sin(pitch).
//
// Errors of the attitude: the rover's own acceleration a looks like a tilt of atan(a / g), for
// about filter_s; a constant bias b of an accelerometer is a tilt of b / g and a lasting slope of
// the same size in z; roll and pitch lag behind by filter_s, 2.5 cm at 5 cm/s; z keeps what slip, a
// wrong wheel radius and wheels that climb one after the other make of it, and nothing pulls it
// back.
#pragma once

#include <optional>

#include "localization/dead_reckoning_params.h"
#include "localization/estimator.h"
#include "localization/estimator_set_params.h"
#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/estimates.h"
#include "messages/measurements.h"
#include "messages/vehicle_state.h"

namespace rockyard::localization {

// Returns the signed distance along the mean heading from one pose estimate to the next one, a tick
// later, m.
double ForwardStep(const messages::PoseEstimate& before, const messages::PoseEstimate& after);

// The attitude and height that the rover believes.
class AttitudeEstimator {
 public:
  explicit AttitudeEstimator(const AttitudeParams& params) : params_(params) {}

  // Takes one on-board tick of duration_s > 0, in which odometry drove forward_m (negative
  // backwards). Roll and pitch stay what they were where `state` has no accelerometers or no force.
  void Integrate(const messages::VehicleState& state, double forward_m, double duration_s);

  // Forgets the filtered force, after operators moved the rover; the height stays.
  void Restart() { force_R_.reset(); }

  const messages::AttitudeEstimate& estimate() const { return estimate_; }

 private:
  void Filter(const math::Vector3& force_R, double duration_s);

  AttitudeParams params_;
  std::optional<math::Vector3> force_R_;  // after the low pass, m/s2
  messages::AttitudeEstimate estimate_;
};

// Returns the distance dr of one tick, m: the mean of the wheels' turns times believed radius and
// distance scale. A wheel at (x, y) that rolls along an arc about (0, R) goes forward by the turn
// times R - y, whatever its x: with steering taken into account (OdometryWheels::kForward) the mean
// over both sides is the arc of the rover's origin.
double ForwardIncrement(const messages::MotionMeasurement& motion,
                        const messages::DriveCalibration& calibration,
                        const DeadReckoningParams& params);

// Moves `pose` on by a step of forward_m and turn_rad. Headings stay within [-pi, pi]; the odometer
// counts driving backwards as well.
void Advance(double forward_m, double turn_rad, StepHeading step_heading,
             messages::PoseEstimate& pose);

// The pose that the rover believes.
class DeadReckoning {
 public:
  DeadReckoning(const messages::DriveCalibration& calibration, const DeadReckoningParams& params,
                const math::Pose2& initial);

  // Adds one on-board tick. Headings stay within [-pi, pi].
  void Integrate(const messages::MotionMeasurement& motion);

  // Takes the pose that operators tell (lander update, arena reflection). The odometer stays.
  void Apply(const messages::PoseUpdate& update);

  const messages::PoseEstimate& estimate() const { return estimate_; }

 private:
  messages::DriveCalibration calibration_;
  DeadReckoningParams params_;
  messages::PoseEstimate estimate_;
};

// The estimator as flown: pose by dead reckoning, attitude by accelerometers, nothing else. It
// keeps no account of its error and takes no aids; operators tell it where it is.
class DeadReckoningEstimator final : public Estimator {
 public:
  explicit DeadReckoningEstimator(const EstimatorSetup& setup);

  void Propagate(const messages::MotionMeasurement& motion) override;
  void Feel(const messages::VehicleState& felt, double duration_s) override;
  void Place(const messages::PoseUpdate& update) override;

  const messages::LocalizationEstimate& estimate() const override { return estimate_; }

 private:
  // Takes over the pose as estimate_.pose and as estimate_.odometry: they are equal, as nothing
  // corrects the pose.
  void TakePose();

  DeadReckoning dead_reckoning_;
  AttitudeEstimator attitude_;
  messages::PoseEstimate felt_pose_;  // at the last Feel
  messages::LocalizationEstimate estimate_;
};

// Describes the estimator that scenarios name dead_reckoning; its parameters are those of the
// setup.
EstimatorDescription<core::NoParams> DescribeDeadReckoning();

}  // namespace rockyard::localization

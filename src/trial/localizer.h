// Where the rover of a trial believes to be, and how it believes to stand.
#pragma once

#include "math/pose.h"
#include "messages/estimates.h"
#include "messages/measurements.h"
#include "messages/vehicle_state.h"
#include "perception/attitude.h"
#include "perception/dead_reckoning.h"
#include "trial/drive_params.h"
#include "truth/rover_state.h"

namespace rockyard::trial {

// Dead reckoning and accelerometers or, with sensors.localization oracle, all six degrees of
// freedom of the true pose.
class Localizer {
 public:
  Localizer(const DriveParams& drive, const math::Pose2& start);

  // The rover is put down at the start.
  void Place(const truth::RoverState& state);

  // One on-board tick of odometry; a rover that stands has one too.
  void Integrate(const messages::MotionMeasurement& motion, const truth::RoverState& state);

  // What the rover felt over the last `duration_s` > 0, after Integrate.
  void UpdateAttitude(const messages::VehicleState& felt, double duration_s);

  // Operators moved the rover by hand.
  void Apply(const messages::PoseUpdate& update);

  const messages::PoseEstimate& pose() const { return dead_reckoning_.estimate(); }
  const messages::AttitudeEstimate& attitude() const {
    return oracle_ ? true_attitude_ : attitude_.estimate();
  }

  // Believed less true height above the start, m.
  double HeightError(const truth::RoverState& state) const;

 private:
  bool oracle_;
  perception::DeadReckoning dead_reckoning_;
  perception::AttitudeEstimator attitude_;
  messages::PoseEstimate last_pose_;  // pose at the last UpdateAttitude
  messages::AttitudeEstimate true_attitude_;
  double start_z_m_ = 0.0;
};

}  // namespace rockyard::trial

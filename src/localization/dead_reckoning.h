// Dead reckoning from wheel encoders and gyro (Matthies 1995, section 5):
//   x += dr cos(h), y += dr sin(h), heading += dtheta
// with dr the mean wheel increment times the believed wheel radius and the distance scale, dtheta
// the integrated gyro rate, and h the heading at the middle or at the start of the step. When the
// rover turns in place the increments of left and right wheels cancel in the mean.
#pragma once

#include "localization/dead_reckoning_params.h"
#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/estimates.h"
#include "messages/measurements.h"

namespace rockyard::localization {

// Returns the distance dr of one tick, m: the mean of the wheels' turns times believed radius and
// distance scale. A wheel at (x, y) that rolls along an arc about (0, R) goes forward by the turn
// times R - y, whatever its x: with steering taken into account the mean over both sides is the arc
// of the rover's origin.
double ForwardIncrement(const messages::MotionMeasurement& motion,
                        const messages::DriveCalibration& calibration,
                        const DeadReckoningParams& params);

// Lays a step of forward_m and turn_rad off. Headings stay within [-pi, pi]; the odometer counts
// driving backwards as well.
void Advance(double forward_m, double turn_rad, StepHeading step_heading,
             messages::PoseEstimate& pose);

// The pose that the rover believes.
class DeadReckoning {
 public:
  DeadReckoning(const messages::DriveCalibration& calibration, const DeadReckoningParams& params,
                const math::Pose2& initial);

  // Adds one on-board tick. Headings stay within [-pi, pi].
  void Integrate(const messages::MotionMeasurement& motion);

  // Takes an absolute correction from outside (lander update, arena reflection). The odometer
  // keeps.
  void Apply(const messages::PoseUpdate& update);

  const messages::PoseEstimate& estimate() const { return estimate_; }

 private:
  messages::DriveCalibration calibration_;
  DeadReckoningParams params_;
  messages::PoseEstimate estimate_;
};

}  // namespace rockyard::localization

// Roll, pitch and height from accelerometers and odometry.
//
// At rest the specific force f points up. With R turned by heading, pitch and roll as in
// math::MakePose, its direction is (-sin p, sin r cos p, cos r cos p), so that
//   pitch = atan2(-f_x, |(f_y, f_z)|),  roll = atan2(f_y, f_z),
// of f after a first-order low pass, f += (1 - exp(-dt / filter_s)) (f_now - f). Height grows by
// the distance driven times the sine of the climb: z -= dr sin(pitch).
//
// Errors that follow: the rover's own acceleration a looks like a tilt of atan(a / g), for about
// filter_s; a constant bias b of an accelerometer is a tilt of b / g and, at z, a slope of the same
// size for ever; the estimate lags behind by filter_s, 2.5 cm at 5 cm/s; z keeps what slip,
// believed wheel radius and wheels that climb in turn make of it, and has nothing that pulls it
// back.
#pragma once

#include <optional>

#include "localization/attitude_params.h"
#include "math/pose.h"
#include "messages/estimates.h"
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
  // backwards). Without accelerometers in `state`, or without any force, the attitude stays what it
  // was.
  void Integrate(const messages::VehicleState& state, double forward_m, double duration_s);

  // Forgets what the filter holds, after operators moved the rover; the height stays.
  void Restart() { force_R_.reset(); }

  const messages::AttitudeEstimate& estimate() const { return estimate_; }

 private:
  void Filter(const math::Vector3& force_R, double duration_s);

  AttitudeParams params_;
  std::optional<math::Vector3> force_R_;  // after the low pass, m/s2
  messages::AttitudeEstimate estimate_;
};

}  // namespace rockyard::localization

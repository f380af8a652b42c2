// A rover in the plane whose sensors err exactly as a filter's parameters say.
#pragma once

#include <cmath>

#include "core/random.h"
#include "localization/error_state_filter.h"
#include "math/pose.h"

namespace rockyard::localization {

inline constexpr double kWheelRadius_m = 0.065;

inline EstimatorSetup FilterSetup() {
  return EstimatorSetup{.calibration = {.wheel_radius_m = kWheelRadius_m},
                        .start = {1.0, -2.0, 0.3}};
}

inline messages::MotionMeasurement Rolled(double forward_m, double turn_rad, double duration_s) {
  messages::MotionMeasurement motion{.duration_s = duration_s};
  motion.wheel_turn_rad.fill(forward_m / kWheelRadius_m);
  motion.turn_rad = turn_rad;
  return motion;
}

// Of x and y, both with that standard deviation.
inline messages::PoseFix PlaceFix(messages::CaptureNumber capture, double x_m, double y_m,
                                  double sd_m) {
  messages::PoseFix fix{.capture = capture, .measured = {}};
  fix.measured.set(error::kX).set(error::kY);
  fix.pose[error::kX] = x_m;
  fix.pose[error::kY] = y_m;
  fix.covariance *= sd_m * sd_m;
  return fix;
}

// The truth, and what its wheels and its gyro measure of it.
class FilterRover {
 public:
  FilterRover(const ErrorStateFilterParams& params, const math::Pose2& start, core::TrialKey key)
      : params_(params), pose_(start), stream_(key, core::Purpose::kTest) {
    bias_rad_s_ = Normal(params.prior.gyro_bias_sd_rad_s);
    gyro_scale_ = 1.0 + Normal(params.prior.gyro_scale_sd);
    wheel_scale_ = 1.0 + Normal(params.prior.wheel_scale_sd);
  }

  double Normal(double deviation) { return core::SampleNormal(stream_, 0.0, deviation); }

  // One tick in which the wheels roll `rolled_m` and the rover turns by `turn_rad`.
  messages::MotionMeasurement Drive(double rolled_m, double turn_rad, double duration_s) {
    const DriftParams& drift = params_.drift;
    const double way_m = rolled_m * wheel_scale_ +
                         Normal(std::sqrt(drift.distance_variance_m2_per_m * std::abs(rolled_m)));
    const double noise_rad = Normal(std::sqrt(drift.heading_variance_rad2_per_s() * duration_s));
    const double along_rad = pose_.heading_rad + 0.5 * turn_rad;
    pose_.x_m += way_m * std::cos(along_rad);
    pose_.y_m += way_m * std::sin(along_rad);
    pose_.heading_rad = math::WrapAngle(pose_.heading_rad + turn_rad);
    return Rolled(rolled_m, gyro_scale_ * turn_rad + bias_rad_s_ * duration_s + noise_rad,
                  duration_s);
  }

  const math::Pose2& pose() const { return pose_; }
  double bias_rad_s() const { return bias_rad_s_; }
  double gyro_scale() const { return gyro_scale_; }
  double wheel_scale() const { return wheel_scale_; }

 private:
  ErrorStateFilterParams params_;
  math::Pose2 pose_;
  core::RandomStream stream_;
  double bias_rad_s_ = 0.0;
  double gyro_scale_ = 1.0;
  double wheel_scale_ = 1.0;
};

}  // namespace rockyard::localization

#include "localization/error_stretch.h"

#include <cmath>

namespace rockyard::localization {
namespace {

// What one tick makes of the errors: A, of which most is the unit matrix.
ErrorMatrix TickTransition(const MotionTick& tick, double tilt_kept) {
  const double across_x = -tick.forward_m * std::sin(tick.along_rad);  // d x / d a
  const double across_y = tick.forward_m * std::cos(tick.along_rad);
  const double rolled_m = tick.forward_m / tick.wheel_scale;
  const double turn_bias = -tick.duration_s / tick.gyro_scale;
  const double turn_scale = -tick.turn_rad / tick.gyro_scale;
  ErrorMatrix A = ErrorMatrix::Identity();
  A(error::kHeading, error::kGyroBias) = turn_bias;
  A(error::kHeading, error::kGyroScale) = turn_scale;
  A(error::kX, error::kHeading) = across_x;
  A(error::kY, error::kHeading) = across_y;
  A(error::kX, error::kGyroBias) = across_x * tick.turn_share * turn_bias;
  A(error::kY, error::kGyroBias) = across_y * tick.turn_share * turn_bias;
  A(error::kX, error::kGyroScale) = across_x * tick.turn_share * turn_scale;
  A(error::kY, error::kGyroScale) = across_y * tick.turn_share * turn_scale;
  A(error::kX, error::kWheelScale) = std::cos(tick.along_rad) * rolled_m;
  A(error::kY, error::kWheelScale) = std::sin(tick.along_rad) * rolled_m;
  A(error::kZ, error::kPitch) = -tick.forward_m * std::cos(tick.pitch_rad);
  A(error::kZ, error::kWheelScale) = -rolled_m * std::sin(tick.pitch_rad);
  A(error::kRoll, error::kRoll) = tilt_kept;
  A(error::kPitch, error::kPitch) = tilt_kept;
  return A;
}

// What a tick's own noise adds to the covariance.
void AddTickNoise(const MotionTick& tick, const TickNoise& noise, ErrorMatrix& N) {
  const double c = std::cos(tick.along_rad);
  const double s = std::sin(tick.along_rad);
  // n_h turns the step as well, by its share.
  ErrorVector turned = ErrorVector::Zero();
  turned[error::kX] = -tick.forward_m * s * tick.turn_share;
  turned[error::kY] = tick.forward_m * c * tick.turn_share;
  turned[error::kHeading] = 1.0;
  N += noise.heading_rad2 * turned * turned.transpose();
  N(error::kX, error::kX) += noise.distance_m2 * c * c;
  N(error::kX, error::kY) += noise.distance_m2 * c * s;
  N(error::kY, error::kX) += noise.distance_m2 * c * s;
  N(error::kY, error::kY) += noise.distance_m2 * s * s;
  N(error::kZ, error::kZ) += noise.height_m2;
  N(error::kGyroBias, error::kGyroBias) += noise.bias_rad2_s2;
  const double tilt = (1.0 - noise.tilt_kept * noise.tilt_kept) * noise.tilt_rad2;
  N(error::kRoll, error::kRoll) += tilt;
  N(error::kPitch, error::kPitch) += tilt;
}

}  // namespace

void ErrorStretch::Add(const MotionTick& tick, const TickNoise& noise) {
  const ErrorMatrix A = TickTransition(tick, noise.tilt_kept);
  transition_ = A * transition_;
  noise_ = A * noise_ * A.transpose();
  AddTickNoise(tick, noise, noise_);
  way_m_ += std::abs(tick.forward_m);
  empty_ = false;
}

void ErrorStretch::Restart() {
  transition_.setIdentity();
  noise_.setZero();
  way_m_ = 0.0;
  empty_ = true;
}

}  // namespace rockyard::localization

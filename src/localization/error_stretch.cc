#include "localization/error_stretch.h"

#include <cmath>

#include "math/functions.h"

namespace rockyard::localization {
namespace {

// What one tick makes of the errors: the rows in which its transition A is not the unit matrix.
struct TickRows {
  TickRows(const MotionTick& tick, double kept)
      : across_x(-tick.forward_m * math::Sin(tick.along_rad)),
        across_y(tick.forward_m * math::Cos(tick.along_rad)),
        along_x(math::Cos(tick.along_rad) * tick.forward_m / tick.wheel_scale),
        along_y(math::Sin(tick.along_rad) * tick.forward_m / tick.wheel_scale),
        down_pitch(-tick.forward_m * math::Cos(tick.pitch_rad)),
        down_scale(-tick.forward_m / tick.wheel_scale * math::Sin(tick.pitch_rad)),
        turn_bias(-tick.duration_s / tick.gyro_scale),
        turn_scale(-tick.turn_rad / tick.gyro_scale),
        turn_share(tick.turn_share),
        tilt_kept(kept) {}

  // M <- A M, row by row. The order must stay: rows of the place need those of heading and pitch as
  // they were, and are changed first.
  template <typename Matrix>
  void Apply(Matrix&& M) const {
    const auto turn = (turn_bias * M.row(error::kGyroBias) +  //
                       turn_scale * M.row(error::kGyroScale))
                          .eval();
    const auto along = (M.row(error::kHeading) + turn_share * turn).eval();
    M.row(error::kX) += across_x * along + along_x * M.row(error::kWheelScale);
    M.row(error::kY) += across_y * along + along_y * M.row(error::kWheelScale);
    M.row(error::kZ) += down_pitch * M.row(error::kPitch) + down_scale * M.row(error::kWheelScale);
    M.row(error::kHeading) += turn;
    M.row(error::kRoll) *= tilt_kept;
    M.row(error::kPitch) *= tilt_kept;
  }

  double across_x, across_y;      // d x, d y / d a
  double along_x, along_y;        // d x, d y / d e_w
  double down_pitch, down_scale;  // d z / d e_p, d e_w
  double turn_bias, turn_scale;   // d h / d e_b, d e_k
  double turn_share;
  double tilt_kept;
};

// Adds what the noise of one tick contributes to the covariance N.
void AddTickNoise(const MotionTick& tick, const TickNoise& noise, ErrorMatrix& N) {
  const auto [s, c] = math::SinCos(tick.along_rad);
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
  const TickRows A(tick, noise.tilt_kept);
  A.Apply(transition_);
  // N <- A N A', by rows and by columns.
  A.Apply(noise_);
  A.Apply(noise_.transpose());
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

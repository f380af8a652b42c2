#include "sensing/gyro.h"

#include <cmath>

#include "core/check.h"
#include "core/distributions.h"

namespace rockyard::sensing {

namespace {

// Of the bias: no tick has this number.
constexpr std::uint32_t kBiasSubstream = 0xFFFFFFFFu;

}  // namespace

Gyro::Gyro(const GyroParams& params, core::TrialKey key) : params_(params), key_(key) {
  core::RandomStream stream(key, core::Purpose::kGyro, kBiasSubstream);
  bias_rad_s_ = core::SampleNormal(stream, 0.0, params.bias_sd_rad_s);
}

double Gyro::Measure(double true_turn_rad, double duration_s, bool moving,
                     std::int64_t step) const {
  EXPECT(duration_s >= 0.0 && step >= 0);
  const double turn_rad = params_.scale * true_turn_rad;
  if (!moving && !params_.accumulates_at_rest) return turn_rad;
  core::RandomStream stream(key_, core::Purpose::kGyro, static_cast<std::uint32_t>(step));
  // Wiener process of the heading: variance q dt, so that the sum over ticks does not depend on
  // their length.
  const double deviation = std::sqrt(params_.heading_variance_rad2_per_s() * duration_s);
  return turn_rad + bias_rad_s_ * duration_s + core::SampleNormal(stream, 0.0, deviation);
}

double TurnAboutOwnAxis(const math::Transform& X_WR_before, const math::Transform& X_WR_after) {
  // R_WR(before)^-1 R_WR(after) is the rotation in the rover's own frame. The z component of its
  // rotation vector is, for a short tick, the integral of the rate about the rover's own z axis.
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(X_WR_before.linear().transpose() * X_WR_after.linear()));
  return turn.angle() * turn.axis().z();
}

}  // namespace rockyard::sensing

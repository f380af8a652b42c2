#include "sensing/visual_motion.h"

#include <cmath>

#include "core/check.h"
#include "core/random.h"

namespace rockyard::sensing {

vision::MotionResult VisualMotion::Measure(const math::Transform& X_FS, std::int64_t number) const {
  EXPECT(number >= 0);
  const double way_m = X_FS.translation().norm();
  const double angle_rad = math::TurnOf(X_FS.linear()).angle_rad;
  core::RandomStream stream(key_, core::Purpose::kVisualMotion, static_cast<std::uint32_t>(number));
  vision::MotionResult result;
  if (core::SampleBernoulli(stream, params_.failure.Probability(way_m, angle_rad))) {
    result.reason = vision::NoMotion::kNoConsistentSet;
    return result;
  }
  const auto variance = [&](const MotionErrorParams& error) {
    return error.Variance(way_m, angle_rad);
  };
  vision::Motion motion;
  motion.covariance.diagonal() << variance(params_.along), variance(params_.across),
      variance(params_.up), variance(params_.tilt), variance(params_.tilt),
      variance(params_.heading);
  Eigen::Matrix<double, 6, 1> error;
  for (int i = 0; i < 6; ++i) {
    error[i] = core::SampleNormal(stream, 0.0, std::sqrt(motion.covariance(i, i)));
  }
  motion.X_FS.translation() = X_FS.translation() + error.head<3>();
  const math::Vector3 turned = error.tail<3>();
  const double turned_rad = turned.norm();
  motion.X_FS.linear() = X_FS.linear();
  if (turned_rad > 0.0) {
    motion.X_FS.linear() = math::RotationAbout(turned_rad, turned / turned_rad) * X_FS.linear();
  }
  result.motion = motion;
  return result;
}

}  // namespace rockyard::sensing

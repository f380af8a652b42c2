// Steps over level ground do not nod the camera: the slopes of windows matter.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "vision/odometry/odometer.h"
#include "vision/odometry/plain_motion.h"
#include "vision/odometry/synthetic_sequence.h"

namespace rockyard::vision {
namespace {

constexpr std::uint32_t kWorlds = 24;

// Errors of the pitch of steps of 75 cm over as many textures, predicted a tenth too long.
std::vector<double> PitchErrors_rad(bool slanted) {
  const ImageSize size{256, 256};
  const RectifiedPair pair = PlanePair(size);
  const math::Transform X_FS = math::MakePose({0.75, 0.0, 0.0}, 0.0, 0.0, 0.0);
  OdometerParams params;
  params.placement.slanted = slanted;
  params.placement.max_residual_ratio = 1e6;  // windows that do not fit are not left out
  std::vector<double> errors_rad;
  for (std::uint32_t number = 0; number < kWorlds; ++number) {
    VisualOdometer odometer(params, pair, {}, {261, number});
    odometer.Add(SeePlane(pair, math::Transform::Identity(), {.number = number}, 0));
    const OdometryStep step = odometer.Add(SeePlane(pair, X_FS, {.number = number}, 1),
                                           math::MakePose({0.825, 0.0, 0.0}, 0.0, 0.0, 0.0));
    EXPECT_TRUE(step.result.motion) << number;
    if (step.result.motion) {
      errors_rad.push_back(ErrorOf(step.result.motion->X_FS, X_FS)(4));
    }
  }
  return errors_rad;
}

struct Errors {
  double mean_rad = 0.0;
  double rms_rad = 0.0;
};

Errors PitchErrors(bool slanted) {
  Errors errors;
  const std::vector<double> all_rad = PitchErrors_rad(slanted);
  const auto n = static_cast<double>(all_rad.size());
  for (const double error_rad : all_rad) {
    errors.mean_rad += error_rad / n;
    errors.rms_rad += error_rad * error_rad / n;
  }
  errors.rms_rad = std::sqrt(errors.rms_rad);
  return errors;
}

// The limit of the mean is three times its standard error, that of the root mean square twice what
// the covariance has of it. The control takes all windows to face the cameras, and nods.
TEST(GroundBiasTest, StepsDoNotNod) {
  constexpr double kMean_rad = 6e-5;
  constexpr double kRms_rad = 2e-4;
  const Errors slanted = PitchErrors(true);
  EXPECT_LT(std::abs(slanted.mean_rad), kMean_rad);
  EXPECT_LT(slanted.rms_rad, kRms_rad);
  const Errors facing = PitchErrors(false);
  EXPECT_GT(std::abs(facing.mean_rad), kMean_rad);
  EXPECT_GT(facing.rms_rad, kRms_rad);
}

}  // namespace
}  // namespace rockyard::vision

// Steps do not nod the camera: neither does level ground, nor do the edges of what stands on it.
#include <gtest/gtest.h>

#include <cmath>

#include "vision/odometry/odometer.h"
#include "vision/odometry/plain_motion.h"
#include "vision/odometry/synthetic_sequence.h"

namespace rockyard::vision {
namespace {

constexpr std::uint32_t kWorlds = 12;

struct Errors {
  double mean_rad = 0.0;
  double rms_rad = 0.0;
};

// Of the pitch of steps over as many textures, predicted a tenth too long.
Errors PitchErrors(double step_m, double boards_m, const PlacementParams& placement) {
  const ImageSize size{256, 256};
  const RectifiedPair pair = PlanePair(size);
  const math::Transform X_FS = math::MakePose({step_m, 0.0, 0.0}, 0.0, 0.0, 0.0);
  const math::Transform predicted = math::MakePose({1.1 * step_m, 0.0, 0.0}, 0.0, 0.0, 0.0);
  OdometerParams params;
  params.placement = placement;
  Errors errors;
  for (std::uint32_t number = 0; number < kWorlds; ++number) {
    const PlaneWorld world{.number = number, .boards_m = boards_m};
    VisualOdometer odometer(params, pair, {}, {261, number});
    odometer.Add(SeePlane(pair, math::Transform::Identity(), world, 0));
    const OdometryStep step = odometer.Add(SeePlane(pair, X_FS, world, 1), predicted);
    EXPECT_TRUE(step.result.motion) << number;
    if (!step.result.motion) continue;
    const double error_rad = ErrorOf(step.result.motion->X_FS, X_FS)(4);
    errors.mean_rad += error_rad / kWorlds;
    errors.rms_rad += error_rad * error_rad / kWorlds;
  }
  errors.rms_rad = std::sqrt(errors.rms_rad);
  return errors;
}

// The limit of the mean is three times its standard error, that of the root mean square twice what
// the errors are. The control takes all windows to face the cameras.
TEST(GroundBiasTest, LevelGroundDoesNotNod) {
  constexpr double kMean_rad = 8e-5;
  constexpr double kRms_rad = 2e-4;
  PlacementParams params;
  params.max_residual_ratio = 1e6;  // windows that do not fit are not left out
  const Errors slanted = PitchErrors(0.75, 0.0, params);
  EXPECT_LT(std::abs(slanted.mean_rad), kMean_rad);
  EXPECT_LT(slanted.rms_rad, kRms_rad);
  params.slanted = false;
  const Errors facing = PitchErrors(0.75, 0.0, params);
  EXPECT_GT(std::abs(facing.mean_rad), kMean_rad);
  EXPECT_GT(facing.rms_rad, kRms_rad);
}

// Boards stand on the ground, whose edges are in many windows. The control keeps these: it
// nods by 1 mrad. Small windows have fewer edges in them, and fewer are to be left out.
TEST(GroundBiasTest, EdgesNodLittleAndLessInSmallWindows) {
  constexpr double kMean_rad = 5e-4;
  PlacementParams params;
  EXPECT_LT(std::abs(PitchErrors(0.5, 0.4, params).mean_rad), kMean_rad);
  params.max_residual_ratio = 1e6;
  const Errors kept = PitchErrors(0.5, 0.4, params);
  EXPECT_GT(std::abs(kept.mean_rad), kMean_rad);
  params.window_px = 9;
  EXPECT_LT(PitchErrors(0.5, 0.4, params).rms_rad, 0.8 * kept.rms_rad);
}

}  // namespace
}  // namespace rockyard::vision

// A ditch across the way, with both fidelities.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rover/ground_touches.h"
#include "rover_drive.h"

namespace rockyard::rover {
namespace {

// What happened to a rover that drove ahead for a while across a ditch whose middle lies at x = 1.
struct Crossing {
  double x_m = 0.0;  // at the end
  double z_m = 0.0;
  double nose_down_rad = 0.0;  // largest pitches
  double nose_up_rad = 0.0;
  double lowest_m = 0.0;  // of R's origin
};

Crossing DriveAcross(Fidelity fidelity, double width_m, double depth_m, double flank_m) {
  const RoverParams params = WithFidelity(fidelity);
  terrain::GroundParams ground;
  ground.soil = RigidGround(0.8);
  ground.ditches = {.x_m = {1.0},
                    .y_m = {0.0},
                    .direction_deg = {90.0},
                    .length_m = {0.0},
                    .width_m = {width_m},
                    .depth_m = {depth_m},
                    .flank_m = {flank_m}};
  const RoverOn rover(terrain::Terrain(terrain::Ground(ground, {}), {}, {}), params);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  Crossing crossing;
  for (int i = 0; i < 1200; ++i) {  // 20 s
    rover->Step(command);
    const math::Transform& X_WR = rover->state().X_WR;
    // The x axis points up where the nose does.
    const double pitch_rad = std::asin(std::clamp(X_WR.linear()(2, 0), -1.0, 1.0));
    crossing.nose_up_rad = std::max(crossing.nose_up_rad, pitch_rad);
    crossing.nose_down_rad = std::max(crossing.nose_down_rad, -pitch_rad);
    crossing.lowest_m = std::min(crossing.lowest_m, X_WR.translation().z());
  }
  crossing.x_m = rover->state().X_WR.translation().x();
  crossing.z_m = rover->state().X_WR.translation().z();
  return crossing;
}

class Ditch : public testing::TestWithParam<Fidelity> {};
INSTANTIATE_TEST_SUITE_P(Fidelities, Ditch,
                         testing::Values(Fidelity::kMultibody, Fidelity::kQuasiStatic));

TEST_P(Ditch, AShallowOneIsCrossedNoseDownAndUp) {
  const Crossing crossing = DriveAcross(GetParam(), 0.8, 0.1, 0.4);
  EXPECT_GT(crossing.x_m, 2.3);
  EXPECT_NEAR(crossing.z_m, 0.0, 0.005);
  EXPECT_GT(crossing.nose_down_rad, 0.05);
  EXPECT_GT(crossing.nose_up_rad, 0.05);
  EXPECT_LT(crossing.lowest_m, -0.03);
  EXPECT_GT(crossing.lowest_m, -0.1);
}

TEST_P(Ditch, ADeepOneTrapsTheRover) {
  const Crossing crossing = DriveAcross(GetParam(), 0.5, 0.4, 0.15);
  EXPECT_LT(crossing.x_m, 1.4);
  EXPECT_GT(crossing.nose_down_rad, 0.05);
}

// Narrower than a wheel, 13 cm: the rim rests on both edges and sinks by no more than its sagitta
// over 6 cm, R - sqrt(R^2 - 3^2) = 0.7 cm.
TEST_P(Ditch, ACrackIsDrivenOver) {
  const Crossing crossing = DriveAcross(GetParam(), 0.06, 0.2, 0.03);
  EXPECT_GT(crossing.x_m, 2.6);
  EXPECT_GT(crossing.lowest_m, -0.02);
}

// A thin wheel of 10 cm over the middle of a ditch narrower than itself touches both flanks, the
// one behind first, where steps of 0.01 mrad around its rim find the least heights.
TEST(GroundTouchesTest, LieOnBothFlanksWhereTheRimIsNearest) {
  constexpr double kRadius_m = 0.1;
  terrain::GroundParams params{.ditches = {.x_m = {1.0},
                                           .y_m = {0.0},
                                           .direction_deg = {90.0},
                                           .length_m = {0.0},
                                           .width_m = {0.14},
                                           .depth_m = {0.2},
                                           .flank_m = {0.07}}};
  const terrain::Ground ground(params, {});
  const math::Vector3 center_W(1.0, 0.0, 0.08);
  const auto support = [&](const math::Vector3& n_W) -> math::Vector3 {
    return center_W - kRadius_m * n_W;
  };
  const GroundTouches found =
      FindGroundTouches(ground, center_W, math::Vector3::UnitY(), kRadius_m, support);
  ASSERT_EQ(found.count, 2u);
  double least_m = 1.0;
  for (double angle_rad = 0.0; angle_rad < 1.4; angle_rad += 1e-5) {
    const math::Vector3 p_W = support({std::sin(angle_rad), 0.0, std::cos(angle_rad)});
    least_m = std::min(least_m, p_W.z() - ground.Height(p_W.x(), p_W.y()));
  }
  for (const GroundTouch& touch : found.touches) {
    EXPECT_NEAR(touch.gap_m / touch.n_W.z(), least_m, 1e-8);
  }
  EXPECT_LT(found.touches[0].p_W.x(), 0.97);
  EXPECT_GT(found.touches[1].p_W.x(), 1.03);
  EXPECT_GT(found.touches[0].n_W.x(), 0.3);  // away from the flank behind
}

}  // namespace
}  // namespace rockyard::rover

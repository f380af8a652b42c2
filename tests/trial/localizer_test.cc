#include "trial/localizer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "math/pose.h"
#include "sensing/oracle.h"

namespace rockyard::trial {
namespace {

truth::RoverState StateAt(const math::Vector3& p_WoRo_W, double heading_rad, double pitch_rad,
                          double roll_rad) {
  truth::RoverState state;
  state.X_WR = math::MakePose(p_WoRo_W, heading_rad, pitch_rad, roll_rad);
  return state;
}

const messages::MotionMeasurement kTick = [] {
  messages::MotionMeasurement motion;
  motion.duration_s = 0.05;
  return motion;
}();

DriveParams With(Localization localization) {
  DriveParams drive;
  drive.sensors.localization = localization;
  return drive;
}

// MakePose and TrueAttitude are inverse to each other: pitch positive nose down, roll positive left
// side up.
TEST(LocalizerTest, TheOracleTellsTheAttitudeThatMakesThePose) {
  core::RandomStream stream({1, 0}, core::Purpose::kTest);
  for (int i = 0; i < 1000; ++i) {
    const double heading_rad = 6.0 * (stream.Uniform() - 0.5);
    const double pitch_rad = 2.0 * (stream.Uniform() - 0.5);
    const double roll_rad = 2.0 * (stream.Uniform() - 0.5);
    const auto attitude =
        sensing::TrueAttitude(StateAt({3.0, -2.0, 0.7}, heading_rad, pitch_rad, roll_rad), 0.2);
    EXPECT_NEAR(attitude.pitch_rad, pitch_rad, 1e-12);
    EXPECT_NEAR(attitude.roll_rad, roll_rad, 1e-12);
    EXPECT_NEAR(attitude.z_m, 0.5, 1e-12);
  }
}

TEST(LocalizerTest, TheOracleFollowsAllSixDegreesOfFreedom) {
  Localizer localizer(With(Localization::kOracle), {});
  localizer.Place(StateAt({0.0, 0.0, 0.1}, 0.0, 0.0, 0.0));
  EXPECT_EQ(localizer.attitude().z_m, 0.0);
  localizer.Integrate(kTick, StateAt({0.4, 0.3, 0.25}, 0.5, -0.2, 0.1));
  EXPECT_NEAR(localizer.pose().x_m, 0.4, 1e-12);
  EXPECT_NEAR(localizer.pose().y_m, 0.3, 1e-12);
  EXPECT_NEAR(localizer.pose().heading_rad, 0.5, 1e-12);
  EXPECT_NEAR(localizer.attitude().pitch_rad, -0.2, 1e-12);
  EXPECT_NEAR(localizer.attitude().roll_rad, 0.1, 1e-12);
  EXPECT_NEAR(localizer.attitude().z_m, 0.15, 1e-12);
}

// On board, slopes are felt by accelerometers alone.
TEST(LocalizerTest, WithoutAccelerometersTheRoverIsLevel) {
  Localizer localizer(With(Localization::kDeadReckoning), {});
  localizer.Place(StateAt({0.0, 0.0, 0.1}, 0.0, 0.0, 0.0));
  localizer.Integrate(kTick, StateAt({0.4, 0.3, 0.25}, 0.5, -0.2, 0.1));
  localizer.UpdateAttitude({}, 0.05);
  EXPECT_EQ(localizer.pose().x_m, 0.0);  // no wheel turned
  EXPECT_EQ(localizer.attitude().pitch_rad, 0.0);
  EXPECT_EQ(localizer.attitude().z_m, 0.0);
}

TEST(LocalizerTest, AccelerometersLevelTheRover) {
  Localizer localizer(With(Localization::kDeadReckoning), {});
  messages::VehicleState felt;
  // Nose down by p: the upward force points backwards, f = g (-sin p, 0, cos p).
  felt.specific_force_R = 9.81 * math::Vector3(-std::sin(0.2), 0.0, std::cos(0.2));
  localizer.UpdateAttitude(felt, 0.05);
  EXPECT_NEAR(localizer.attitude().pitch_rad, 0.2, 1e-12);
  EXPECT_NEAR(localizer.attitude().roll_rad, 0.0, 1e-12);
}

// Operators set the pose; the rover has not climbed there.
TEST(LocalizerTest, APoseUpdateLeavesTheBelievedHeight) {
  Localizer localizer(With(Localization::kDeadReckoning), {});
  messages::VehicleState nose_down;
  nose_down.specific_force_R = 9.81 * math::Vector3(-std::sin(0.2), 0.0, std::cos(0.2));
  localizer.UpdateAttitude(nose_down, 0.05);
  messages::MotionMeasurement rolling = kTick;
  rolling.wheel_turn_rad.fill(1.0);
  localizer.Integrate(rolling, {});
  localizer.UpdateAttitude(nose_down, 0.05);
  const double before_m = localizer.attitude().z_m;
  ASSERT_LT(before_m, -0.01);
  localizer.Apply({3.0, -1.0, 0.5});
  EXPECT_EQ(localizer.attitude().z_m, before_m);
  localizer.Integrate(kTick, {});
  localizer.UpdateAttitude(nose_down, 0.05);
  EXPECT_NEAR(localizer.attitude().z_m, before_m, 1e-12);
  // From here on as before: one roll more is the same step down.
  localizer.Integrate(rolling, {});
  localizer.UpdateAttitude(nose_down, 0.05);
  EXPECT_NEAR(localizer.attitude().z_m, 2.0 * before_m, 1e-12);
}

}  // namespace
}  // namespace rockyard::trial

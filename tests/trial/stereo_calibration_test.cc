// What a wrong mount of stereo cameras makes of the points that they see.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/angles.h"
#include "sensing/stereo_sensor.h"
#include "trial/shipped_trials.h"
#include "trial/terrain_sensing.h"

namespace rockyard::trial {
namespace {

using math::Vector3;
using messages::LookDirection;
using Points = std::vector<Vector3>;

constexpr core::TrialKey kKey{1, 0};

terrain::Terrain Flat() { return {terrain::Ground(), {}, {}}; }

// What the navigator gets of a first look over flat ground, from a level rover.
Points Seen(const Overrides& overrides, LookDirection direction) {
  TerrainSensing terrain_sensing(Gestalt("abundance", overrides), kKey, {});
  const Percept percept = terrain_sensing.Look(direction, Flat(), math::Transform::Identity(), {});
  return percept.cloud ? percept.cloud->points_R : Points{};
}

std::string Error(const std::string& what) { return "perception.calibration.stereo_" + what; }

TEST(StereoCalibrationTest, NoErrorLeavesTheCloudBitForBit) {
  const DriveParams drive = Gestalt("abundance");
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    const Points seen = Seen({}, direction);
    const Points measured = sensing::StereoSensor(drive.sensors.stereo)
                                .Look(Flat(), math::Transform::Identity(), kKey, 0, direction)
                                .points_R;
    ASSERT_GT(seen.size(), 1000U);
    EXPECT_TRUE(seen == measured);
  }
}

// Flat ground turns about the lateral axis of the middle of the pair, which keeps its distance h
// from it: with the error e and the mount at c, n . (p - c) = -h with n = (+-sin e, 0, cos e), +
// for cameras that look ahead. A pair believed to look too far down sees the ground fall away.
TEST(StereoCalibrationTest, APitchErrorOfOneDegreeTiltsFlatGroundByOneDegree) {
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    const bool ahead = direction == LookDirection::kAhead;
    const std::string mount = ahead ? "front" : "rear";
    const Overrides ideal{"sensors.stereo.fidelity=ideal"};
    const sensing::StereoParams stereo = Gestalt("abundance").sensors.stereo;
    const double h = ahead ? stereo.front.height_m : stereo.rear.height_m;
    const double way = ahead ? 1.0 : -1.0;
    const Vector3 c(way * (ahead ? stereo.front.ahead_m : stereo.rear.ahead_m), 0.0, h);
    for (const double error_deg : {-1.0, 1.0}) {
      const Points seen = Seen(
          ideal + Overrides{Error(mount + ".pitch_deg=" + std::to_string(error_deg))}, direction);
      ASSERT_GT(seen.size(), 1000U);
      const double error = math::DegToRad(error_deg);
      const Vector3 n(way * std::sin(error), 0.0, std::cos(error));
      for (const Vector3& p : seen) EXPECT_NEAR(n.dot(p - c), -h, 1e-9);
    }
  }
}

TEST(StereoCalibrationTest, ShiftsMovePointsAndTheOtherPairKeepsItsOwn) {
  const Overrides shift{Error("rear.x_m=0.01"), Error("rear.z_m=-0.02")};
  EXPECT_TRUE(Seen(shift, LookDirection::kAhead) == Seen({}, LookDirection::kAhead));
  const Points shifted = Seen(shift, LookDirection::kBehind);
  const Points right = Seen({}, LookDirection::kBehind);
  ASSERT_EQ(shifted.size(), right.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_NEAR((shifted[i] - right[i] - Vector3(0.01, 0.0, -0.02)).norm(), 0.0, 1e-12);
  }
}

// Believed to look e too far left: points turn left about the vertical through level cameras.
TEST(StereoCalibrationTest, AYawErrorTurnsPointsAboutTheMount) {
  const Overrides level{"sensors.stereo.front.pitch_deg=0"};
  const Points right = Seen(level, LookDirection::kAhead);
  const Points turned = Seen(level + Overrides{Error("front.yaw_deg=2")}, LookDirection::kAhead);
  const Vector3 c(Gestalt("abundance").sensors.stereo.front.ahead_m, 0.0, 0.0);
  const Eigen::AngleAxisd left(math::DegToRad(2.0), Vector3::UnitZ());
  ASSERT_GT(right.size(), 1000U);
  ASSERT_EQ(turned.size(), right.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_NEAR((turned[i] - c - left * (right[i] - c)).norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace rockyard::trial

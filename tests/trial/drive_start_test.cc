// Drives that go on from an earlier one: by what they believe, in its field, under a sun.
#include <gtest/gtest.h>

#include <numeric>

#include "trial/course/layout.h"
#include "trial/run_trial.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

constexpr core::TrialKey kKey{1, 4};

DriveParams Open(const Overrides& more = {}) {
  const Overrides open{"terrain.arena.kind=open", "rover.fidelity=quasi_static",
                       "localization.estimator=error_state"};
  return Pathfinder("nominal", open + more);
}

// A drive in the field of its own course that believes to begin at `pose`.
DriveResult RunFrom(const DriveParams& drive, const math::Pose2& pose,
                    const std::optional<SolarSupply>& sun = {}) {
  const terrain::Field field =
      terrain::BuildField(drive.terrain, LayoutKey(drive, kKey), TerrainCourse(drive.course));
  return RunTrial(drive, kKey,
                  {.memory = {.pose = pose, .covariance = {}}, .field = field, .sun = sun});
}

// A rover that knows where it stands, in the field of its own course, is a plain drive to the bit.
TEST(DriveStartTest, OneThatKnowsItsPlaceIsAPlainDrive) {
  const DriveParams drive = Open();
  const DriveResult plain = RunTrial(drive, kKey);
  const DriveResult from = RunFrom(drive, drive.course.Start());
  EXPECT_TRUE(Differences(plain, from).empty());
  EXPECT_GT(plain.record.true_distance_m, 1.0);
}

TEST(DriveStartTest, OneThatIsWrongEndsWrongByAsMuch) {
  const DriveParams drive = Open({"terrain.rocks.kind=none", "sensors.gyro.scale=1"});
  const math::Pose2 start = drive.course.Start();
  const DriveResult right = RunFrom(drive, start);
  const math::Pose2 beside{start.x_m, start.y_m + 0.5, start.heading_rad};
  const DriveResult wrong = RunFrom(drive, beside);
  EXPECT_NEAR(right.record.believed_y_m, wrong.record.believed_y_m, 0.1);
  EXPECT_NEAR(right.record.final_y_m - wrong.record.final_y_m, 0.5, 0.2);
  EXPECT_EQ(wrong.outcome == truth::TrialOutcome::kGoalReached,
            wrong.record.true_goal_distance_m <= drive.course.goal_radius_m);
}

TEST(DriveStartTest, TheEndIsWhatTheRecordSays) {
  const DriveParams drive = Open();
  const DriveResult result = RunTrial(drive, kKey);
  EXPECT_EQ(result.end.X_WR.translation().x(), result.record.final_x_m);
  EXPECT_EQ(result.end.memory.pose.x_m, result.record.believed_x_m);
  EXPECT_EQ(result.end.memory.pose.heading_rad, result.record.believed_heading_rad);
  EXPECT_TRUE(result.end.memory.covariance.has_value());
  const auto& by_activity = result.end.energy_wh;
  EXPECT_NEAR(std::accumulate(by_activity.begin(), by_activity.end(), 0.0), result.record.energy_wh,
              1e-9);
  EXPECT_NEAR(result.end.battery_wh, result.record.energy_wh, 1e-9);
}

TEST(DriveStartTest, TheSunSparesTheBatteries) {
  const DriveParams drive = Open({"energy.battery_wh=50"});
  const SolarSupply bright(100.0, 0.0, 0.0, 12.0);
  const SolarSupply dim(5.0, 0.0, 0.0, 12.0);
  const DriveResult sunny = RunFrom(drive, drive.course.Start(), bright);
  const DriveResult dull = RunFrom(drive, drive.course.Start(), dim);
  EXPECT_EQ(sunny.end.battery_wh, 0.0);
  EXPECT_EQ(sunny.record.energy_wh, dull.record.energy_wh);
  EXPECT_GT(dull.end.battery_wh, 0.0);
  EXPECT_LT(dull.end.battery_wh, dull.record.energy_wh);
}

}  // namespace
}  // namespace rockyard::trial

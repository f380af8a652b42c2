// Whole drives from waypoint to waypoint, and to a goal that is tracked.

#include <gtest/gtest.h>

#include <cmath>

#include "navigation/gestalt/gestalt_params.h"
#include "navigation/pathfinder/pathfinder_params.h"
#include "terrain/field.h"
#include "trial/course/layout.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using truth::TrialOutcome;

const Overrides kBareGround = {"terrain.rocks.kind=none", "terrain.arena.kind=open",
                               "rover.fidelity=quasi_static"};
const Overrides kKnowsItsPlace = {"localization.estimator=oracle"};
// An L of empty sand: 2 m ahead, then 2 m to the left, with a waypoint between.
const Overrides kL =
    kBareGround + kKnowsItsPlace +
    Overrides{"course.waypoints.x_m=[2,2]", "course.waypoints.y_m=[0,1]", "course.goal_x_m=2",
              "course.goal_y_m=2.5", "terrain.arena.width_m=8"};

// By either navigator.
class WaypointDrive : public testing::TestWithParam<const char*> {
 protected:
  static bool IsGestalt() { return GetParam() == std::string("gestalt"); }
  static DriveParams Make(const Overrides& overrides) {
    return IsGestalt() ? Gestalt("abundance_rocky_3_2", overrides)
                       : Pathfinder("nominal", overrides);
  }
};

using TrackingDrive = WaypointDrive;
INSTANTIATE_TEST_SUITE_P(Navigators, WaypointDrive, testing::Values("gestalt", "pathfinder"));
INSTANTIATE_TEST_SUITE_P(Navigators, TrackingDrive, testing::Values("gestalt", "pathfinder"));

double Between(const math::Pose2& pose, const messages::Goal& goal) {
  return std::hypot(pose.x_m - goal.x_m, pose.y_m - goal.y_m);
}

TEST_P(WaypointDrive, AnLIsDrivenFromWaypointToWaypoint) {
  const DriveParams drive = Make(kL);
  const TracedTrial trial = RunTraced(drive, 0);
  EXPECT_EQ(trial.result.outcome, TrialOutcome::kGoalReached) << trial.result.detail;
  EXPECT_EQ(trial.result.record.waypoints_reached, 2.0);
  const auto reached = EventsOf(trial.trace, "waypoint");
  ASSERT_EQ(reached.size(), 2U);
  const double tolerance_m =
      IsGestalt()
          ? drive.navigation.navigators.params<navigation::GestaltParams>()
                .waypoints.goal_tolerance_m
          : drive.navigation.navigators.params<navigation::PathfinderParams>().goal_tolerance_m;
  const std::vector<messages::Goal> goals = drive.course.Goals();
  for (std::size_t i = 0; i < reached.size(); ++i) {
    EXPECT_LE(Between(reached[i].pose, goals[i]), tolerance_m + 1e-9);
    EXPECT_TRUE(reached[i].detail.starts_with(std::to_string(i + 1) + " of 2"));
  }
  EXPECT_LT(reached[0].time_s, reached[1].time_s);
  // The way along the legs, less what the tolerances cut off; the diagonal is 3.2 m.
  EXPECT_GT(trial.result.record.true_distance_m, 4.5 - 3.0 * tolerance_m);
}

TEST_P(WaypointDrive, ARoverThatIsStoppedOnTheWayHasReachedSome) {
  const TracedTrial whole = RunTraced(Make(kL), 0);
  const auto reached = EventsOf(whole.trace, "waypoint");
  ASSERT_EQ(reached.size(), 2U);
  const double between_s = 0.5 * (reached[0].time_s + reached[1].time_s);
  const DriveResult result =
      RunTrial(Make(kL + Overrides{"referee.time_limit_s=" + std::to_string(between_s)}), {1, 0});
  EXPECT_EQ(result.outcome, TrialOutcome::kTimeLimit);
  EXPECT_EQ(result.record.waypoints_reached, 1.0);
}

// 3 m out and back again almost to the start: the last leg leads away from the first waypoint, and
// the operator who watches for progress goes by the leg.
TEST_P(WaypointDrive, PatienceFollowsTheLegs) {
  const DriveResult result =
      RunTrial(Make(kBareGround + kKnowsItsPlace +
                    Overrides{"course.waypoints.x_m=[3]", "course.waypoints.y_m=[0]",
                              "course.goal_x_m=0.3", "referee.no_path_distance_m=2"}),
               {1, 0});
  EXPECT_EQ(result.outcome, TrialOutcome::kGoalReached) << result.detail;
  EXPECT_GT(result.record.true_distance_m, 4.5);
}

TEST(WaypointDriveTest, RocksKeepAwayFromWaypoints) {
  const Overrides dense = {"terrain.rocks.k_per_m2=0.02"};
  const DriveParams without = Pathfinder("nominal", dense);
  const DriveParams with = Pathfinder(
      "nominal",
      dense + Overrides{"course.waypoints.x_m=[3,5]", "course.waypoints.y_m=[0.4,-0.4]"});
  const auto in_zones = [&](const DriveParams& drive) {
    int rocks = 0;
    for (std::uint32_t layout = 0; layout < 20; ++layout) {
      const terrain::Field field =
          terrain::BuildField(drive.terrain, {1, layout}, TerrainCourse(drive.course));
      for (const terrain::Rock& rock : field.terrain.rocks()) {
        for (const messages::Goal& place : with.course.waypoints.Places()) {
          const double centre_m =
              std::hypot(rock.center_W.x() - place.x_m, rock.center_W.y() - place.y_m);
          rocks += centre_m < drive.terrain.rocks.clear_radius_m ? 1 : 0;
        }
      }
    }
    return rocks;
  };
  EXPECT_GT(in_zones(without), 0);
  EXPECT_EQ(in_zones(with), 0);
}

// The gyro reads 70 % of a turn and the rover starts 60 deg off its course, so that dead reckoning
// leads it past the goal.
const Overrides kDrifting =
    kBareGround + Overrides{"course.start_heading_deg=60", "sensors.gyro.scale=0.7",
                            "course.goal_x_m=5", "course.goal_radius_m=0.5"};
const Overrides kTracking = {"course.tracking.enabled=true"};

TEST_P(TrackingDrive, ATrackedGoalIsReachedInSpiteOfDrift) {
  for (std::uint32_t index = 0; index < 3; ++index) {
    const DriveResult blind = RunTrial(Make(kDrifting), {1, index});
    EXPECT_EQ(blind.outcome, TrialOutcome::kFalseGoal) << blind.detail;
    const TracedTrial tracked = RunTraced(Make(kDrifting + kTracking), index);
    const truth::DriveRecord& record = tracked.result.record;
    EXPECT_EQ(tracked.result.outcome, TrialOutcome::kGoalReached) << tracked.result.detail;
    EXPECT_LT(record.true_goal_distance_m, blind.record.true_goal_distance_m);
    // Nobody corrects the pose: the goal is where the pose is wrong by as much.
    EXPECT_GT(record.position_error_m, 0.5);
    EXPECT_NEAR(record.believed_goal_distance_m, record.true_goal_distance_m, 0.15);
    const auto seen = EventsOf(tracked.trace, "tracker");
    ASSERT_FALSE(seen.empty());
    EXPECT_EQ(seen.front().detail, "goal in view");
  }
}

// The goal stays where it was told, and nothing else changes.
TEST_P(TrackingDrive, AGoalThatIsNeverSeenStaysWhereItWasTold) {
  const Overrides short_sighted = kTracking + Overrides{"course.tracking.range_m=0.1"};
  const DriveResult blind = RunTrial(Make(kDrifting), {1, 0});
  EXPECT_TRUE(Differences(blind, RunTrial(Make(kDrifting + short_sighted), {1, 0})).empty());
}

// Waypoints are designated, and the goal alone is tracked.
TEST_P(TrackingDrive, TheLastLegAloneIsTracked) {
  const TracedTrial trial = RunTraced(Make(kL + kTracking), 0);
  EXPECT_EQ(trial.result.outcome, TrialOutcome::kGoalReached);
  EXPECT_EQ(trial.result.record.waypoints_reached, 2.0);
  const auto reached = EventsOf(trial.trace, "waypoint");
  const auto seen = EventsOf(trial.trace, "tracker");
  ASSERT_EQ(reached.size(), 2U);
  ASSERT_FALSE(seen.empty());
  EXPECT_GE(seen.front().time_s, reached.back().time_s);
}

// 2 mm/s across the way, slower than a rover that looks and moves: one that is told where the
// target began comes too late.
TEST_P(TrackingDrive, ATargetThatMovesIsFollowed) {
  const Overrides moving = kBareGround + kKnowsItsPlace +
                           Overrides{"course.goal_x_m=4", "course.target_speed_m_s=0.002",
                                     "course.target_heading_deg=90", "course.goal_radius_m=0.3"};
  EXPECT_EQ(RunTrial(Make(moving), {1, 0}).outcome, TrialOutcome::kFalseGoal);
  const DriveResult tracked = RunTrial(Make(moving + kTracking), {1, 0});
  EXPECT_EQ(tracked.outcome, TrialOutcome::kGoalReached) << tracked.detail;
  const truth::DriveRecord& record = tracked.record;
  const double target_y_m = 0.002 * record.sim_time_s;
  EXPECT_NEAR(record.true_goal_distance_m,
              std::hypot(record.final_x_m - 4.0, record.final_y_m - target_y_m), 1e-9);
  EXPECT_GT(record.final_y_m, 0.3);
}

// Parameters that do nothing while they are off change no bit.
TEST(TrackingDriveTest, OffItDoesNothing) {
  const DriveResult plain = RunTrial(Pathfinder("nominal"), {1, 0});
  const DriveResult off =
      RunTrial(Pathfinder("nominal", {"course.tracking.range_m=9", "course.tracking.period_s=0.2",
                                      "course.target_heading_deg=30"}),
               {1, 0});
  EXPECT_TRUE(Differences(plain, off).empty());
}

}  // namespace
}  // namespace rockyard::trial

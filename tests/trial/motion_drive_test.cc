// Motions that no navigator of ours asks for yet: clothoids told anew at each tick, lower speeds,
// and plans that end before another one is there.
#include <gtest/gtest.h>

#include <numeric>

#include "navigation/navigator.h"
#include "scenario/shipped.h"
#include "trial/course/layout.h"
#include "trial/drive/drive.h"
#include "trial/run_trial.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using messages::MotionCommand;
using messages::MotionKind;

struct ScriptParams {
  MotionCommand command{.kind = MotionKind::kArc};
  bool numbers_its_moves = true;
  bool changes_each_tick = false;  // tells the curvature of the moment itself, not the rate
  double stop_m = 2.0;             // arrives by its odometer
  double stop_s = 1e9;             // gives up

  void Visit(core::FieldVisitor&) {}
};

// Drives one command, whatever it meets.
class Script final : public navigation::Navigator {
 public:
  explicit Script(const ScriptParams& params) : params_(params) {}

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    const double odometer_m = input.estimate.distance_m;
    if (odometer_m >= params_.stop_m) return {.status = navigation::NavigatorStatus::kArrived};
    if (input.time_s >= params_.stop_s) return {.status = navigation::NavigatorStatus::kGaveUp};
    MotionCommand command = params_.command;
    command.move = params_.numbers_its_moves ? 1 : 0;
    if (params_.changes_each_tick) {
      command.curvature_per_m += command.curvature_rate_per_m2 * odometer_m;
      command.curvature_rate_per_m2 = 0.0;
    }
    return {.motion = command};
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {}

 private:
  ScriptParams params_;
};

TracedTrial DriveScript(const ScriptParams& params, const Overrides& overrides = {}) {
  scenario::Scenario defaults;
  defaults.drive.navigation.navigators.Add<ScriptParams>(
      {.name = "script",
       .doc = "drives one command",
       .traits = [](const ScriptParams&) -> navigation::NavigatorTraits {
         return {navigation::LookReading::kNothing, navigation::CostOfLook{}, {}};
       },
       .make = [](const ScriptParams& p, const navigation::NavigatorSetup&)
           -> std::unique_ptr<navigation::Navigator> { return std::make_unique<Script>(p); }},
      params);
  const Overrides empty = {"navigation.navigator=script", "rover.fidelity=quasi_static",
                           "terrain.rocks.kind=none", "terrain.arena.kind=open",
                           "localization.estimator=oracle"};
  return RunTraced(scenario::Shipped("pathfinder/nominal", empty + overrides, defaults).drive, 0);
}

ScriptParams Clothoid() {
  ScriptParams params;
  params.command.curvature_rate_per_m2 = 0.5;
  return params;
}

// After s of a clothoid from a straight start the heading has grown by c' s^2 / 2, whether the
// wheel driver is told the rate or the curvature anew at each tick. The rover of the trial slips
// and its steering lags: a tenth.
TEST(MotionDrive, AClothoidTurnsTheRoverAsItsClosedFormSays) {
  for (const bool each_tick : {false, true}) {
    ScriptParams params = Clothoid();
    params.changes_each_tick = each_tick;
    const TracedTrial trial = DriveScript(params);
    const truth::TraceSample& first = trial.trace.samples.front();
    const truth::TraceSample& last = trial.trace.samples.back();
    const double way_m = trial.result.record.true_distance_m;
    const double turned_rad = math::WrapAngle(last.pose.heading_rad - first.pose.heading_rad);
    EXPECT_NEAR(turned_rad, 0.5 * 0.5 * way_m * way_m, 0.1) << each_tick;
    EXPECT_NEAR(way_m, 2.0, 0.05);
  }
}

// The overhead of a move is paid once for a clothoid, whose curvature changes at every tick.
TEST(MotionDrive, MovesAreCountedByTheNavigatorsNumber) {
  ScriptParams params = Clothoid();
  params.changes_each_tick = true;
  const Overrides overhead = {"clock.compute.computer=r3000_12mhz",
                              "clock.compute.move_overhead_s=2"};
  const TracedTrial numbered = DriveScript(params, overhead);
  EXPECT_EQ(numbered.result.record.moves, 1.0);
  EXPECT_EQ(numbered.result.record.move_overhead_time_s, 2.0);
  params.numbers_its_moves = false;
  params.stop_m = 0.2;
  EXPECT_GT(DriveScript(params, overhead).result.record.moves, 10.0);
}

TEST(MotionDrive, HalfTheSpeedTakesTwiceTheTime) {
  ScriptParams params;
  const double full_s = DriveScript(params).result.record.drive_time_s;
  params.command.speed_share = 0.5;
  EXPECT_NEAR(DriveScript(params).result.record.drive_time_s, 2.0 * full_s, 0.02 * full_s);
}

// No further plan comes: the rover is at rest before the end of the one that it has, less than a
// tick's way before it, whatever its ramps; where motors stop at once it slides on by a tenth of a
// millimetre. There it waits, without a verdict on its motion.
TEST(MotionDrive, StopsBeforeTheEndOfItsPlan) {
  for (const char* ramp :
       {"rover.drive.ramp_s=0", "rover.drive.ramp_s=0.1", "rover.drive.ramp_s=1"}) {
    ScriptParams params;
    params.command.end_m = 1.0;
    params.stop_s = 60.0;
    const TracedTrial trial = DriveScript(params, {ramp});
    EXPECT_EQ(trial.result.outcome, truth::TrialOutcome::kNoPath) << trial.result.detail;
    const double way_m = trial.result.record.true_distance_m;
    EXPECT_LE(way_m, 1.0 + 2e-4) << ramp;
    EXPECT_GE(way_m, 1.0 - 0.02) << ramp;
    EXPECT_EQ(trial.result.record.stops, 1.0);
    // The way at full speed, its ramps and the pause after braking; the rest of a minute it waits.
    EXPECT_NEAR(trial.result.record.drive_time_s, 1.0 / 0.15, 3.0) << ramp;
    EXPECT_NEAR(trial.result.record.drive_time_s + trial.result.record.move_overhead_time_s, 60.0,
                0.2)
        << ramp;
  }
}

// One that waits for ever is ended by the clock, as any other, and so is one that is told to stop.
TEST(MotionDrive, WaitsNoLongerThanTheTrialMayLast) {
  ScriptParams params;
  params.command.end_m = 0.5;
  const TracedTrial late = DriveScript(params, {"referee.time_limit_s=50"});
  EXPECT_EQ(late.result.outcome, truth::TrialOutcome::kTimeLimit);
  params.command = {};
  const TracedTrial stopped = DriveScript(params, {"referee.time_limit_s=50"});
  EXPECT_EQ(stopped.result.outcome, truth::TrialOutcome::kTimeLimit);
  EXPECT_EQ(stopped.result.record.drive_time_s, 0.0);
}

// Drives that go on from an earlier one: by what they believe, in its field, under a sun.

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
  EXPECT_TRUE(Differences(plain, RunFrom(drive, drive.course.Start())).empty());
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

// A drive that somebody steps from outside.

void ExpectTheSame(const DriveResult& a, const DriveResult& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.record.true_distance_m, b.record.true_distance_m);
  EXPECT_EQ(a.record.final_x_m, b.record.final_x_m);
  EXPECT_EQ(a.record.believed_x_m, b.record.believed_x_m);
  EXPECT_EQ(a.record.sim_time_s, b.record.sim_time_s);
  EXPECT_EQ(a.record.energy_wh, b.record.energy_wh);
}

// Two drives, a decision of one after a decision of the other, are what each is alone.
TEST(DriveStepTest, SteppedInTurnIsAsRunAlone) {
  const DriveParams drive = Pathfinder("nominal", {"rover.fidelity=quasi_static"});
  Drive first(drive, {1, 0}, nullptr, {});
  Drive second(drive, {1, 1}, nullptr, {});
  std::optional<Verdict> ends[2];
  while (!ends[0] || !ends[1]) {
    if (!ends[0]) ends[0] = first.Step();
    if (!ends[1]) ends[1] = second.Step();
  }
  const DriveResult alone[] = {RunTrial(drive, {1, 0}), RunTrial(drive, {1, 1})};
  ExpectTheSame(first.Finish(*ends[0]), alone[0]);
  ExpectTheSame(second.Finish(*ends[1]), alone[1]);
  EXPECT_NE(alone[0].record.true_distance_m, alone[1].record.true_distance_m);
}

TEST(DriveStepTest, TimePassesWithEachDecisionThatMoves) {
  const DriveParams drive = Pathfinder("nominal", {"rover.fidelity=quasi_static"});
  Drive stepped(drive, {1, 0}, nullptr, {});
  double before_s = stepped.time_s();
  int moved = 0;
  for (int i = 0; i < 20 && !stepped.Step(); ++i) {
    EXPECT_GE(stepped.time_s(), before_s);
    moved += stepped.time_s() > before_s ? 1 : 0;
    before_s = stepped.time_s();
  }
  EXPECT_GE(moved, 10);
}

}  // namespace
}  // namespace rockyard::trial

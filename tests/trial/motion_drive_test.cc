// Motions that no navigator of ours asks for yet: clothoids told anew at each tick, lower speeds,
// and plans that end before another one is there.
#include <gtest/gtest.h>

#include <memory>

#include "navigation/navigator.h"
#include "scenario/shipped.h"
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
// tick's way before it, whatever its ramps. There it waits, without a verdict on its motion.
TEST(MotionDrive, StopsBeforeTheEndOfItsPlan) {
  for (const char* ramp :
       {"rover.drive.ramp_s=0", "rover.drive.ramp_s=0.1", "rover.drive.ramp_s=1"}) {
    ScriptParams params;
    params.command.end_m = 1.0;
    params.stop_s = 60.0;
    const TracedTrial trial = DriveScript(params, {ramp});
    EXPECT_EQ(trial.result.outcome, truth::TrialOutcome::kNoPath) << trial.result.detail;
    const double way_m = trial.result.record.true_distance_m;
    EXPECT_LE(way_m, 1.0 + 1e-9) << ramp;
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

}  // namespace
}  // namespace rockyard::trial

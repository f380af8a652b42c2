// Every way in which a drive can end, provoked by a small scenario.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "trial/shipped_trials.h"
#include "truth/end_cause.h"

namespace rockyard::trial {
namespace {

using truth::EndCause;
using truth::TrialOutcome;

// Drives over level, rock-free sand without scans cost a few hundredths of a second.
TrialOutcome LevelSand(const Overrides& overrides) {
  return RunTrial(Pathfinder("level_sand", overrides), {1, 0}).outcome;
}

std::map<TrialOutcome, int> Count(const std::vector<DriveResult>& results) {
  std::map<TrialOutcome, int> counts;
  for (const DriveResult& result : results) ++counts[result.outcome];
  return counts;
}

TEST(OutcomesTest, GoalReached) { EXPECT_EQ(LevelSand({}), TrialOutcome::kGoalReached); }

TEST(OutcomesTest, FalseGoalWhereTheGyroIsWrong) {
  const auto turned_at_the_start = [](const std::string& scale) {
    return LevelSand({"course.start_heading_deg=90", "sensors.gyro.scale=" + scale});
  };
  EXPECT_EQ(turned_at_the_start("0.5"), TrialOutcome::kFalseGoal);
  EXPECT_EQ(turned_at_the_start("1"), TrialOutcome::kGoalReached);
}

TEST(OutcomesTest, TipOverOnSlopes) {
  EXPECT_EQ(LevelSand({"terrain.ground.slope_deg=25", "referee.tip_over_deg=20"}),
            TrialOutcome::kTipOver);
  EXPECT_NE(LevelSand({"terrain.ground.slope_deg=15", "referee.tip_over_deg=20"}),
            TrialOutcome::kTipOver);
}

TEST(OutcomesTest, TipOverOnVeryRoughGround) {
  const DriveParams drive = Pathfinder("level_sand", {"terrain.ground.roughness_rms_m=0.3",
                                                      "terrain.ground.roughness_wavelength_m=1.5",
                                                      "terrain.ground.soil.friction_angle_deg=56"});
  const std::vector<DriveResult> results = RunTrials(drive, 6);
  EXPECT_GE(Count(results)[TrialOutcome::kTipOver], 2);
  for (const DriveResult& result : results) {
    EXPECT_EQ(result.outcome == TrialOutcome::kTipOver, result.record.max_tilt_deg > 60.0);
  }
}

TEST(OutcomesTest, JammedOrHighCentredWhereTheRoverDrivesBlindlyIntoRocks) {
  const DriveParams drive = Pathfinder("obstacles_2.0", {"perception.hazard.enabled=false"});
  std::map<TrialOutcome, int> counts = Count(RunTrials(drive, 8));
  EXPECT_GE(counts[TrialOutcome::kJammed], 1);
  EXPECT_GE(counts[TrialOutcome::kHighCentred], 1);
}

// On loose sand its steered wheels push it off the wall, and it turns away.
TEST(OutcomesTest, JammedAtAWall) {
  EXPECT_EQ(LevelSand({"terrain.arena.kind=walled", "terrain.ground.soil.preset=hard_ground",
                       "course.start_y_m=1.2", "course.start_heading_deg=90"}),
            TrialOutcome::kJammed);
}

TEST(OutcomesTest, NoPath) {
  const auto cause = [](const Overrides& overrides) {
    const DriveResult result = RunTrial(Pathfinder("level_sand", overrides), {1, 0});
    return truth::CauseOf({0, result.outcome, result.detail, {}});
  };
  EXPECT_EQ(cause({"navigation.pathfinder.time_out_s=10"}), EndCause::kGaveUp);
  EXPECT_EQ(cause({"course.start_heading_deg=120", "referee.no_path_distance_m=0.5"}),
            EndCause::kPatienceDistance);
  EXPECT_EQ(cause({"course.start_heading_deg=180", "referee.no_path_turn_deg=90"}),
            EndCause::kPatienceTurning);
}

TEST(OutcomesTest, EnergyDepleted) {
  const DriveResult result = RunTrial(Pathfinder("level_sand", {"energy.battery_wh=0.05"}), {1, 0});
  EXPECT_EQ(result.outcome, TrialOutcome::kEnergyDepleted);
  const double last_tick_wh = 12.85 * 0.05 / 3600.0;
  EXPECT_NEAR(result.record.energy_wh, 0.05, last_tick_wh);
}

TEST(OutcomesTest, TimeLimit) {
  const DriveResult result =
      RunTrial(Pathfinder("level_sand", {"referee.time_limit_s=20"}), {1, 0});
  EXPECT_EQ(result.outcome, TrialOutcome::kTimeLimit);
  EXPECT_NEAR(result.record.sim_time_s, 20.0, 0.05 + 1e-9);
}

// Scans of an hour each, and batteries that seven of them empty.
TEST(OutcomesTest, ClocksThatAreOffEndNothing) {
  const auto drive = [](const Overrides& more) {
    const Overrides off{"perception.hazard.enabled=true", "clock.scan_time_s=3600",
                        "referee.no_path_time_s=0", "referee.time_limit_s=0",
                        "energy.battery_wh=0"};
    return RunTrial(Pathfinder("level_sand", off + more), {1, 0});
  };
  const DriveResult off = drive({});
  EXPECT_TRUE(truth::DeclaredSuccess(off.outcome));
  EXPECT_GT(off.record.sim_time_s, 50 * 3600.0);
  EXPECT_EQ(drive({"referee.no_path_time_s=3600"}).outcome, TrialOutcome::kNoPath);
  EXPECT_EQ(drive({"referee.time_limit_s=14400"}).outcome, TrialOutcome::kTimeLimit);
  EXPECT_EQ(drive({"energy.battery_wh=50"}).outcome, TrialOutcome::kEnergyDepleted);
}

TEST(OutcomesTest, LeftArenaWhereTheOdometerIsBehind) {
  const Overrides overshoot = {"perception.dead_reckoning.distance_scale=0.6"};
  const Overrides ends = {"terrain.arena.kind=virtual_reflected"};
  EXPECT_EQ(LevelSand(overshoot + ends), TrialOutcome::kLeftArena);
  EXPECT_EQ(LevelSand(overshoot), TrialOutcome::kFalseGoal);  // open arenas have no ends
}

// Whether a drive ends since soil in which a wheel of 6.5 cm under a sixth of the rover sinks by
// `sinkage_m` has swallowed the wheels. For n = 1, N = 2/3 b k sqrt(D) z^1.5.
bool IsSwallowed(double sinkage_m, double wheel_radius_m, const std::string& fidelity) {
  constexpr double kLoad_N = 20.0 * 9.81 / 6.0;
  const double modulus = 1.5 * kLoad_N / (0.08 * std::sqrt(2.0 * 0.065) * std::pow(sinkage_m, 1.5));
  const DriveResult result = RunTrial(
      Pathfinder("level_sand",
                 {"rover.fidelity=" + fidelity, "terrain.ground.soil.law=bekker",
                  "terrain.ground.soil.sinkage_exponent=1",
                  "terrain.ground.soil.cohesive_modulus_N_per_mn1=0",
                  "terrain.ground.soil.frictional_modulus_N_per_mn2=" + std::to_string(modulus),
                  "rover.geometry.wheel_radius_m=" + std::to_string(wheel_radius_m),
                  "referee.time_limit_s=30"}),
      {1, 0});
  return result.detail.find("sank into the soil") != std::string::npos;
}

// The limit is the radius of the wheels that the rover has. Smaller ones sink a little deeper in
// the same soil, as z grows with D^(-1/3), and reach their axles where those of 6.5 cm do not.
TEST(Embedded, FollowsTheRadiusOfTheRoversWheels) {
  for (const std::string fidelity : {"multibody", "quasi_static"}) {
    EXPECT_FALSE(IsSwallowed(0.059, 0.065, fidelity)) << fidelity;
    EXPECT_TRUE(IsSwallowed(0.071, 0.065, fidelity)) << fidelity;
    EXPECT_FALSE(IsSwallowed(0.047, 0.055, fidelity)) << fidelity;
    EXPECT_TRUE(IsSwallowed(0.059, 0.055, fidelity)) << fidelity;
  }
}

// What becomes of a rover that is stuck: by the referee's verdict, and where it notices it itself.

constexpr double kStall_W = 3.77 + 0.80 + 8.28;  // Matthies 1995, table 1

constexpr const char* kBatteries = "energy.battery_wh=50";

// Drives against a wall, on ground that is too hard for its steered wheels to push it off.
DriveParams AtAWall(const Overrides& overrides) {
  const Overrides wall{"terrain.arena.kind=walled", "terrain.ground.soil.preset=hard_ground",
                       "course.start_y_m=1.2", "course.start_heading_deg=90", kBatteries};
  return Pathfinder("level_sand", wall + overrides);
}

TracedTrial DriveAtAWall(const std::string& stuck_rover) {
  return RunTraced(AtAWall({"referee.stuck_rover=" + stuck_rover}), 0);
}

class StuckRoverTest : public testing::Test {
 protected:
  const TracedTrial ended_ = DriveAtAWall("end");
  const TracedTrial ran_on_ = DriveAtAWall("run_on");
  const truth::DriveRecord& end() const { return ended_.result.record; }
  const truth::DriveRecord& run_on() const { return ran_on_.result.record; }
};

TEST_F(StuckRoverTest, ItsRunEndsAtTheVerdictByDefault) {
  EXPECT_EQ(RefereeParams{}.stuck_rover, StuckRover::kEnd);
  ASSERT_EQ(ended_.result.outcome, TrialOutcome::kJammed);
  const RefereeParams referee;
  EXPECT_LT(end().sim_time_s, 60.0 + 2.0 * referee.stall_window_s);
  EXPECT_EQ(end().active_time_s, end().sim_time_s);
  EXPECT_EQ(end().active_energy_wh, end().energy_wh);
  EXPECT_NEAR(end().net_rate_m_s, end().true_distance_m / end().sim_time_s, 1e-12);
}

TEST_F(StuckRoverTest, WhatItWouldStillTakeIsTheRestOfTheBatteries) {
  EXPECT_NEAR(end().stall_energy_wh, AtAWall({}).energy.battery_wh - end().energy_wh, 1e-9);
  EXPECT_NEAR(end().stall_time_s, end().stall_energy_wh * 3600.0 / kStall_W, 1e-6);
  EXPECT_EQ(run_on().stall_time_s, end().stall_time_s);
  EXPECT_EQ(run_on().stall_energy_wh, end().stall_energy_wh);
}

TEST_F(StuckRoverTest, RunningOnAddsThatAndNothingElse) {
  EXPECT_THAT(Differences(ended_.result, ran_on_.result),
              testing::IsSubsetOf({"sim_time_s", "energy_wh", "net_rate_m_s",
                                   "single_scan_rate_m_s", "active_time_s", "active_energy_wh"}));
  // The same up to what adding and taking away the stall rounds.
  EXPECT_NEAR(run_on().active_time_s, end().active_time_s, 1e-9);
  EXPECT_NEAR(run_on().active_energy_wh, end().active_energy_wh, 1e-9);
  EXPECT_EQ(run_on().sim_time_s, end().sim_time_s + end().stall_time_s);
  EXPECT_NEAR(run_on().energy_wh, AtAWall({}).energy.battery_wh, 1e-9);
  EXPECT_NEAR(run_on().net_rate_m_s, run_on().true_distance_m / run_on().sim_time_s, 1e-12);
}

TEST_F(StuckRoverTest, TracesEndWithTheirRecords) {
  EXPECT_EQ(ended_.trace.now_s(), end().sim_time_s);
  EXPECT_EQ(ended_.trace.rests.back().sample.activity, "");
  EXPECT_EQ(ended_.trace.events.back().kind, "end");
  EXPECT_EQ(ended_.trace.events.back().time_s, end().sim_time_s);
  EXPECT_EQ(ran_on_.trace.now_s(), run_on().sim_time_s);
  EXPECT_EQ(ran_on_.trace.rests.back().sample.activity, "stall");
  EXPECT_EQ(ran_on_.trace.events.back().time_s, run_on().sim_time_s);
  EXPECT_EQ(ran_on_.trace.samples.size(), ended_.trace.samples.size());
}

TEST(EndlessBatteriesTest, AStallThatNothingEndsIsNotToldOf) {
  const DriveResult endless = RunTrial(AtAWall({"energy.battery_wh=0"}), {1, 0});
  ASSERT_EQ(endless.outcome, TrialOutcome::kJammed);
  EXPECT_EQ(endless.record.stall_time_s, 0.0);
  EXPECT_EQ(endless.record.stall_energy_wh, 0.0);
  EXPECT_THAT(Differences(RunTrial(AtAWall({}), {1, 0}), endless),
              testing::UnorderedElementsAre("stall_time_s", "stall_energy_wh"));
}

TEST(FreeRoverTest, WhatIsNotStuckHasNoStall) {
  for (const std::string option : {"end", "run_on"}) {
    const DriveResult result =
        RunTrial(Pathfinder("level_sand", {kBatteries, "referee.stuck_rover=" + option}), {1, 0});
    ASSERT_EQ(result.outcome, TrialOutcome::kGoalReached);
    EXPECT_EQ(result.record.stall_time_s, 0.0);
    EXPECT_EQ(result.record.stall_energy_wh, 0.0);
    EXPECT_EQ(result.record.active_time_s, result.record.sim_time_s);
  }
}

constexpr std::string_view kNoticed = truth::Info(truth::EndCause::kNoticedStuck).sentence;

// Starts across the way to its goal, so that every navigator tells it to turn.
class NoticingRoverTest : public testing::TestWithParam<const char*> {
 protected:
  static DriveResult Drive(const std::string& reaction, const Overrides& overrides) {
    const Overrides across{"course.start_heading_deg=90",
                           std::string("navigation.navigator=") + GetParam(),
                           "navigation.on_board_stuck.reaction=" + reaction};
    return RunTrial(Pathfinder("level_sand", across + overrides), {1, 0});
  }
};

// Its motors cannot turn its wheels.
TEST_P(NoticingRoverTest, GivesUpBeforeTheRefereeCallsItJammed) {
  const Overrides weak{"rover.drive.stall_torque_Nm=0.01"};
  const DriveResult off = Drive("off", weak);
  EXPECT_EQ(off.outcome, TrialOutcome::kJammed) << off.detail;
  EXPECT_EQ(off.record.stuck_noticed, 0.0);
  const DriveResult give_up = Drive("give_up", weak);
  EXPECT_EQ(give_up.outcome, TrialOutcome::kNoPath);
  EXPECT_EQ(give_up.detail, kNoticed);
  EXPECT_EQ(give_up.record.stuck_noticed, 1.0);
  EXPECT_EQ(give_up.record.stall_time_s, 0.0);
  EXPECT_LT(give_up.record.sim_time_s, off.record.sim_time_s);
}

// Negative control, which also shows that looking for it changes nothing else.
TEST_P(NoticingRoverTest, ARoverThatGetsOnNoticesNothing) {
  const DriveResult off = Drive("off", {});
  for (const std::string reaction : {"give_up", "back_off"}) {
    const DriveResult looking = Drive(reaction, {});
    EXPECT_EQ(looking.record.stuck_noticed, 0.0);
    EXPECT_THAT(Differences(off, looking), testing::IsEmpty());
  }
}

INSTANTIATE_TEST_SUITE_P(Navigators, NoticingRoverTest,
                         testing::Values("pathfinder", "gestalt", "route"),
                         [](const auto& navigator) { return std::string(navigator.param); });

TEST(StuckReactionTest, BacksOffOnceAndThenGivesUp) {
  const TracedTrial trial = RunTraced(AtAWall({"navigation.on_board_stuck.reaction=back_off"}), 0);
  EXPECT_EQ(trial.result.outcome, TrialOutcome::kNoPath);
  EXPECT_EQ(trial.result.detail, kNoticed);
  EXPECT_EQ(trial.result.record.stuck_noticed, 2.0);
  EXPECT_GE(trial.result.record.reversals, 1.0);
  const std::vector<truth::TraceEvent> felt = EventsOf(trial.trace, "felt");
  EXPECT_EQ(std::count_if(felt.begin(), felt.end(),
                          [](const auto& event) { return event.detail == "stuck: no turn"; }),
            2);
}

// Operators who turn it at a mirror line end the window: a rover that always takes itself for
// strained notices it a whole window later.
TEST(StuckReactionTest, AMoveByHandBeginsAWindow) {
  const DriveParams drive = Pathfinder(
      "level_sand", {"terrain.arena.kind=virtual_reflected", "course.start_y_m=0.8",
                     "course.start_heading_deg=60", "navigation.on_board_stuck.reaction=give_up",
                     "sensors.vehicle.motor_current.enabled=true",
                     "perception.stuck_detector.strain_current_A=0.01"});
  const TracedTrial trial = RunTraced(drive, 0);
  const auto time_s = [&](const char* kind) {
    const std::vector<truth::TraceEvent> events = EventsOf(trial.trace, kind);
    return events.empty() ? -1.0 : events.front().time_s;
  };
  const double window_s = drive.perception.stuck_detector.window_s;
  ASSERT_GT(time_s("reflection"), 0.5);
  ASSERT_LT(time_s("reflection"), window_s);
  EXPECT_GT(time_s("felt"), time_s("reflection") + window_s - 0.1);
}

// A straight drive shows in the motor currents alone.
TEST(StuckReactionTest, StrainedMotorsAreNoticedOnAStraightDrive) {
  const auto drive = [](const std::string& sensor, const std::string& strain_A) {
    return RunTrial(
        Pathfinder("level_sand", {"navigation.on_board_stuck.reaction=give_up",
                                  "sensors.vehicle.motor_current.enabled=" + sensor,
                                  "perception.stuck_detector.strain_current_A=" + strain_A}),
        {1, 0});
  };
  // Rolling over level sand takes 0.02 to 0.03 A.
  EXPECT_EQ(drive("true", "0.01").detail, kNoticed);
  EXPECT_EQ(drive("true", "0.05").record.stuck_noticed, 0.0);
  EXPECT_EQ(drive("false", "0.01").record.stuck_noticed, 0.0);
}

}  // namespace
}  // namespace rockyard::trial

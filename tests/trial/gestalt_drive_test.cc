// Whole drives of the map-based navigator: arrival, what ends a step, time and energy, watchers;
// how they end where they cannot succeed; and the four pairs of navigator and sensor.

#include <gmock/gmock.h>

#include <algorithm>

#include "math/angles.h"
#include "navigation/gestalt/gestalt_params.h"
#include "trial/clock/compute_profile.h"
#include "trial/clock/compute_tables.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using truth::TrialOutcome;

TEST(GestaltDriveTest, ArrivesOnEmptySandWithEitherRover) {
  for (const char* name : {"abundance", "abundance_rocky_3_2"}) {
    const DriveParams drive =
        Gestalt(name, kShortAndEmpty + Overrides{"localization.estimator=oracle"});
    const DriveResult result = RunTrial(drive, {1, 0});
    EXPECT_EQ(result.outcome, TrialOutcome::kGoalReached) << name << ": " << result.detail;
    EXPECT_EQ(result.record.rear_image_sets, 0.0) << name;
    EXPECT_EQ(result.record.point_turns, 0.0) << name;
    const auto& gestalt = drive.navigation.navigators.params<navigation::GestaltParams>();
    const double tolerance_m = gestalt.waypoints.goal_tolerance_m;
    EXPECT_NEAR(result.record.true_distance_m, 3.0 - tolerance_m, tolerance_m) << name;
    // Straight ahead: one image set for each step.
    const double steps = std::ceil((3.0 - tolerance_m) / gestalt.drive.step_m);
    EXPECT_NEAR(result.record.moves, steps, 1.0) << name;
    EXPECT_EQ(result.record.image_sets, result.record.moves) << name;
  }
}

// A rover that believes its wheels to be 10 % larger than they are measures a step of 0.35 m after
// 0.35 m / 1.1 of what they roll.
TEST(GestaltDriveTest, StepsEndByWhatIsMeasured) {
  const auto metres_a_move = [](const char* percent) {
    const DriveResult result = RunTrial(
        Gestalt("abundance",
                kShortAndEmpty + kTrueEncoders +
                    Overrides{"course.goal_radius_m=3", std::string("perception.calibration.drive."
                                                                    "wheel_radius_percent=") +
                                                            percent}),
        {1, 0});
    EXPECT_EQ(result.outcome, TrialOutcome::kGoalReached);
    return result.record.true_distance_m / result.record.moves;
  };
  EXPECT_NEAR(metres_a_move("10") / metres_a_move("0"), 1.0 / 1.1, 0.02);
}

double StepEnergyWh(const DriveParams& drive, const truth::DriveRecord& record, double steer_s) {
  const EnergyParams& energy = drive.energy;
  const double base_W = energy.cpu_W + energy.gyro_W;
  const double moving_W = base_W + energy.accelerometers_W;
  return ((record.drive_time_s + record.turn_time_s) * (moving_W + energy.driving_W) +
          steer_s * (moving_W + energy.steering_W) +
          record.imaging_time_s * (base_W + energy.stereo_imaging_W) +
          (record.compute_time_s + record.move_overhead_time_s) * (base_W + energy.computing_W)) /
         3600.0;
}

TEST(GestaltDriveTest, TimeAndEnergyAddUp) {
  const DriveParams drive =
      Gestalt("abundance", {"energy.computing_W=2.5", "energy.stereo_imaging_W=1.25"});
  const ComputeTimes times = MakeComputeTimes(drive.clock.compute, {});
  bool looked_behind = false;
  for (std::uint32_t index = 0; index < 12 || (!looked_behind && index < 60); ++index) {
    const TracedTrial trial = RunTraced(drive, index);
    const truth::DriveRecord& record = trial.result.record;
    if (trial.result.outcome != TrialOutcome::kGoalReached) continue;  // a stall takes more
    looked_behind = looked_behind || record.rear_image_sets > 0.0;
    EXPECT_NEAR(record.imaging_time_s, record.image_sets * times.acquisition_s, 1e-6);
    EXPECT_NEAR(record.compute_time_s,
                times.start_up_s + record.image_sets * (times.stereo_s + times.navigation_s), 1e-6);
    const double tick_s = 1.0 / drive.clock.control_rate_hz;
    const double steer_s =
        tick_s * static_cast<double>(std::count_if(
                     trial.trace.samples.begin(), trial.trace.samples.end(),
                     [](const truth::TraceSample& s) { return s.activity == "steer"; }));
    EXPECT_NEAR(record.steer_time_s, steer_s, 1e-6);
    EXPECT_NEAR(record.move_overhead_time_s, record.moves * drive.clock.compute.move_overhead_s,
                1e-6);
    EXPECT_NEAR(record.sim_time_s,
                record.drive_time_s + record.turn_time_s + steer_s + record.imaging_time_s +
                    record.compute_time_s + record.move_overhead_time_s,
                1e-6);
    EXPECT_NEAR(record.move_time_s,
                record.sim_time_s - record.imaging_time_s - record.compute_time_s, 1e-6);
    EXPECT_EQ(record.stall_time_s, 0.0);
    EXPECT_EQ(record.active_time_s, record.sim_time_s);
    EXPECT_EQ(record.active_energy_wh, record.energy_wh);
    EXPECT_NEAR(record.energy_wh, StepEnergyWh(drive, record, steer_s), 1e-9);
    EXPECT_NEAR(record.imaging_energy_wh, record.imaging_time_s * (3.77 + 0.80 + 1.25) / 3600.0,
                1e-9);
    EXPECT_NEAR(record.compute_energy_wh, record.compute_time_s * (3.77 + 0.80 + 2.5) / 3600.0,
                1e-9);
  }
  EXPECT_TRUE(looked_behind);
}

TEST(GestaltDriveTest, TracesAndWatchersChangeNothing) {
  const DriveParams drive = Gestalt("abundance");
  for (std::uint32_t index = 3; index < 6; ++index) {
    const core::TrialKey key{1, index};
    const DriveResult plain = RunTrial(drive, key);
    truth::Trace trace;
    std::int64_t steps = 0;
    const auto watch = [&](const WatchedStep& step) {
      EXPECT_EQ(step.view.step, steps++);
      EXPECT_FALSE(step.view.forward.empty());
      EXPECT_EQ(step.view.looked_behind, step.cloud.direction == messages::LookDirection::kBehind);
    };
    const DriveResult watched = RunTrial(drive, key, &trace, {.step = watch});
    EXPECT_THAT(Differences(plain, watched), testing::IsEmpty());
    EXPECT_EQ(static_cast<double>(steps),
              watched.record.image_sets - watched.record.rear_image_sets);
    EXPECT_EQ(static_cast<double>(EventsOf(trace, "look").size()), watched.record.image_sets);
  }
}

TEST(GestaltDriveTest, TrialsAreThemselvesInAnyOrder) {
  const DriveParams drive = Gestalt("viking_lander_2", {"referee.time_limit_s=1500"});
  const DriveResult first = RunTrial(drive, {1, 4});
  RunTrial(drive, {1, 3});
  EXPECT_THAT(Differences(first, RunTrial(drive, {1, 4})), testing::IsEmpty());
}

TEST(GestaltDriveTest, DrivesOnInTheVirtualArena) {
  const DriveParams drive =
      Gestalt("abundance", {"terrain.arena.kind=virtual_reflected", "terrain.arena.width_m=4",
                            "terrain.rocks.k_per_m2=0.008"});
  double reflections = 0.0;
  for (std::uint32_t index = 0; index < 8; ++index) {
    const DriveResult result = RunTrial(drive, {1, index});
    EXPECT_NE(result.outcome, TrialOutcome::kSimulatorFault) << result.detail;
    reflections += result.record.reflections;
  }
  EXPECT_GT(reflections, 0.0);
}

// High rocks side by side on a circle about the start, but for a gap of that half angle ahead.
DriveParams InARing(double gap_rad) {
  DriveParams drive = Gestalt("abundance", {"localization.estimator=oracle"});
  drive.terrain.rocks.kind = terrain::RockFieldKind::kListed;
  terrain::ListedRocksParams& ring = drive.terrain.rocks.listed;
  constexpr int kRocks = 24;
  constexpr double kRadius_m = 1.7;
  for (int i = 0; i < kRocks; ++i) {
    const double angle_rad = std::numbers::pi * (2.0 * i / kRocks - 1.0);
    if (std::abs(angle_rad) < gap_rad) continue;
    ring.x_m.push_back(kRadius_m * std::cos(angle_rad));
    ring.y_m.push_back(kRadius_m * std::sin(angle_rad));
    ring.diameter_m.push_back(0.5);
    ring.height_m.push_back(0.5);
  }
  return drive;
}

TEST(GestaltEndingsTest, FindsNoPathOutOfARing) {
  const DriveResult result = RunTrial(InARing(0.0), {1, 0});
  EXPECT_EQ(result.outcome, TrialOutcome::kNoPath) << result.detail;
  EXPECT_LT(std::hypot(result.record.final_x_m, result.record.final_y_m), 1.2);
  EXPECT_GT(result.record.rear_image_sets, 0.0);
  EXPECT_GT(result.record.point_turns, 0.0);
}

// Negative control of the ring.
TEST(GestaltEndingsTest, LeavesARingWithAGap) {
  const DriveResult result = RunTrial(InARing(std::numbers::pi / 3.0), {1, 0});
  EXPECT_EQ(result.outcome, TrialOutcome::kGoalReached) << result.detail;
}

TEST(GestaltEndingsTest, ARoverWithoutTorqueIsJammed) {
  const DriveResult result = RunTrial(
      Gestalt("abundance", kShortAndEmpty + Overrides{"rover.drive.stall_torque_Nm=0.05",
                                                      "sensors.vehicle.motor_current.enabled="
                                                      "false"}),
      {1, 0});
  EXPECT_EQ(result.outcome, TrialOutcome::kJammed) << result.detail;
  EXPECT_LT(result.record.true_distance_m, 0.1);
  const truth::DriveRecord& record = result.record;
  EXPECT_GT(record.stall_time_s, 3600.0);
  EXPECT_LT(record.sim_time_s, 600.0);
  const double stall_W = 3.77 + 0.80 + 0.82 + 8.28;  // Matthies 1995, table 1
  EXPECT_NEAR(record.stall_time_s * stall_W / 3600.0, record.stall_energy_wh, 1e-6);
}

TEST(GestaltEndingsTest, TheTiltGuardStopsTheRoverOnASlope) {
  const Overrides slope = kShortAndEmpty + Overrides{"terrain.ground.slope_deg=8"};
  const DriveResult free = RunTrial(Gestalt("abundance", slope), {1, 0});
  const DriveResult guarded = RunTrial(
      Gestalt("abundance", slope + Overrides{"perception.vehicle_hazard.max_tilt_deg=4"}), {1, 0});
  EXPECT_EQ(free.outcome, TrialOutcome::kGoalReached) << free.detail;
  EXPECT_EQ(free.record.safeguard_stops, 0.0);
  EXPECT_EQ(guarded.outcome, TrialOutcome::kNoPath) << guarded.detail;
  EXPECT_GE(guarded.record.tilt_hazards, 1.0);
  EXPECT_GE(guarded.record.safeguard_stops, guarded.record.tilt_hazards);
}

struct Pair {
  std::string navigator;
  std::string sensor;
};

// On nearly empty ground and with the true pose: a pair that does not arrive here cannot use its
// sensor. A map of the light stripe's twenty points loses its way in one field of twelve (55 of 60
// arrive), so one of five may.
class PairTest : public testing::TestWithParam<Pair> {
 protected:
  static std::vector<DriveResult> Run(const Pair& pair) {
    return RunTrials(Gestalt("abundance_rocky_3_2",
                             {"terrain.rocks.k_per_m2=0.0002", "localization.estimator=oracle",
                              "navigation.navigator=" + pair.navigator,
                              "sensors.terrain_sensor=" + pair.sensor}),
                     5);
  }
};

TEST_P(PairTest, ArrivesAmongTheSameFewRocks) {
  const bool map = GetParam().navigator == "gestalt";
  const bool stereo = GetParam().sensor == "stereo";
  const std::vector<DriveResult> results = Run(GetParam());
  const std::vector<DriveResult> published = Run({"pathfinder", "light_stripe"});
  int arrived = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const truth::DriveRecord& record = results[i].record;
    arrived += results[i].outcome == TrialOutcome::kGoalReached ? 1 : 0;
    EXPECT_EQ(record.scans > 0.0, !stereo);
    EXPECT_EQ(record.scan_time_s > 0.0, !stereo);
    EXPECT_EQ(record.image_sets > 0.0, stereo);
    EXPECT_EQ(record.imaging_time_s > 0.0, stereo);
    EXPECT_EQ(record.compute_time_s > 0.0, stereo || map);
    if (!map || !stereo) {
      EXPECT_EQ(record.rear_image_sets, 0.0);
    }
    if (map) {
      EXPECT_EQ(record.hazards_believed, 0.0);
    }
    EXPECT_GT(record.rocks, 0.0);
    EXPECT_EQ(record.rocks, published[i].record.rocks);
    EXPECT_EQ(record.rock_cover, published[i].record.rock_cover);
  }
  EXPECT_GE(arrived, map && !stereo ? 4 : 5);
}

INSTANTIATE_TEST_SUITE_P(
    TwoByTwo, PairTest,
    testing::Values(Pair{"pathfinder", "light_stripe"}, Pair{"pathfinder", "stereo"},
                    Pair{"gestalt", "light_stripe"}, Pair{"gestalt", "stereo"}),
    [](const auto& pair) { return pair.param.navigator + "_" + pair.param.sensor; });

// What a look takes with each pair; table 2 on the grid of table 1.
TEST(LookTimeTest, EachPairTakesItsPartsOfALook) {
  const auto time = [](const std::string& navigator, const std::string& sensor) {
    return MakeLookTime(Gestalt(
        "abundance", {"navigation.navigator=" + navigator, "sensors.terrain_sensor=" + sensor,
                      "clock.compute.behaviour_s=0.5"}));
  };
  const auto expect = [](const LookTime& look, double scanning_s, double imaging_s,
                         double computing_s) {
    EXPECT_NEAR(look.scanning_s, scanning_s, 1e-9);
    EXPECT_NEAR(look.imaging_s, imaging_s, 1e-9);
    EXPECT_NEAR(look.computing_s, computing_s, 1e-9);
  };
  expect(time("pathfinder", "light_stripe"), 20.0, 0.0, 0.0);
  expect(time("gestalt", "light_stripe"), 20.0, 0.0, 13.154);
  expect(time("gestalt", "stereo"), 0.0, 8.974, 4.634 + 13.154);
  expect(time("pathfinder", "stereo"), 0.0, 8.974, 4.634 + 0.5);
}

// What a move of the map-based navigator takes, and what the rover believes of its height.

// Twenty whole steps over empty sand, without errors of localization.
DriveParams TwentySteps(const Overrides& overrides = {}) {
  return Gestalt("viking_lander_2", kTrueEncoders +
                                        Overrides{"terrain.rocks.kind=none", "course.goal_x_m=7",
                                                  "localization.estimator=oracle"} +
                                        overrides);
}

// Time of a move beyond its looks.
double DrivingTime(const truth::DriveRecord& record) { return record.move_time_s / record.moves; }

// Table 2: 26.76 s a look and 15 s of driving a move. 154 looks for 105 moves are then 54 s a move.
TEST(GestaltMoveTest, AMoveTakesTheTimeOfTable2) {
  const DriveParams drive = TwentySteps();
  const double look_s = MakeLookTime(drive).total_s();
  EXPECT_NEAR(look_s, 26.762, 1e-9);
  const DriveResult result = RunTrial(drive, {1, 0});
  ASSERT_EQ(result.outcome, TrialOutcome::kGoalReached) << result.detail;
  const truth::DriveRecord& record = result.record;
  EXPECT_NEAR(record.moves, 20.0, 1.0);
  EXPECT_NEAR(record.sim_time_s,
              StartUpTime(drive) + record.image_sets * look_s + record.moves * DrivingTime(record),
              1e-6);
  EXPECT_NEAR(DrivingTime(record), kAthenaRows.back().time_s, 0.5);
  EXPECT_NEAR(look_s * kAthenaImageSets / kAthenaMoves + DrivingTime(record), 54.25, 0.5);
}

// Negative control: wheels alone take about half of it.
TEST(GestaltMoveTest, WheelsAloneTakeLess) {
  const DriveResult result = RunTrial(TwentySteps({"clock.compute.move_overhead_s=0"}), {1, 0});
  ASSERT_EQ(result.outcome, TrialOutcome::kGoalReached) << result.detail;
  EXPECT_EQ(result.record.move_overhead_time_s, 0.0);
  EXPECT_LT(DrivingTime(result.record), 9.0);
  EXPECT_GT(DrivingTime(result.record), 6.5);
}

// The overhead is spent at rest: the course stays what it was, tick by tick.
TEST(GestaltMoveTest, TheOverheadChangesTimeAndEnergyAlone) {
  const truth::DriveRecord with = RunTrial(TwentySteps(), {1, 0}).record;
  const truth::DriveRecord without =
      RunTrial(TwentySteps({"clock.compute.move_overhead_s=0"}), {1, 0}).record;
  EXPECT_EQ(with.true_distance_m, without.true_distance_m);
  EXPECT_EQ(with.moves, without.moves);
  EXPECT_EQ(with.compute_time_s, without.compute_time_s);
  EXPECT_NEAR(with.sim_time_s - without.sim_time_s, 7.4 * with.moves, 1e-6);
  const double base_W = 3.77 + 0.80;  // Matthies 1995, table 1
  EXPECT_NEAR(with.energy_wh - without.energy_wh, 7.4 * with.moves * base_W / 3600.0, 1e-9);
}

// Along a slope of s a rover that takes the ground to be flat is wrong by -d tan(s); one that knows
// its pose is not; one that keeps no map is not asked.
TEST(GestaltMoveTest, HeightErrorIsBelievedLessTrueHeight) {
  constexpr double kSlope_deg = 5.0;
  const Overrides slope = {"terrain.rocks.kind=none", "course.goal_x_m=3",
                           "terrain.ground.slope_deg=" + std::to_string(kSlope_deg)};
  const auto drive = [&](const Overrides& overrides) {
    return RunTrial(Gestalt("abundance", slope + overrides), {1, 0}).record;
  };
  const truth::DriveRecord flat = drive({"perception.attitude.height=level"});
  EXPECT_GT(flat.final_x_m, 1.0);
  const double climb_m = std::tan(math::DegToRad(kSlope_deg)) * flat.final_x_m;
  EXPECT_NEAR(flat.height_error_m, -climb_m, 0.02 * climb_m);
  EXPECT_EQ(drive({"localization.estimator=oracle"}).height_error_m, 0.0);
  EXPECT_LT(std::abs(drive({}).height_error_m), 0.25 * climb_m);
  const truth::DriveRecord behaviour = RunTrial(Pathfinder("nominal", slope), {1, 0}).record;
  EXPECT_GT(behaviour.final_x_m, 1.0);
  EXPECT_EQ(behaviour.height_error_m, 0.0);
}

}  // namespace
}  // namespace rockyard::trial

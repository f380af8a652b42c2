// Whole drives of the map-based navigator: arrival, what ends a step, time and energy, watchers.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "navigation/gestalt/gestalt_params.h"
#include "trial/compute_profile.h"
#include "trial/gestalt_trials.h"
#include "trial/look_time.h"

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
    const double tolerance_m =
        drive.navigation.navigators.params<navigation::GestaltParams>().waypoints.goal_tolerance_m;
    EXPECT_NEAR(result.record.true_distance_m, 3.0 - tolerance_m, tolerance_m) << name;
    // Straight ahead: one image set for each step.
    const double steps =
        std::ceil((3.0 - tolerance_m) /
                  drive.navigation.navigators.params<navigation::GestaltParams>().drive.step_m);
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
  for (std::uint32_t index = 0; index < 3; ++index) {
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
    const auto looks = std::count_if(trace.events.begin(), trace.events.end(),
                                     [](const auto& event) { return event.kind == "look"; });
    EXPECT_EQ(static_cast<double>(looks), watched.record.image_sets);
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

}  // namespace
}  // namespace rockyard::trial

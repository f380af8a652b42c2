// Whole drives of GESTALT that stops to look, looks on the move (CSOD) and drives splines (CSAD).
#include <gtest/gtest.h>

#include "core/space_filling.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using truth::DriveRecord;

constexpr const char* kCycles[] = {"stop_and_look", "csod", "csad"};
const std::string kContinuous = "navigation.gestalt.continuous.";

DriveParams Continuous(const std::string& name, const Overrides& overrides = {}) {
  const std::string folder = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/continuous/";
  return scenario::LoadScenario(folder + name + ".json", overrides).drive;
}

DriveRecord Record(const std::string& name, const Overrides& overrides = {}) {
  return RunTrial(Continuous(name, overrides), {1, 0}).record;
}

const Overrides kEmpty = {"terrain.rocks.kind=none"};
// No noise, no ramp, no time of computing, no limit of steering.
const Overrides kIdeal = kTrueEncoders + kEmpty +
                         Overrides{"localization.estimator=oracle",
                                   "sensors.visual_odometry.enabled=false",
                                   "clock.compute.computer=none",
                                   "clock.compute.acquisition_s=0",
                                   "rover.drive.ramp_s=0",
                                   "rover.drive.steer_rate_deg_s=1000",
                                   "navigation.wheel_driver.steer_rate_deg_s=1000"};

// Over empty ground with a goal aside all of them arrive, and the less they stand the sooner.
TEST(ContinuousTrial, TheLessARoverStandsTheSoonerItArrives) {
  for (const char* fidelity : {"quasi_static", "multibody"}) {
    const Overrides course =
        kEmpty + Overrides{"course.goal_y_m=3", std::string("rover.fidelity=") + fidelity};
    std::vector<DriveRecord> records;
    for (const char* cycle : kCycles) {
      const DriveResult result = RunTrial(Continuous(cycle, course), {1, 0});
      ASSERT_EQ(result.outcome, truth::TrialOutcome::kGoalReached) << cycle << result.detail;
      records.push_back(result.record);
    }
    EXPECT_LT(records[1].sim_time_s, records[0].sim_time_s);
    EXPECT_LT(records[2].sim_time_s, 0.95 * records[1].sim_time_s);
    EXPECT_LT(records[2].stops, records[1].stops);
    EXPECT_LT(records[1].stops, records[0].stops);
    EXPECT_EQ(records[0].plans_on_the_move, 0.0);
    for (const std::size_t i : {1u, 2u}) {
      EXPECT_EQ(records[i].image_sets, records[i].plans_on_the_move + 1.0);
      EXPECT_EQ(records[i].late_plans, 0.0);
      EXPECT_EQ(records[i].unsafe_plans, 0.0);
      EXPECT_LT(records[i].plan_start_error_m, 0.01);
      // The way that vision saw is that of the rover, to what it sees wrong.
      EXPECT_NEAR(records[i].visual_distance_m, records[i].true_distance_m,
                  0.02 * records[i].true_distance_m);
    }
  }
}

// Without noise and latency a plan, which is told a tick after its look, begins where it was
// predicted to, to what a tick at the speed of the last one differs from that tick.
TEST(ContinuousTrial, WithoutLatencyAPlanBeginsWhereTheRoverIs) {
  for (const char* cycle : {"csod", "csad"}) {
    const DriveRecord record = Record(cycle, kIdeal + Overrides{"course.goal_y_m=3"});
    EXPECT_GT(record.plans_on_the_move, 20.0);
    EXPECT_LT(record.plan_start_error_m, 1e-5) << cycle;
  }
}

// With latency it begins off by what the motion has differed from the plan meanwhile: less with a
// perfect localization than with wheels that slip, and not at all where it begins as estimated.
TEST(ContinuousTrial, WithLatencyAPlanBeginsOffByWhatTheRoverSees) {
  const Overrides slow = {"clock.compute.computer=mer_rad6000", "clock.compute.acquisition_s=0"};
  const DriveRecord predicted = Record("csad", slow);
  EXPECT_GT(predicted.plan_start_error_m, 2.0 * Record("csad").plan_start_error_m);
  const DriveRecord estimated =
      Record("csad", slow + Overrides{kContinuous + "plan_start=estimated"});
  EXPECT_EQ(estimated.plan_start_error_m, 0.0);
}

// A computer that is slower than the motion leaves the rover standing for nearly each plan of a
// drive that steers while it moves. Where wheels are steered at rest, arcs are as tight as turns,
// and many are driven so slowly that the plan is ready in time: in eight such drives a quarter to
// four fifths were late.
TEST(ContinuousTrial, ASlowComputerMakesPlansLate) {
  const Overrides slow = kEmpty + Overrides{"clock.compute.computer=mer_rad6000",
                                            "sensors.visual_odometry.enabled=false",
                                            "localization.estimator=dead_reckoning"};
  for (const auto& [cycle, share] : {std::pair("csod", 0.25), std::pair("csad", 0.9)}) {
    const DriveRecord late = Record(cycle, slow);
    EXPECT_GE(late.late_plans, share * late.plans_on_the_move) << cycle;
    EXPECT_GT(late.sim_time_s, 1.8 * Record(cycle, kEmpty).sim_time_s) << cycle;
    const DriveRecord again =
        Record(cycle, slow + Overrides{kContinuous + "late_plan=stop_and_look"});
    EXPECT_EQ(again.plans_on_the_move, 0.0);
    EXPECT_GT(again.late_plans, 0.0);
  }
}

// Where nothing may overlap a navigator that looks on the move stops for each look; such a scenario
// is refused, so that the parameters are changed here behind the checks.
TEST(ContinuousTrial, WithoutOverlapItStopsForEachLook) {
  DriveParams drive = Continuous("csod", kEmpty);
  drive.clock.overlap = {};
  const DriveRecord record = RunTrial(drive, {1, 0}).record;
  EXPECT_GE(record.stops, record.plans_on_the_move);
  EXPECT_GT(record.plans_on_the_move, 20.0);
}

TEST(ContinuousTrial, IsAPureFunctionOfItsKey) {
  for (const char* cycle : kCycles) {
    const DriveParams drive = Continuous(cycle);
    const DriveRecord first = RunTrial(drive, {7, 3}).record;
    const DriveRecord again = RunTrial(drive, {7, 3}).record;
    const DriveRecord other = RunTrial(drive, {7, 4}).record;
    EXPECT_EQ(first.final_x_m, again.final_x_m);
    EXPECT_EQ(first.energy_wh, again.energy_wh);
    EXPECT_NE(first.energy_wh, other.energy_wh);
  }
}

// Random settings within their bounds end in an outcome.
TEST(ContinuousTrialProperty, AnySoundSettingsEndInAnOutcome) {
  const auto between = [](double low, double high, double share) {
    return std::to_string(low + share * (high - low));
  };
  const auto one_of = [](const std::vector<std::string>& names, double share) {
    return names[static_cast<std::size_t>(share * static_cast<double>(names.size()))];
  };
  int arrived = 0;
  std::uint32_t trial = 0;
  for (const std::vector<double>& u : core::LatinHypercube(10, 10, 5)) {
    const Overrides settings = {
        kContinuous + "motion_m=" + between(0.06, 2.9, u[0]),
        kContinuous + "replan_fraction=" + between(0.02, 1.0, u[1]),
        kContinuous + "plan_start=" + one_of({"predicted", "estimated"}, u[2]),
        kContinuous + "no_safe_plan=" + one_of({"stop", "finish"}, u[3]),
        kContinuous + "late_plan=" + one_of({"wait", "stop_and_look"}, u[4]),
        "clock.compute.computer=" + one_of({"none", "athena_2012", "mer_rad6000"}, u[5]),
        "terrain.rocks.k_per_m2=" + between(0.001, 0.02, u[6]),
        "navigation.gestalt.splines.law=" + one_of({"distance", "time"}, u[7]),
        "navigation.gestalt.speed.min_speed_share=" + between(0.1, 1.0, u[8]),
        "rover.drive.steer_rate_deg_s=" + between(2.0, 200.0, u[9])};
    for (const char* cycle : {"csod", "csad"}) {
      const DriveResult result = RunTrial(Continuous(cycle, settings), {11, trial});
      EXPECT_GT(result.record.sim_time_s, 0.0);
      arrived += result.outcome == truth::TrialOutcome::kGoalReached ? 1 : 0;
    }
    ++trial;
  }
  EXPECT_GT(arrived, 2);
}

}  // namespace
}  // namespace rockyard::trial

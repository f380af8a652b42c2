// The published net rate comes out of the simulated clock (Matthies 1995, sections 6 and 8).
#include <gtest/gtest.h>

#include <cmath>

#include "navigation/pathfinder/pathfinder_params.h"
#include "scenario/shipped.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

constexpr double kFourHours_s = 14400.0;

DriveParams Mars(const std::string& name, const Overrides& overrides = {}) {
  return scenario::Shipped("mars/" + name, overrides).drive;
}

// One scan a step: v = s / (s / v0 + T + stop), with the step s rounded up to whole ticks.
double ClosedForm(const DriveParams& drive, double scans_per_step) {
  const double speed_m_s = drive.rover.drive.speed_m_s;
  const double tick_m = speed_m_s / drive.clock.control_rate_hz;
  const double step_m =
      std::ceil(drive.navigation.navigators.params<navigation::PathfinderParams>().scan_interval_m /
                    tick_m -
                1e-9) *
      tick_m;
  return step_m /
         (step_m / speed_m_s + drive.clock.stop_time_s + scans_per_step * drive.clock.scan_time_s);
}

TEST(NetRateTest, OneScanAStepIsThePublishedRate) {
  const DriveParams drive = Mars("traverse_single_scan");
  const DriveResult result = RunTrial(drive, {1, 0});
  EXPECT_EQ(result.outcome, truth::TrialOutcome::kTimeLimit);
  EXPECT_EQ(result.record.rescans, 0.0);
  const double expected_m_s = ClosedForm(drive, 1.0);
  EXPECT_NEAR(expected_m_s, 0.0022, 0.00005);  // printed: 0.22 cm/s
  EXPECT_NEAR(result.record.net_rate_m_s, expected_m_s, 0.002 * expected_m_s);
  EXPECT_EQ(result.record.single_scan_rate_m_s, result.record.net_rate_m_s);
  // "a maximum traverse of 30 m in the four hours": the printed rate gives 31.7 m.
  EXPECT_NEAR(result.record.true_distance_m, expected_m_s * kFourHours_s, 0.1);
  EXPECT_NEAR(result.record.true_distance_m, 31.0, 1.0);
}

// With n scans a step on clear ground, n = 1 / (1 - p) where a scan shows a hazard with probability
// p and the rover scans until one is clear or two agree. Counted here, so that the closed form of
// the rate holds for the drive's own n.
TEST(NetRateTest, RescansOfTheTwoScanRuleCostATenth) {
  const DriveParams drive = Mars("traverse_two_scans");
  double scans = 0.0;
  double rescans = 0.0;
  double distance_m = 0.0;
  int undisturbed = 0;
  for (std::uint32_t index = 0; index < 6; ++index) {
    const truth::DriveRecord record = RunTrial(drive, {1, index}).record;
    const double per_step = record.scans / (record.scans - record.rescans);
    const double expected_m_s = ClosedForm(drive, per_step);
    // Five scans that disagree leave a false alarm, whose turn takes a minute more.
    const bool turned = record.turns_in_place > 0.0;
    const double tolerance = turned ? 0.01 : 0.002;
    EXPECT_NEAR(record.net_rate_m_s, expected_m_s, tolerance * expected_m_s);
    EXPECT_NEAR(record.single_scan_rate_m_s, ClosedForm(drive, 1.0), tolerance * expected_m_s);
    undisturbed += !turned;
    scans += record.scans;
    rescans += record.rescans;
    distance_m += record.true_distance_m;
  }
  EXPECT_GE(undisturbed, 2);
  // About 18 % of the steps: 16 % of scans on flat ground show a hazard (src/sensing/README.md),
  // and 0.16 / (1 - 0.16) = 0.19 rescans a step follow. 2600 steps leave a deviation of 0.9 %.
  const double per_step = rescans / (scans - rescans);
  EXPECT_NEAR(per_step, 0.185, 0.035);
  EXPECT_NEAR(distance_m / (6.0 * kFourHours_s), 0.00195, 0.00004);
}

TEST(NetRateTest, FasterSensorsDriveFarther) {
  const DriveResult published = RunTrial(Mars("traverse_single_scan"), {1, 0});
  const DriveParams faster =
      Mars("traverse_single_scan", {"sensors.light_stripe.lasers_per_image=5"});
  const DriveResult result = RunTrial(faster, {1, 0});
  // T = 2 + 18 / 3 = 8 s: 65 mm in 9.7 + 8 s.
  EXPECT_NEAR(result.record.net_rate_m_s, 0.065 / (0.065 / 0.0067 + 8.05), 2e-5);
  EXPECT_GT(result.record.true_distance_m, 1.5 * published.record.true_distance_m);
}

}  // namespace
}  // namespace rockyard::trial

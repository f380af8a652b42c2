#include "trial/clock/ledger.h"

#include <gtest/gtest.h>

#include "trial/eyes/compute_profile.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

Ledger LedgerOf(const DriveParams& drive) {
  return {MakePowerBudget(drive), drive.energy.battery_wh};
}

TEST(PowerBudgetTest, PowersAreThoseOfTable1AndSection6) {
  const PowerBudget budget = MakePowerBudget({});
  EXPECT_DOUBLE_EQ(budget.Power(Activity::kScanning), 7.33);
  EXPECT_DOUBLE_EQ(budget.Power(Activity::kDriving), 3.77 + 0.80 + 8.28);
  EXPECT_DOUBLE_EQ(budget.Power(Activity::kTurning), budget.Power(Activity::kDriving));
  EXPECT_DOUBLE_EQ(budget.Power(Activity::kSteering), 3.77 + 0.80 + 6.70);
}

// 7.33 = 2.01 + 3.77 + 0.75 + 0.80: what a scan saves or costs is its parts' alone.
TEST(PowerBudgetTest, ScanIsTheSumOfItsPublishedParts) {
  const auto scan_W = [](const Overrides& overrides) {
    return MakePowerBudget(Pathfinder("nominal", overrides)).Power(Activity::kScanning);
  };
  constexpr double kLaser_W = 2.01 / 2.0;
  constexpr double kRest_W = 7.33 - 2.01;
  EXPECT_NEAR(scan_W({"sensors.light_stripe.lasers_per_image=1"}), kRest_W + kLaser_W, 1e-12);
  EXPECT_NEAR(scan_W({"sensors.light_stripe.lasers_per_image=5"}), kRest_W + 5 * kLaser_W, 1e-12);
  // There are five lasers, however many may be on at once.
  EXPECT_NEAR(scan_W({"sensors.light_stripe.lasers_per_image=9"}), kRest_W + 5 * kLaser_W, 1e-12);
  // Groups {0, 2, 4} and {1, 3}: never four at once.
  EXPECT_NEAR(scan_W({"sensors.light_stripe.lasers_per_image=4"}), kRest_W + 3 * kLaser_W, 1e-12);
  EXPECT_NEAR(scan_W({"sensors.light_stripe.laser.input_power_w=0.33"}), kRest_W + kLaser_W, 1e-12);
  EXPECT_NEAR(scan_W({"sensors.light_stripe.imager.kind=cmos"}), 7.33 - 0.9 * 0.75, 1e-12);
  // An emitter for each of the four points of two stripes, at a hundredth of the power.
  EXPECT_NEAR(scan_W({"sensors.light_stripe.laser.fan=three_scanlines",
                      "sensors.light_stripe.laser.input_power_w=0.0066"}),
              kRest_W + 8 * 0.01 * kLaser_W, 1e-12);
}

// ceil(n / ceil(n / most)) of n lasers: {0, 2, 4, 6, 8} and {1, 3, 5, 7} of nine at most eight.
TEST(PowerBudgetTest, LasersAtOnceAreTheLargestGroup) {
  const auto of_nine = [](std::int64_t lasers_per_image) {
    sensing::LightStripeParams sensor;
    sensor.stripe_subdivision = 2;
    sensor.lasers_per_image = lasers_per_image;
    return EmittersAtOnce(sensor);
  };
  EXPECT_EQ(of_nine(1), 1);
  EXPECT_EQ(of_nine(4), 3);
  for (const std::int64_t most : {5, 6, 7, 8}) EXPECT_EQ(of_nine(most), 5);
  EXPECT_EQ(of_nine(9), 9);
}

TEST(PowerBudgetTest, AccelerometersWatchMotionAlone) {
  const PowerBudget budget =
      MakePowerBudget(Pathfinder("nominal", {"sensors.vehicle.accelerometers.enabled=true"}));
  EXPECT_NEAR(budget.Power(Activity::kDriving), 3.77 + 0.80 + 0.82 + 8.28, 1e-12);
  EXPECT_NEAR(budget.Power(Activity::kSteering), 3.77 + 0.80 + 0.82 + 6.70, 1e-12);
  EXPECT_DOUBLE_EQ(budget.Power(Activity::kScanning), 7.33);
  const PowerBudget others =
      MakePowerBudget(Pathfinder("nominal", {"sensors.vehicle.contact.enabled=true",
                                             "sensors.vehicle.articulation.enabled=true",
                                             "sensors.vehicle.motor_current.enabled=true"}));
  EXPECT_DOUBLE_EQ(others.Power(Activity::kDriving), 3.77 + 0.80 + 8.28);
}

// T = fixed + (20 - fixed) groups / 3 / speed.
TEST(ScanTimeTest, FollowsLaserGroupsAndSpeed) {
  const auto time_s = [](const Overrides& overrides) {
    const DriveParams drive = Pathfinder("nominal", overrides);
    return ScanTime(drive.clock, drive.sensors.light_stripe);
  };
  EXPECT_DOUBLE_EQ(time_s({}), 20.0);
  EXPECT_DOUBLE_EQ(time_s({"clock.scan_fixed_s=7.3"}), 20.0);  // however it divides
  EXPECT_DOUBLE_EQ(time_s({"sensors.light_stripe.lasers_per_image=5"}), 2.0 + 18.0 / 3.0);
  EXPECT_DOUBLE_EQ(time_s({"sensors.light_stripe.lasers_per_image=1"}), 2.0 + 18.0 * 5.0 / 3.0);
  EXPECT_DOUBLE_EQ(time_s({"clock.scan_speed_factor=10"}), 2.0 + 1.8);
  EXPECT_DOUBLE_EQ(time_s({"clock.scan_fixed_s=20", "clock.scan_speed_factor=10"}), 20.0);
}

TEST(LedgerTest, OneScanTakesThePublishedEnergy) {
  Ledger ledger = LedgerOf({});
  ledger.Spend(Activity::kScanning, 20.0);
  EXPECT_NEAR(ledger.energy_wh() * 3600.0, 146.6, 1e-9);
  EXPECT_DOUBLE_EQ(ledger.time_s(), 20.0);
  EXPECT_DOUBLE_EQ(ledger.time_s(Activity::kScanning), 20.0);
  EXPECT_DOUBLE_EQ(ledger.time_s(Activity::kDriving), 0.0);
}

// Matthies 1995 sec. 6: 6.5 cm of driving at 0.67 cm/s and one 20 s scan give 0.22 cm/s; sec. 8:
// about 30 m in four hours.
TEST(LedgerTest, NetRateOfMfexFollowsFromTheClock) {
  Ledger ledger = LedgerOf({});
  for (int step = 0; step < 100; ++step) {
    ledger.Spend(Activity::kDriving, 0.065 / 0.0067);
    ledger.Spend(Activity::kScanning, 20.0);
  }
  const double rate_m_s = 100 * 0.065 / ledger.time_s();
  EXPECT_NEAR(rate_m_s, 0.0022, 0.00005);
  EXPECT_NEAR(rate_m_s * 4 * 3600.0, 30.0, 2.0);
}

TEST(LedgerTest, AStallTakesExactlyTheRestOfTheBatteries) {
  Ledger ledger(MakePowerBudget({}), 10.0);
  ledger.Spend(Activity::kDriving, 600.0);
  const double before_wh = ledger.energy_wh();
  EXPECT_FALSE(ledger.empty());
  const Stall stall = ledger.StallUntilEmpty();
  EXPECT_EQ(ledger.energy_wh(), before_wh);  // nothing is spent by asking
  EXPECT_EQ(ledger.time_s(), 600.0);
  EXPECT_NEAR(stall.energy_wh, 10.0 - before_wh, 1e-12);
  EXPECT_NEAR(stall.time_s, (10.0 - before_wh) * 3600.0 / (3.77 + 0.80 + 8.28), 1e-9);
  ledger.Spend(Activity::kStalled, stall.time_s);
  EXPECT_NEAR(ledger.energy_wh(), 10.0, 1e-12);
}

TEST(LedgerTest, EmptyBatteriesLeaveNothingToAStall) {
  Ledger ledger(MakePowerBudget({}), 1.0);
  ledger.Spend(Activity::kDriving, 3600.0);
  EXPECT_EQ(ledger.StallUntilEmpty().time_s, 0.0);
  EXPECT_EQ(ledger.StallUntilEmpty().energy_wh, 0.0);
}

TEST(LedgerTest, BatteriesOfNoCapacityAreNeverEmpty) {
  Ledger ledger(MakePowerBudget({}), 0.0);
  EXPECT_FALSE(ledger.empty());
  ledger.Spend(Activity::kDriving, 1e9);
  EXPECT_FALSE(ledger.empty());
  EXPECT_EQ(ledger.StallUntilEmpty().time_s, 0.0);
  EXPECT_EQ(ledger.StallUntilEmpty().energy_wh, 0.0);
}

}  // namespace
}  // namespace rockyard::trial

#include "trial/clock/ledger.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "math/angles.h"
#include "math/sun_position.h"
#include "trial/clock/compute_profile.h"
#include "trial/clock/power.h"
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
    return EmittersAtOnce(
        sensing::LightStripeParams{.lasers_per_image = lasers_per_image, .stripe_subdivision = 2});
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

// The sun's arc in closed form, against sums of small steps and numbers worked out by hand.

constexpr double kSol_s = math::kSolOfMars_s;
constexpr double kHour_s = kSol_s / 24.0;

// Ares Vallis in the season of the landing, from 10 h on.
SolarSupply Ares(double noon_W = 16.0) {
  return {noon_W, math::DegToRad(19.3), math::SunDeclination(math::DegToRad(142.7)), 10.0};
}

// At the equator in spring, from midnight on: S = noon max(0, -cos(2 pi t / sol)).
SolarSupply Equator(double noon_W) { return {noon_W, 0.0, 0.0, 0.0}; }

double SummedUse_J(const SolarSupply& sun, double load_W, double begin_s, double end_s) {
  constexpr int kSteps = 200000;
  const double step_s = (end_s - begin_s) / kSteps;
  double sum_J = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    sum_J += std::min(load_W, sun.Power_W(begin_s + (i + 0.5) * step_s)) * step_s;
  }
  return sum_J;
}

TEST(SolarSupplyTest, PeaksAtNoonAndIsDarkAtNight) {
  EXPECT_NEAR(Ares().Power_W(2.0 * kHour_s), 16.0, 1e-12);
  EXPECT_NEAR(Ares().Power_W(1.0 * kHour_s), Ares().Power_W(3.0 * kHour_s), 1e-12);
  EXPECT_LT(Ares().Power_W(1.0 * kHour_s), 16.0);
  EXPECT_EQ(Ares().Power_W(14.0 * kHour_s), 0.0);
  EXPECT_NEAR(Equator(10.0).Power_W(9.0 * kHour_s), 10.0 * std::cos(0.25 * std::numbers::pi),
              1e-12);
  EXPECT_NEAR(Ares().Power_W(2.0 * kHour_s + 3.0 * kSol_s), 16.0, 1e-9);
}

// The day's energy at the equator: noon times sol / pi.
TEST(SolarSupplyTest, HoldsTheDaysEnergy) {
  EXPECT_NEAR(Equator(10.0).Energy_J(0.0, kSol_s), 10.0 * kSol_s / std::numbers::pi, 1e-6);
  EXPECT_NEAR(Equator(10.0).Energy_J(0.0, 0.25 * kSol_s), 0.0, 1e-6);
  EXPECT_NEAR(Equator(10.0).Energy_J(0.25 * kSol_s, 0.5 * kSol_s),
              0.5 * 10.0 * kSol_s / std::numbers::pi, 1e-6);
}

TEST(SolarSupplyTest, UseIsTheSumOfSmallSteps) {
  for (const double load_W : {0.0, 0.3, 5.0, 13.67, 16.0, 20.0}) {
    for (const double begin_s : {0.0, 3.3 * kHour_s, 9.0 * kHour_s, 23.0 * kHour_s}) {
      for (const double length_s : {20.0, 4.0 * kHour_s, 20.0 * kHour_s, 2.7 * kSol_s}) {
        const double end_s = begin_s + length_s;
        const double used_J = Ares().Used_J(load_W, begin_s, end_s);
        EXPECT_NEAR(used_J, SummedUse_J(Ares(), load_W, begin_s, end_s), 0.02 + 1e-7 * used_J)
            << load_W << " W from " << begin_s << " for " << length_s;
        EXPECT_NEAR(used_J + Ares().Shortfall_J(load_W, begin_s, end_s), load_W * length_s,
                    1e-9 * (1.0 + load_W * length_s));
      }
    }
  }
}

// Not even by a rounding: empty batteries would end a drive by it.
TEST(SolarSupplyTest, NothingLacksWhereTheSunCarriesTheLoad) {
  const double edge_s = Ares().Carries_s(13.67);
  const double first_s = 2.0 * kHour_s - edge_s;
  for (double s = first_s + 1.0; s + 20.0 < 2.0 * kHour_s + edge_s; s += 20.0) {
    EXPECT_EQ(Ares().Shortfall_J(13.67, s, s + 20.0), 0.0) << s;
  }
  EXPECT_GT(Ares().Shortfall_J(13.67, first_s - 20.0, first_s), 0.0);
}

TEST(SolarSupplyTest, IntervalsAddUp) {
  const SolarSupply sun = Ares();
  double sum_J = 0.0;
  for (int i = 0; i < 100; ++i) sum_J += sun.Used_J(7.0, i * 900.0, (i + 1) * 900.0);
  EXPECT_NEAR(sum_J, sun.Used_J(7.0, 0.0, 90000.0), 1e-6);
}

// 16 W at noon carry the 13.67 W of driving with gyro and accelerometers for 4.5 hours, which is
// the paper's day of "approximately four hours per day, centered around noon".
TEST(SolarSupplyTest, CarriesADriveForThePublishedHours) {
  const double both_sides_h = 2.0 * Ares().Carries_s(3.77 + 0.80 + 0.82 + 8.28) / 3600.0;
  EXPECT_GT(both_sides_h, 4.0);
  EXPECT_LT(both_sides_h, 5.0);
  EXPECT_NEAR(Ares().Power_W(2.0 * kHour_s + Ares().Carries_s(13.67)), 13.67, 1e-9);
  EXPECT_EQ(Ares().Carries_s(16.5), 0.0);
  EXPECT_NEAR(Ares(0.0).Carries_s(1.0), 0.0, 1e-12);
  EXPECT_EQ(Ares(0.0).Energy_J(0.0, kSol_s), 0.0);
}

TEST(SunlitLedgerTest, TakesFromTheBatteriesWhatTheSunLacks) {
  const PowerBudget budget{.base_W = 5.0, .driving_W = 10.0, .steering_W = 100.0};
  // The equator at noon: 12 W.
  const SolarSupply sun(12.0, 0.0, 0.0, 12.0);
  Ledger ledger(budget, 1.0, sun);
  ledger.Spend(Activity::kComputing, 600.0);  // 5 W
  EXPECT_EQ(ledger.battery_drawn_wh(), 0.0);
  EXPECT_FALSE(ledger.empty());
  ledger.Spend(Activity::kDriving, 600.0);  // 15 W
  EXPECT_NEAR(ledger.battery_drawn_wh(), sun.Shortfall_J(15.0, 600.0, 1200.0) / 3600.0, 1e-12);
  EXPECT_NEAR(ledger.battery_drawn_wh(), 0.5, 0.01);  // 3 W for ten minutes
  EXPECT_NEAR(ledger.energy_wh(), (5.0 + 15.0) / 6.0, 1e-12);
  EXPECT_FALSE(ledger.empty());
  ledger.Spend(Activity::kSteering, 60.0);  // 105 W
  EXPECT_TRUE(ledger.empty());
}

// Without a sun 0 Wh is no limit, as ever; with one it is an empty battery.
TEST(SunlitLedgerTest, EmptyBatteriesLastAsLongAsTheSunSuffices) {
  const PowerBudget budget{.base_W = 5.0, .driving_W = 10.0};
  Ledger endless(budget, 0.0);
  endless.Spend(Activity::kDriving, 1e6);
  EXPECT_FALSE(endless.empty());
  EXPECT_EQ(endless.battery_drawn_wh(), endless.energy_wh());
  Ledger sunlit(budget, 0.0, SolarSupply(12.0, 0.0, 0.0, 12.0));
  sunlit.Spend(Activity::kComputing, 600.0);
  EXPECT_FALSE(sunlit.empty());
  sunlit.Spend(Activity::kDriving, 0.05);
  EXPECT_TRUE(sunlit.empty());
}

}  // namespace
}  // namespace rockyard::trial

// The sun's arc in closed form, against sums of small steps and numbers worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/angles.h"
#include "math/sun_position.h"
#include "trial/clock/ledger.h"
#include "trial/clock/power.h"

namespace rockyard::trial {
namespace {

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
  const double edge_s = Ares().Carries_s(13.67);
  EXPECT_NEAR(Ares().Power_W(2.0 * kHour_s + edge_s), 13.67, 1e-9);
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

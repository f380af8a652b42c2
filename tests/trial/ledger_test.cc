#include "trial/ledger.h"

#include <gtest/gtest.h>

namespace rockyard::trial {
namespace {

TEST(LedgerTest, PowersAreThoseOfTable1AndSection6) {
  const Ledger ledger{EnergyParams{}};
  EXPECT_DOUBLE_EQ(ledger.Power(Activity::kScanning), 7.33);
  EXPECT_DOUBLE_EQ(ledger.Power(Activity::kDriving), 3.77 + 0.80 + 8.28);
  EXPECT_DOUBLE_EQ(ledger.Power(Activity::kTurning), ledger.Power(Activity::kDriving));
  EXPECT_DOUBLE_EQ(ledger.Power(Activity::kSteering), 3.77 + 0.80 + 6.70);
}

TEST(LedgerTest, OneScanTakesThePublishedEnergy) {
  Ledger ledger{EnergyParams{}};
  ledger.Spend(Activity::kScanning, 20.0);
  EXPECT_NEAR(ledger.energy_wh() * 3600.0, 146.6, 1e-9);
  EXPECT_DOUBLE_EQ(ledger.time_s(), 20.0);
  EXPECT_DOUBLE_EQ(ledger.time_s(Activity::kScanning), 20.0);
  EXPECT_DOUBLE_EQ(ledger.time_s(Activity::kDriving), 0.0);
}

// Matthies 1995 sec. 6: 6.5 cm of driving at 0.67 cm/s and one 20 s scan give 0.22 cm/s; sec. 8:
// about 30 m in four hours.
TEST(LedgerTest, NetRateOfMfexFollowsFromTheClock) {
  Ledger ledger{EnergyParams{}};
  for (int step = 0; step < 100; ++step) {
    ledger.Spend(Activity::kDriving, 0.065 / 0.0067);
    ledger.Spend(Activity::kScanning, 20.0);
  }
  const double rate_m_s = 100 * 0.065 / ledger.time_s();
  EXPECT_NEAR(rate_m_s, 0.0022, 0.00005);
  EXPECT_NEAR(rate_m_s * 4 * 3600.0, 30.0, 2.0);
}

TEST(LedgerTest, StallSpendsExactlyTheRestOfTheBatteries) {
  EnergyParams params;
  params.battery_wh = 10.0;
  Ledger ledger{params};
  ledger.Spend(Activity::kDriving, 600.0);
  const double before_wh = ledger.energy_wh();
  EXPECT_FALSE(ledger.empty());
  ledger.SpendRestStalled();
  EXPECT_NEAR(ledger.energy_wh(), 10.0, 1e-12);
  const double expected_s = (10.0 - before_wh) * 3600.0 / ledger.Power(Activity::kStalled);
  EXPECT_NEAR(ledger.time_s(Activity::kStalled), expected_s, 1e-9);
}

}  // namespace
}  // namespace rockyard::trial

#include <gtest/gtest.h>

#include "localization/aid_fixes.h"

namespace rockyard::localization {
namespace {

// Chi-squared quantiles of 0.999: 10.828, 13.816, 16.266, 18.467, 20.515, 22.458 (tables).
TEST(Gate, LetsInWhatAChiSquaredNumberHardlyExceeds) {
  constexpr double kLimits[] = {10.828, 13.816, 16.266, 18.467, 20.515, 22.458};
  for (int values = 1; values <= 6; ++values) {
    const double limit = kLimits[values - 1];
    EXPECT_EQ(Gate({.chance = 1e-3, .patience = 0}).Ask(limit - 0.001, values), GateAnswer::kIn);
    EXPECT_EQ(Gate({.chance = 1e-3, .patience = 0}).Ask(limit + 0.001, values), GateAnswer::kOut);
  }
}

TEST(Gate, TurnsNothingAwayWithoutChance) {
  EXPECT_EQ(Gate({.chance = 0.0, .patience = 1}).Ask(1e30, 1), GateAnswer::kIn);
}

TEST(Gate, DoubtsItselfAfterAsManyInARow) {
  Gate gate({.chance = 1e-3, .patience = 3});
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kDoubtYourself);
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);  // counted anew
  EXPECT_EQ(gate.Ask(1.0, 2), GateAnswer::kIn);     // no longer in a row
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);
  gate.Restart();
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);
}

TEST(Gate, NeverDoubtsItselfWithoutPatience) {
  Gate gate({.chance = 1e-3, .patience = 0});
  for (int i = 0; i < 20; ++i) EXPECT_EQ(gate.Ask(100.0, 1), GateAnswer::kOut);
}

}  // namespace
}  // namespace rockyard::localization

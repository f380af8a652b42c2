#include "math/angles.h"

#include <gtest/gtest.h>

namespace rockyard::math {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(AnglesTest, DegreesAndRadians) {
  EXPECT_DOUBLE_EQ(DegToRad(180.0), kPi);
  EXPECT_DOUBLE_EQ(DegToRad(-90.0), -kPi / 2.0);
  EXPECT_DOUBLE_EQ(RadToDeg(kPi / 6.0), 30.0);
}

TEST(AnglesTest, WrapKeepsTheDirectionAndTheRange) {
  for (int tenths = -200; tenths <= 200; ++tenths) {
    const double angle = 0.1 * tenths;
    const double wrapped = WrapAngle(angle);
    EXPECT_LE(std::fabs(wrapped), kPi);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-13);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-13);
  }
}

TEST(AnglesTest, WrapLeavesAnglesInRangeAlone) {
  for (const double angle : {-3.1, -1.0, 0.0, 1e-300, 2.5, 3.1}) EXPECT_EQ(WrapAngle(angle), angle);
}

// The short cut for angles in range and its border.
TEST(AnglesTest, WrapIsTheRemainder) {
  for (const double turns : {0.0, 0.2, 0.5, 0.5 + 1e-16, 0.5 + 1e-15, 0.75, 1.0, 1.5, 1e6}) {
    for (const double angle : {2.0 * kPi * turns, -2.0 * kPi * turns}) {
      EXPECT_EQ(WrapAngle(angle), std::remainder(angle, 2.0 * kPi)) << angle;
    }
  }
}

TEST(AnglesTest, WrapTakesTheShortWayRound) {
  EXPECT_NEAR(WrapAngle(DegToRad(350.0) - DegToRad(10.0)), DegToRad(-20.0), 1e-15);
  EXPECT_NEAR(WrapAngle(DegToRad(10.0) - DegToRad(350.0)), DegToRad(20.0), 1e-15);
}

}  // namespace
}  // namespace rockyard::math

#include <gtest/gtest.h>

#include <set>
#include <type_traits>

#include "messages/calibration.h"
#include "messages/commands.h"
#include "messages/estimates.h"

namespace rockyard::messages {
namespace {

TEST(MessagesTest, EveryWheelHasItsOwnIndex) {
  std::set<std::size_t> indices;
  for (const Wheel wheel : {Wheel::kLeftFront, Wheel::kLeftMiddle, Wheel::kLeftRear,
                            Wheel::kRightFront, Wheel::kRightMiddle, Wheel::kRightRear}) {
    EXPECT_LT(Index(wheel), kWheelCount);
    indices.insert(Index(wheel));
  }
  EXPECT_EQ(indices.size(), kWheelCount);
}

TEST(MessagesTest, AReportHasAHazardWhereAnyStripeHas) {
  HazardReport report;
  EXPECT_FALSE(report.any());
  for (std::size_t stripe = 0; stripe < kStripes; ++stripe) {
    report.stripe_hazard = {};
    report.stripe_hazard[stripe] = true;
    EXPECT_TRUE(report.any()) << stripe;
  }
}

TEST(MessagesTest, AScanHasTwentyPointsNoneOfThemDetectedYet) {
  const StripeScan scan;
  int points = 0;
  for (const StripePixel& pixel : scan.pixels.points()) {
    EXPECT_FALSE(pixel.detected);
    ++points;
  }
  EXPECT_EQ(points, 20);
}

TEST(MessagesTest, DefaultsAskForNoMotion) {
  EXPECT_EQ(MotionCommand().kind, MotionKind::kStop);
  for (const double rate : WheelCommand().rate_rad_s) EXPECT_EQ(rate, 0.0);
}

TEST(MessagesTest, MessagesAreValues) {
  EXPECT_TRUE(std::is_copy_assignable_v<StripeScan>);
  EXPECT_TRUE(std::is_copy_assignable_v<StripeCalibration>);
  EXPECT_TRUE(std::is_trivially_copyable_v<MotionMeasurement>);
}

}  // namespace
}  // namespace rockyard::messages

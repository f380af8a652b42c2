// Alarms of slip: what ends a drive, and what a navigator is told.
#include "trial/aids/slip_alarms.h"

#include <gtest/gtest.h>

namespace rockyard::trial {
namespace {

using navigation::SlipResponse;

TEST(SlipAlarmsTest, NothingIsToldWithoutOne) {
  SlipAlarms alarms({SlipResponse::kReplan, 0});
  EXPECT_FALSE(alarms.EndsDrive());
  EXPECT_FALSE(alarms.Take());
}

TEST(SlipAlarmsTest, TheFirstStopsTheDriveByDefault) {
  SlipAlarms alarms({});
  EXPECT_FALSE(alarms.EndsDrive());
  alarms.Raise();
  EXPECT_TRUE(alarms.EndsDrive());
}

TEST(SlipAlarmsTest, EachIsToldOnce) {
  SlipAlarms alarms({SlipResponse::kReplan, 5});
  alarms.Raise();
  const std::optional<ToldSlip> told = alarms.Take();
  ASSERT_TRUE(told && told->hazard);
  EXPECT_EQ(told->hazard->kind, messages::VehicleHazardKind::kSlip);
  EXPECT_EQ(told->hazard->side, messages::HazardSide::kAhead);
  EXPECT_FALSE(told->as_stuck);
  EXPECT_FALSE(alarms.Take());
}

TEST(SlipAlarmsTest, IsToldAsBeingStuck) {
  SlipAlarms alarms({SlipResponse::kAsStuck, 5});
  alarms.Raise();
  const std::optional<ToldSlip> told = alarms.Take();
  ASSERT_TRUE(told);
  EXPECT_TRUE(told->as_stuck);
  EXPECT_FALSE(told->hazard);
}

TEST(SlipAlarmsTest, OneMoreThanTheMostEndsTheDrive) {
  for (const SlipResponse reaction : {SlipResponse::kAsStuck, SlipResponse::kReplan}) {
    SlipAlarms alarms({reaction, 2});
    for (int i = 0; i < 2; ++i) {
      alarms.Raise();
      EXPECT_FALSE(alarms.EndsDrive());
      EXPECT_TRUE(alarms.Take());
    }
    alarms.Raise();
    EXPECT_TRUE(alarms.EndsDrive());
  }
}

// Operators who moved the rover saw to it; it was an alarm all the same.
TEST(SlipAlarmsTest, AMoveByHandDropsWhatIsRaisedAndNotTheCount) {
  SlipAlarms alarms({SlipResponse::kReplan, 1});
  alarms.Raise();
  alarms.OnPlaced();
  EXPECT_FALSE(alarms.Take());
  alarms.Raise();
  EXPECT_TRUE(alarms.EndsDrive());
  alarms.OnPlaced();
  EXPECT_FALSE(alarms.EndsDrive());
}

}  // namespace
}  // namespace rockyard::trial

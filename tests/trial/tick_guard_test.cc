#include "trial/drive/tick_guard.h"

#include <gtest/gtest.h>

namespace rockyard::trial {
namespace {

// How many decisions pass before the guard ends the drive; each takes `step_s`.
std::int64_t Decisions(TickGuard guard, double step_s, std::int64_t most) {
  try {
    for (std::int64_t i = 0; i < most; ++i) guard.Observe(static_cast<double>(i) * step_s);
  } catch (const std::runtime_error&) {
    return -1;
  }
  return most;
}

// A move and a look at every tick, to the time limit and one look beyond it.
TEST(TickGuard, LetsEveryRealDriveEnd) {
  const std::int64_t ticks = 14400 * 20;
  EXPECT_EQ(Decisions({14400.0, 0.05}, 0.025, 2 * ticks + 2), 2 * ticks + 2);
  EXPECT_EQ(Decisions({1.0, 0.05}, 0.001, 1000), 1000);
}

TEST(TickGuard, EndsADriveThatIsNeverJudged) {
  EXPECT_EQ(Decisions({100.0, 0.05}, 0.05, 1'000'000), -1);
}

TEST(TickGuard, EndsDecisionsWithoutTime) {
  EXPECT_EQ(Decisions({14400.0, 0.05}, 0.0, TickGuard::kMaxWithoutTime), 10'000);
  EXPECT_EQ(Decisions({14400.0, 0.05}, 0.0, TickGuard::kMaxWithoutTime + 2), -1);
}

// Without a time limit a drive has as many decisions as two hours of motion and somewhat more.
TEST(TickGuard, EndsADriveWithoutTimeLimitThatGoesOnForEver) {
  EXPECT_EQ(Decisions({0.0, 0.05}, 0.05, 2 * 3600 * 20), 2 * 3600 * 20);
  EXPECT_EQ(Decisions({0.0, 0.05}, 1e5, TickGuard::kUnlimited), TickGuard::kUnlimited);
  EXPECT_EQ(Decisions({0.0, 0.05}, 1e5, TickGuard::kUnlimited + 1), -1);
}

}  // namespace
}  // namespace rockyard::trial

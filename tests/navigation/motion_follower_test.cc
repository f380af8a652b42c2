#include <gtest/gtest.h>

#include <cmath>

#include "navigation/route_follower.h"

namespace rockyard::navigation {
namespace {

using messages::MotionCommand;
using messages::MotionKind;

constexpr double kSpeed_m_s = 0.15;
constexpr double kTick_s = 0.05;

// By the middle of the tick a rover at full speed has driven so far.
constexpr double kHalf_m = 0.5 * kSpeed_m_s * kTick_s;

MotionCommand Clothoid(double curvature_per_m, double rate_per_m2) {
  return {.kind = MotionKind::kArc,
          .curvature_per_m = curvature_per_m,
          .curvature_rate_per_m2 = rate_per_m2};
}

TEST(MotionFollower, CurvatureGrowsWithTheWayDriven) {
  MotionFollower follower(kSpeed_m_s, 0.1);
  const MotionCommand command = Clothoid(-0.5, 2.0);
  const double half_per_m = 2.0 * kHalf_m;
  EXPECT_NEAR(follower.Follow(command, 3.0, kTick_s).curvature_per_m, -0.5 + half_per_m, 1e-12);
  EXPECT_NEAR(follower.Follow(command, 3.2, kTick_s).curvature_per_m, -0.1 + half_per_m, 1e-12);
  EXPECT_NEAR(follower.Follow(command, 3.5, kTick_s).curvature_per_m, 0.5 + half_per_m, 1e-12);
  // Twice the tick, twice the way to its middle; half the speed, half of it.
  EXPECT_NEAR(follower.Follow(command, 3.5, 2.0 * kTick_s).curvature_per_m, 0.5 + 2.0 * half_per_m,
              1e-12);
  MotionCommand slow = command;
  slow.speed_share = 0.5;
  EXPECT_NEAR(follower.Follow(slow, 3.5, kTick_s).curvature_per_m, 0.5 + 0.5 * half_per_m, 1e-12);
}

TEST(MotionFollower, ANewCommandBeginsWhereItIsGiven) {
  MotionFollower follower(kSpeed_m_s, 0.1);
  follower.Follow(Clothoid(0.0, 1.0), 0.0, kTick_s);
  const auto follow = [&](const MotionCommand& command, double odometer_m) {
    return follower.Follow(command, odometer_m, kTick_s).curvature_per_m;
  };
  EXPECT_NEAR(follow(Clothoid(0.2, 1.0), 1.0), 0.2 + kHalf_m, 1e-12);
  EXPECT_NEAR(follow(Clothoid(0.2, 1.0), 1.5), 0.7 + kHalf_m, 1e-12);
  EXPECT_NEAR(follow(Clothoid(0.2, -1.0), 2.0), 0.2 - kHalf_m, 1e-12);
  MotionCommand back = Clothoid(0.2, -1.0);
  back.direction = -1;
  EXPECT_NEAR(follow(back, 2.5), 0.2 - kHalf_m, 1e-12);
  // The same terms once more, as another move.
  back.move = 7;
  EXPECT_NEAR(follow(back, 3.0), 0.2 - kHalf_m, 1e-12);
  EXPECT_NEAR(follow(back, 3.1), 0.1 - kHalf_m, 1e-12);
}

TEST(MotionFollower, AnotherEndOrSpeedLeavesThePathAsItIs) {
  MotionFollower follower(kSpeed_m_s, 0.1);
  MotionCommand command = Clothoid(0.0, 1.0);
  command.end_m = 5.0;
  follower.Follow(command, 1.0, kTick_s);
  command.end_m = 6.0;
  command.speed_share = 0.5;
  EXPECT_NEAR(follower.Follow(command, 1.4, kTick_s).curvature_per_m, 0.4 + 0.5 * kHalf_m, 1e-12);
}

TEST(MotionFollower, LeavesEveryOtherMotionAsItIs) {
  MotionFollower follower(kSpeed_m_s, 0.1);
  const MotionCommand turn{.kind = MotionKind::kTurnInPlace, .direction = -1, .end_m = 0.0};
  EXPECT_EQ(follower.Follow(turn, 9.0, kTick_s), turn);
  EXPECT_EQ(follower.Follow({}, 9.0, kTick_s), MotionCommand{});
  const MotionCommand arc{.kind = MotionKind::kArc, .curvature_per_m = -0.0};
  EXPECT_TRUE(std::signbit(follower.Follow(arc, 9.0, kTick_s).curvature_per_m));
}

// A rover of ideal motors: from speed v it comes to rest within v T / 2.
double RestsAt(double end_m, double ramp_s, double speed_share) {
  MotionFollower follower(kSpeed_m_s, ramp_s);
  const MotionCommand command{.kind = MotionKind::kArc, .speed_share = speed_share, .end_m = end_m};
  const double speed_m_s = speed_share * kSpeed_m_s;
  double odometer_m = 0.0;
  for (int tick = 0; tick < 10000; ++tick) {
    if (follower.Follow(command, odometer_m, kTick_s).kind == MotionKind::kStop) {
      return odometer_m + 0.5 * speed_m_s * ramp_s;
    }
    odometer_m += speed_m_s * kTick_s;
  }
  return HUGE_VAL;
}

TEST(MotionFollower, RestsBeforeTheEndAndNoMoreThanATickBefore) {
  for (const double ramp_s : {0.0, 0.1, 2.0}) {
    for (const double share : {0.25, 1.0}) {
      for (const double end_m : {0.5, 0.513, 1.0}) {
        const double rest_m = RestsAt(end_m, ramp_s, share);
        EXPECT_LE(rest_m, end_m + 1e-12) << ramp_s << " s, " << share;
        EXPECT_GE(rest_m, end_m - share * kSpeed_m_s * kTick_s - 1e-12)
            << ramp_s << " s, " << share;
      }
    }
  }
}

TEST(MotionFollower, DoesNotBeginWhatEndsBeforeItCouldStop) {
  EXPECT_DOUBLE_EQ(RestsAt(0.001, 0.1, 1.0), 0.5 * kSpeed_m_s * 0.1);  // at once
  MotionFollower follower(kSpeed_m_s, 0.1);
  const MotionCommand over{.kind = MotionKind::kArc, .end_m = 1.0};
  EXPECT_EQ(follower.Follow(over, 2.0, kTick_s).kind, MotionKind::kStop);
}

}  // namespace
}  // namespace rockyard::navigation

// A route followed by believed poses.
#include "navigation/route_follower.h"

#include <algorithm>

#include "navigation/fake_rover.h"

namespace rockyard::navigation {
namespace {

using messages::Goal;
using messages::MotionCommand;
using messages::MotionKind;

struct RouteTick {
  math::Pose2 X_WR;
  messages::PoseEstimate estimate;
  NavigatorDecision decision;
};

// The closed loop of a route follower and the fake rover. A pose update may come before any tick.
class RouteDrive final : public LoggedDrive<RouteTick, RouteFollower> {
 public:
  explicit RouteDrive(std::vector<Goal> corners, const FakeRoverConfig& config = {})
      : LoggedDrive({RouteParams{}, {std::move(corners)}}, {config, {}}) {}

  const RouteTick& Step() override { return Step({}); }
  const RouteTick& Step(NavigatorInput felt) {
    felt.estimate = rover_.estimate();
    log_.push_back({rover_.X_WR(), rover_.estimate(), navigator_.Decide(felt)});
    if (log_.back().decision.status == NavigatorStatus::kDriving) {
      rover_.Move(log_.back().decision.motion);
    }
    return log_.back();
  }

  // Least distance of the believed way to a point.
  double NearestBelieved_m(const Goal& corner) const {
    double nearest_m = INFINITY;
    for (const RouteTick& tick : log_) {
      nearest_m = std::min(nearest_m, DistanceToGoal(tick.estimate, corner));
    }
    return nearest_m;
  }
};

const std::vector<Goal> kZigzag{{2.0, 0.0}, {3.0, 1.5}, {5.0, 1.5}, {5.0, -1.0}, {7.6, 0.0}};

TEST(RouteFollowerTest, PassesEveryCornerAndArrivesAtTheLast) {
  RouteDrive drive(kZigzag);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  const double tick_m = FakeRoverConfig{}.tick_distance_m();
  for (const Goal& corner : kZigzag) {
    EXPECT_LE(drive.NearestBelieved_m(corner), RouteParams{}.goal_tolerance_m + tick_m)
        << corner.x_m << ", " << corner.y_m;
  }
  const messages::PoseEstimate& end = drive.log().back().estimate;
  EXPECT_LE(DistanceToGoal(end, kZigzag.back()), RouteParams{}.goal_tolerance_m);
  EXPECT_GT(DistanceToGoal(end, {5.0, -1.0}), 2.0) << "the way would not tell corners apart";
}

// The same decisions with any error of the wheels: corners are where the rover believes them.
TEST(RouteFollowerTest, GoesByTheBelievedPoseAlone) {
  FakeRoverConfig wrong{.gyro_scale = 1.0, .odometer_scale = 1.25};
  RouteDrive drive({{5.0, 0.0}}, wrong);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_NEAR(drive.log().back().estimate.x_m, 4.9, 0.02);
  EXPECT_NEAR(drive.log().back().X_WR.x_m, 4.9 / 1.25, 0.02) << "it stops short and does not know";
}

TEST(RouteFollowerTest, GivesUpAtOnceWithoutARoute) {
  RouteDrive drive({});
  EXPECT_EQ(drive.Step().decision.status, NavigatorStatus::kGaveUp);
}

TEST(RouteFollowerTest, ArrivesAtOnceWhereTheGoalIs) {
  RouteDrive drive({{0.05, 0.05}});
  EXPECT_EQ(drive.Step().decision.status, NavigatorStatus::kArrived);
}

TEST(RouteFollowerTest, NeverLooksAndHeedsNothingThatItFeels) {
  const messages::VehicleHazard hazard{};
  const messages::HazardReport report{.scan_number = 0, .stripe_hazard = kAllHazards};
  RouteDrive deaf(kZigzag);
  RouteDrive plain(kZigzag);
  for (int i = 0; i < 300; ++i) {
    const NavigatorDecision& decision =
        deaf.Step({.estimate = {}, .report = &report, .vehicle_hazard = &hazard}).decision;
    EXPECT_FALSE(decision.looks());
    EXPECT_EQ(decision.motion.kind, plain.Step().decision.motion.kind);
    EXPECT_EQ(decision.motion.curvature_per_m, plain.log().back().decision.motion.curvature_per_m);
  }
}

TEST(RouteFollowerTest, TurnsInPlaceTowardsTheSideOfTheCorner) {
  for (const int side : {+1, -1}) {
    RouteDrive drive({{0.0, 3.0 * side}});
    const NavigatorDecision first = drive.Step().decision;
    EXPECT_EQ(first.motion.kind, MotionKind::kTurnInPlace);
    EXPECT_EQ(first.motion.direction, side);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  }
}

// A corner at distance d and bearing b lies on the arc of curvature 2 sin(b) / d.
TEST(RouteFollowerTest, DrivesTheArcThatLeadsToTheCorner) {
  const double bearing_rad = math::DegToRad(10.0);
  for (const double side : {+1.0, -1.0}) {
    RouteDrive drive({{4.0 * std::cos(bearing_rad), side * 4.0 * std::sin(bearing_rad)}});
    const messages::MotionCommand motion = drive.Step().decision.motion;
    EXPECT_EQ(motion.kind, MotionKind::kArc);
    EXPECT_NEAR(motion.curvature_per_m, side * 2.0 * std::sin(bearing_rad) / 4.0, 1e-12);
  }
  // So near that the arc would be tighter than the rover drives: 0.4 m < 2 (0.75 m) sin(bearing).
  const double near_rad = math::DegToRad(14.9);
  ASSERT_LT(near_rad, RouteParams{}.point_turn_bearing_rad);
  RouteDrive tight({{0.38 * std::cos(near_rad), 0.38 * std::sin(near_rad)}, {3.0, 3.0}});
  EXPECT_EQ(tight.Step().decision.motion.kind, MotionKind::kTurnInPlace);
}

// Told in the middle of a leg that it stands elsewhere, it steers for the same corner from there.
TEST(RouteFollowerTest, SteersAnewAfterAPoseUpdate) {
  RouteDrive drive({{6.0, 0.0}});
  for (int i = 0; i < 20; ++i) drive.Step();
  EXPECT_EQ(drive.log().back().decision.motion.curvature_per_m, 0.0);
  drive.UpdatePose({2.0, 0.6, 0.0});
  const messages::MotionCommand motion = drive.Step().decision.motion;
  EXPECT_EQ(motion.kind, MotionKind::kArc);
  const double distance_m = std::hypot(4.0, 0.6);
  EXPECT_NEAR(motion.curvature_per_m, -2.0 * (0.6 / distance_m) / distance_m, 1e-12);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
}

// Also where a turn was under way: it ends facing the corner, not where it had been going to.
TEST(RouteFollowerTest, EndsATurnByTheNewHeading) {
  RouteDrive drive({{0.0, 4.0}});
  for (int i = 0; i < 10; ++i) drive.Step();
  ASSERT_EQ(drive.log().back().decision.motion.direction, +1);
  drive.UpdatePose({0.0, 0.0, math::DegToRad(150.0)});
  const messages::MotionCommand motion = drive.Step().decision.motion;
  EXPECT_EQ(motion.kind, MotionKind::kTurnInPlace);
  EXPECT_EQ(motion.direction, -1);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
}

// An update beyond a corner: there is nothing to go back for.
TEST(RouteFollowerTest, PassesCornersThatLieBehind) {
  RouteDrive drive({{1.0, 0.0}, {2.0, 0.0}, {6.0, 0.0}});
  drive.Step();
  drive.UpdatePose({3.0, 0.4, 0.0});
  const messages::MotionCommand motion = drive.Step().decision.motion;
  const double distance_m = std::hypot(3.0, 0.4);
  EXPECT_EQ(motion.kind, MotionKind::kArc);
  EXPECT_NEAR(motion.curvature_per_m, -2.0 * (0.4 / distance_m) / distance_m, 1e-12);
}

TEST(RouteFollowerTest, TheNextLegBeginsNearACorner) {
  const double tolerance_m = RouteParams{}.corner_tolerance_m;
  for (const double before_m : {1.2 * tolerance_m, 0.8 * tolerance_m}) {
    RouteDrive drive({{1.0, 0.0}, {1.0, 3.0}});
    drive.Step();
    drive.UpdatePose({1.0 - before_m, 0.0, 0.0});
    EXPECT_EQ(drive.Step().decision.motion.kind,
              before_m < tolerance_m ? MotionKind::kTurnInPlace : MotionKind::kArc);
  }
}

// The gyro is wrong, so that the arc that leads to the goal is another one from every place.
TEST(RouteFollowerTest, SteersAnewOnTheWay) {
  const double bearing_rad = math::DegToRad(14.0);
  RouteDrive drive({{4.0 * std::cos(bearing_rad), 4.0 * std::sin(bearing_rad)}});
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  int changes = 0;
  double steered_at_m = 0.0;
  for (std::size_t i = 1; i < drive.log().size(); ++i) {
    if (drive.log()[i].decision.motion.curvature_per_m ==
        drive.log()[i - 1].decision.motion.curvature_per_m) {
      continue;
    }
    const double at_m = drive.log()[i].estimate.distance_m;
    ++changes;
    EXPECT_GE(at_m - steered_at_m, RouteParams{}.steer_interval_m - 1e-9);
    steered_at_m = at_m;
  }
  EXPECT_GT(changes, 30) << "of 60 steering intervals";
}

TEST(RouteFollowerTest, AGoalThatMovesIsTheEndOfTheRoute) {
  RouteDrive drive({{2.0, 0.0}, {4.0, 0.0}});
  drive.Step();
  drive.SetGoal({4.0, 1.0}, GoalChange::kMoved);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_LE(drive.NearestBelieved_m({2.0, 0.0}), RouteParams{}.corner_tolerance_m);
  EXPECT_LE(drive.NearestBelieved_m({4.0, 1.0}), RouteParams{}.goal_tolerance_m);
  RouteDrive nowhere({});
  nowhere.SetGoal({1.0, 0.0}, GoalChange::kMoved);
  EXPECT_EQ(nowhere.Step().decision.status, NavigatorStatus::kGaveUp);
}

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

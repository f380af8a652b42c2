// The drive cycle of ENav on a rover in the plane, whose looks are points of a height function.
#include <gmock/gmock.h>

#include "navigation/enav/enav.h"
#include "navigation/enav/stance.h"
#include "navigation/gestalt/drive.h"

namespace rockyard::navigation {
namespace {

using math::DegToRad;

struct EnavSetup {
  EnavParams params{};
  messages::Goal goal{12.0, 0.0};
  math::Pose2 start{};
  HeightAt height = Flat();
  int latency_ticks = 0;  // from a look on the move to its answer
  FeltSource felt = Nothing();
  std::function<bool(const FakeRover&)> touches_behind = [](const FakeRover&) { return false; };
};

struct EnavTick {
  math::Pose2 X_WR{};
  messages::PoseEstimate estimate{};
  bool has_cloud = false;
  NavigatorDecision decision{};

  bool Moves(messages::MotionKind kind) const {
    return decision.status == NavigatorStatus::kDriving && !decision.stops_to_look() &&
           decision.motion.kind == kind;
  }
};

FakeRoverConfig PerseveranceRover() {
  return {.tick_s = 0.5,
          .speed_m_s = 0.05,
          .turn_rate_rad_s = 0.05,
          .gyro_scale = 1.0,
          .odometer_scale = 1.0};
}

class EnavDrive final : public LoggedDrive<EnavTick, EnavNavigator> {
 public:
  explicit EnavDrive(const EnavSetup& setup)
      : LoggedDrive({setup.params, setup.goal, PerseveranceLike(), 0.05},
                    {PerseveranceRover(), setup.start}),
        setup_(setup) {}

  const EnavTick& Step() override {
    const auto number = static_cast<int>(log_.size());
    EnavTick tick{.X_WR = rover_.X_WR(), .estimate = rover_.estimate()};
    // Odometry is right, whatever corrects the estimate.
    NavigatorInput input{.time_s = 0.5 * number, .estimate = tick.estimate};
    input.odometry = Odometry();
    if (look_ && number >= ready_) {
      input.cloud = &cloud_;
      input.look = &moment_;
      look_ = false;
      tick.has_cloud = true;
    }
    const auto felt = setup_.felt(rover_);
    if (felt) input.vehicle_hazard = &*felt;
    input.touches_behind = setup_.touches_behind(rover_);
    tick.decision = navigator_.Decide(input);
    if (tick.decision.looks()) {
      Look();
      moment_ = {};
      moment_.odometry = Odometry();
      look_ = true;
      ready_ = number + 1 + (tick.decision.stops_to_look() ? 0 : setup_.latency_ticks);
    }
    if (!tick.decision.stops_to_look()) rover_.Move(tick.decision.motion);
    log_.push_back(tick);
    return log_.back();
  }

 private:
  // Points every 10 cm of what lies up to 9 m ahead, within 60 deg to either side.
  void Look() {
    cloud_.points_R.clear();
    for (int i = 5; i <= 90; ++i) {
      const int most =
          std::min(static_cast<int>(1.73 * i), static_cast<int>(std::sqrt(8100 - i * i)));
      for (int j = -most; j <= most; ++j) {
        const math::Pose2 p = rover_.X_WR() * math::Pose2{0.1 * i, 0.1 * j, 0.0};
        cloud_.points_R.push_back({0.1 * i, 0.1 * j, setup_.height(p.x_m, p.y_m)});
      }
    }
  }
  messages::PoseEstimate Odometry() const {
    const math::Pose2& at = rover_.X_WR();
    return {at.x_m, at.y_m, at.heading_rad, rover_.estimate().distance_m};
  }

  EnavSetup setup_;
  messages::PointCloud cloud_;
  messages::LookMoment moment_;
  bool look_ = false;
  int ready_ = 0;
};

// Motions of a log, each with what was driven or turned, true.
std::vector<std::pair<messages::MotionKind, double>> Motions(const EnavDrive& drive) {
  std::vector<std::pair<messages::MotionKind, double>> motions;
  std::int64_t move = 0;
  const auto& log = drive.log();
  for (std::size_t i = 0; i + 1 < log.size(); ++i) {
    const messages::MotionCommand& motion = log[i].decision.motion;
    if (log[i].decision.stops_to_look() || motion.kind == messages::MotionKind::kStop) continue;
    if (motion.move != move) motions.push_back({motion.kind, 0.0});
    move = motion.move;
    motions.back().second += motion.kind == messages::MotionKind::kArc
                                 ? log[i + 1].estimate.distance_m - log[i].estimate.distance_m
                                 : std::abs(log[i + 1].X_WR.heading_rad - log[i].X_WR.heading_rad);
  }
  return motions;
}

TEST(Enav, ArrivesMetreByMetreAndTurnsByThirtyDegrees) {
  EnavSetup setup;
  setup.goal = {-6.0, 1.0};
  EnavDrive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  int turns = 0, arcs = 0;
  const auto motions = Motions(drive);
  for (std::size_t i = 0; i + 1 < motions.size(); ++i) {
    const auto [kind, way] = motions[i];
    const bool turn = kind == messages::MotionKind::kTurnInPlace;
    turn ? ++turns : ++arcs;
    EXPECT_LT(way, turn ? DegToRad(30.0) + 0.026 : 1.026);
  }
  EXPECT_GE(turns, 2);
  EXPECT_GE(arcs, 6);
  EXPECT_LT(drive.rover().estimate().distance_m, 14.0);  // it sees nothing behind
  EXPECT_TRUE(drive.navigator().plan().found);
  EXPECT_FALSE(drive.navigator().overlay()->lines.empty());
}

// A wall 0.5 m high across the way, with an end: no wheel and no belly on it.
TEST(Enav, GoesAroundAWall) {
  const Block wall{5.0, 5.6, -8.0, 2.0};
  EnavSetup setup;
  setup.height = Blocks({wall});
  EnavDrive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  double most_left_m = 0.0;
  for (const EnavTick& tick : drive.log()) {
    most_left_m = std::max(most_left_m, tick.X_WR.y_m);
    for (const double x : {-1.075, 0.0, 1.185}) {
      for (const double y : {-1.1, 0.0, 1.1}) {
        const math::Pose2 p = tick.X_WR * math::Pose2{x, y, 0.0};
        ASSERT_FALSE(wall.Holds(p.x_m, p.y_m)) << p.x_m << ", " << p.y_m;
      }
    }
  }
  EXPECT_GT(most_left_m, 2.5);
}

TEST(Enav, GivesUpWithinWalls) {
  EnavSetup setup;
  setup.height = Blocks(
      {{4, 4.6, -4.6, 4.6}, {-4.6, -4, -4.6, 4.6}, {-4.6, 4.6, 4, 4.6}, {-4.6, 4.6, -4.6, -4}});
  EnavDrive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
  EXPECT_LT(drive.rover().estimate().distance_m, 20.0);
}

// Nothing passes within the budget: as many looks as it may retry, and a turn between two.
TEST(Enav, RetriesAndGivesUpWhereItsChecksDoNotDo) {
  EnavSetup setup;
  setup.params.drive.max_checks = 10;
  setup.params.drive.max_retries = 3;
  EnavDrive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
  EXPECT_TRUE(drive.navigator().plan().over_budget);
  int looks = 0;
  for (const EnavTick& tick : drive.log()) looks += tick.has_cloud;
  EXPECT_EQ(looks, 4);
  EXPECT_NEAR(std::abs(drive.rover().X_WR().heading_rad), 3 * DegToRad(30.0), 0.08);
  // 12.5 ms a check on 266 million operations a second.
  EXPECT_EQ(drive.log()[1].decision.work_ops, 10 * 12.5e-3 * 266e6);
  EXPECT_EQ(drive.log()[2].decision.work_ops, 0.0);
  EXPECT_THAT(drive.navigator().own_values(), testing::ElementsAre(4.0, 10.0, 4.0, 0.5));
}

// To the goal's side, and as often again for the next goal.
TEST(Enav, RetriesToTheGoalsSideAndAnewForTheNext) {
  for (const double side : {1.0, -1.0}) {
    for (const GoalChange change : {GoalChange::kNext, GoalChange::kMoved}) {
      EnavSetup setup;
      setup.params.drive.max_checks = 10;
      setup.params.drive.max_retries = 3;
      setup.goal = {8.0, 4.0 * side};
      EnavDrive drive(setup);
      drive.StepUntil([&](const EnavTick& tick) { return side * tick.X_WR.heading_rad > 0.6; });
      drive.SetGoal({8.0, 4.0 * side}, change);
      ASSERT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
      const double turns = change == GoalChange::kNext ? 5.0 : 3.0;
      EXPECT_NEAR(side * drive.rover().X_WR().heading_rad, turns * DegToRad(30.0), 0.13);
    }
  }
}

// Hazards count from the last progress, and are avoided no longer than that.
TEST(Enav, ForgetsWhatItFeltAsItGetsOn) {
  EnavSetup setup;
  setup.goal = {14.0, 0.0};
  setup.params.drive.max_felt = 1;
  setup.felt = [first = FeltOnceBeyond(2.5, kTouchAhead),
                second = FeltOnceBeyond(8.0, kTouchAhead)](const FakeRover& rover) mutable {
    const auto felt = first(rover);
    return felt ? felt : second(rover);
  };
  EnavDrive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  const std::size_t there = drive.log().size();
  drive.SetGoal({0.0, 0.0}, GoalChange::kNext);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  double aside_m = 0.0;
  for (std::size_t i = there; i < drive.log().size(); ++i) {
    const math::Pose2& at = drive.log()[i].X_WR;
    if (std::abs(at.x_m - 3.9) < 0.3) aside_m = std::max(aside_m, std::abs(at.y_m));
  }
  EXPECT_LT(aside_m, 1.2);
}

TEST(Enav, PlansOnTheMove) {
  EnavSetup setup;
  setup.params.continuous.cycle = EnavCycle::kCsod;
  setup.latency_ticks = 10;
  EnavDrive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  int stops = 0;
  for (const EnavTick& tick : drive.log()) stops += tick.decision.stops_to_look();
  EXPECT_EQ(stops, 1);
  EXPECT_GE(drive.navigator().plan_counts().started, 10);
  EXPECT_EQ(drive.navigator().plan_counts().late, 0);
  // Answers take longer than a metre: it waits for each.
  setup.latency_ticks = 60;
  EnavDrive slow(setup);
  ASSERT_EQ(slow.Run(), NavigatorStatus::kArrived);
  EXPECT_EQ(slow.navigator().plan_counts().late, slow.navigator().plan_counts().plans);
  EXPECT_GT(slow.log().size(), drive.log().size() + 10 * 15);
}

// What it cannot see it feels: it backs off by what it drove, and leads no path there again.
TEST(Enav, BacksOffFromWhatItFeels) {
  EnavSetup setup;
  setup.felt = FeltOnceBeyond(2.5, kTouchAhead);
  EnavDrive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  double back_m = 0.0, aside_m = 0.0;
  for (const EnavTick& tick : drive.log()) {
    if (tick.Moves(messages::MotionKind::kArc) && tick.decision.motion.direction < 0) {
      back_m += 0.025;
    }
    if (std::abs(tick.X_WR.x_m - 3.9) < 0.3) aside_m = std::max(aside_m, std::abs(tick.X_WR.y_m));
  }
  EXPECT_NEAR(back_m, 0.5, 0.06);
  EXPECT_GT(aside_m, 1.4);
  setup.felt = FeltBeyond(2.5);
  EXPECT_EQ(EnavDrive(setup).Run(), NavigatorStatus::kGaveUp);
}

// The way back ends where something touches its rear, and is none where it does at once. A hazard
// on the left leads it by on the right.
TEST(Enav, BacksOffNoFartherThanItCan) {
  for (const double free_m : {0.2, 0.0}) {
    EnavSetup setup;
    setup.felt = FeltOnceBeyond(2.5, kTouchAhead);
    setup.touches_behind = [=, most_m = 0.0](const FakeRover& rover) mutable {
      most_m = std::max(most_m, rover.X_WR().x_m);
      return most_m >= 2.5 && most_m < 3.0 && rover.X_WR().x_m <= most_m - free_m;
    };
    EnavDrive drive(setup);
    ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
    double back_m = 0.0;
    for (const EnavTick& tick : drive.log()) {
      const bool back =
          tick.Moves(messages::MotionKind::kArc) && tick.decision.motion.direction < 0;
      back_m += back ? 0.025 : 0.0;
    }
    EXPECT_NEAR(back_m, free_m, 0.03);
  }
}

// A correction moves the goal in the frame of odometry and nothing else; operators that move the
// rover make it look again.
TEST(Enav, GoesOnAfterACorrectionAndLooksAfterAMove) {
  EnavDrive drive(EnavSetup{});
  drive.StepUntil([](const EnavTick& tick) { return tick.X_WR.x_m > 3.3; });
  drive.Correct({3.3, -2.0, 0.1, false});
  EXPECT_TRUE(drive.Step().Moves(messages::MotionKind::kArc));
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_GT(drive.rover().X_WR().y_m, 1.0);

  EnavDrive moved(EnavSetup{});
  moved.StepUntil([](const EnavTick& tick) { return tick.X_WR.x_m > 3.3; });
  moved.UpdatePose({3.3, -2.0, 0.1, false});
  EXPECT_TRUE(moved.Step().decision.stops_to_look());
  EXPECT_EQ(moved.Run(), NavigatorStatus::kArrived);
}

TEST(Enav, CountsProgressAnewForTheNextGoal) {
  for (const GoalChange change : {GoalChange::kNext, GoalChange::kMoved}) {
    EnavSetup setup;
    setup.params.drive.max_fruitless_cycles = 15;
    setup.goal = {4.0, 0.0};
    EnavDrive drive(setup);
    ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
    drive.SetGoal({20.0, 0.0}, change);
    EXPECT_EQ(drive.Run(),
              change == GoalChange::kNext ? NavigatorStatus::kArrived : NavigatorStatus::kGaveUp);
  }
}

}  // namespace
}  // namespace rockyard::navigation

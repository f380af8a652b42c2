// Hazards that the rover feels while GESTALT drives blindly.
#include <gtest/gtest.h>

#include <vector>

#include "drive.h"

namespace rockyard::navigation {
namespace {

using messages::HazardSide;
using messages::LookDirection;
using messages::VehicleHazard;
using messages::VehicleHazardKind;

// The rover's front, half its length ahead, touches a block that no camera sees.
FeltSource Unseen(const Block& block) {
  return [block](const FakeRover& rover) -> std::optional<VehicleHazard> {
    const math::Pose2& X_WR = rover.X_WR();
    for (const double y_m : {-0.42, -0.21, 0.0, 0.21, 0.42}) {
      const double c = std::cos(X_WR.heading_rad);
      const double s = std::sin(X_WR.heading_rad);
      if (block.Holds(X_WR.x_m + c * 0.52 - s * y_m, X_WR.y_m + s * 0.52 + c * y_m)) {
        return kTouchAhead;
      }
    }
    return std::nullopt;
  };
}

TEST(GestaltFelt, BacksOffAlongTheArcByWhatWasDriven) {
  GestaltSetup setup;
  setup.goal = {5.0, 0.9};  // on an arc to the left
  setup.felt = FeltBeyond(0.2);
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
  const std::size_t back = drive.log().size() - 1;
  const double driven_m = drive.log()[back].estimate.distance_m;
  EXPECT_GT(drive.log()[back - 1].decision.motion.curvature_per_m, 0.0);
  EXPECT_EQ(drive.log()[back].decision.motion.curvature_per_m,
            drive.log()[back - 1].decision.motion.curvature_per_m);
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.decision.looks(); }));
  const messages::PoseEstimate& end = drive.log().back().estimate;
  ExpectEnds(end.distance_m - driven_m, driven_m, setup.rover.tick_distance_m());
  EXPECT_NEAR(end.x_m, 0.0, 2.0 * setup.rover.tick_distance_m()) << "where it came from";
  EXPECT_NEAR(end.y_m, 0.0, 2.0 * setup.rover.tick_distance_m());
}

TEST(GestaltFelt, BacksOffNoFurtherThanAskedFor) {
  GestaltSetup setup;
  setup.params.drive.back_off_m = 0.10;
  setup.felt = FeltBeyond(0.25);
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
  const double felt_m = drive.log().back().estimate.distance_m;
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.decision.looks(); }));
  EXPECT_NEAR(drive.log().back().estimate.distance_m - felt_m, 0.10,
              setup.rover.tick_distance_m() + kRounding);
}

TEST(GestaltFelt, DrivesRoundWhatItFeltAndDoesNotSee) {
  for (const double y_m : {-0.15, 0.0, 0.2}) {
    GestaltSetup setup = TrueSetup();
    setup.felt = Unseen({2.0, 2.3, y_m - 0.15, y_m + 0.15});
    GestaltDrive drive(setup);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    EXPECT_TRUE(std::any_of(drive.log().begin(), drive.log().end(), [](const GestaltTick& tick) {
      return tick.backs();
    })) << "it did meet the block";
    EXPECT_LT(drive.rover().estimate().distance_m, 15.0);
  }
}

TEST(GestaltFelt, MarksAnObstacleAtTheEndThatLed) {
  const VehicleHazard left{VehicleHazardKind::kArticulation, HazardSide::kLeft};
  const VehicleHazard right{VehicleHazardKind::kArticulation, HazardSide::kRight};
  const VehicleHazard ahead{VehicleHazardKind::kArticulation, HazardSide::kAhead};
  const VehicleHazard slip{VehicleHazardKind::kSlip, HazardSide::kAhead};
  for (const VehicleHazard& hazard : {left, ahead, right, slip}) {
    const HazardSide side = hazard.side;
    GestaltSetup setup = TrueSetup();
    setup.felt = FeltBetween(1.2, 1.25, hazard);
    GestaltDrive drive(setup);
    ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
    ASSERT_TRUE(drive.StepUntil(&GestaltTick::chooses));
    // Half the length ahead of x = 1.2, half the width aside; the ground is flat otherwise.
    const double y_m =
        side == HazardSide::kAhead ? 0.0 : (side == HazardSide::kLeft ? 0.42 : -0.42);
    EXPECT_EQ(GoodnessAt(drive, 1.72, y_m), 0);
    EXPECT_GT(GoodnessAt(drive, 1.72 + 1.2, y_m), 200);
    EXPECT_GT(GoodnessAt(drive, 1.72, side == HazardSide::kLeft ? -0.5 : 0.9), 200)
        << "the other side";
  }
}

// A wall across the whole way that no camera sees.
TEST(GestaltFelt, GivesUpAfterTooManyWithoutProgress) {
  GestaltSetup setup;
  setup.params.drive.max_felt = 3;
  setup.felt = Unseen({1.5, 2.0, -50.0, 50.0});
  GestaltDrive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
  EXPECT_TRUE(setup.felt(drive.rover()).has_value()) << "at the touch after the last allowed one";
  int back_offs = 0;
  for (std::size_t i = 1; i < drive.log().size(); ++i) {
    const bool touched =
        drive.log()[i - 1].drives() && drive.log()[i].drives() &&
        drive.log()[i].decision.motion.direction != drive.log()[i - 1].decision.motion.direction;
    back_offs += touched ? 1 : 0;
  }
  EXPECT_EQ(back_offs, 3);
}

// Slip is seen from images that come now and then: one tick tells of it. What drove backward slips
// behind.
TEST(GestaltFelt, OneTickOfSlipMarksWhereItDrove) {
  GestaltSetup setup = TrueSetup();
  setup.felt = FeltOnceBeyond(1.2, {VehicleHazardKind::kSlip, HazardSide::kAhead});
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
  const double felt_m = drive.log().back().estimate.distance_m;
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.decision.looks(); }));
  EXPECT_GT(drive.log().back().estimate.distance_m - felt_m, 0.1) << "it backed off";
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  double aside_m = 0.0;
  for (const GestaltTick& tick : drive.log()) {
    if (std::abs(tick.estimate.x_m - 1.72) > 0.2) continue;
    aside_m = std::max(aside_m, std::abs(tick.estimate.y_m));
  }
  EXPECT_GT(aside_m, 0.3) << "it went round the place";
}

TEST(GestaltFelt, AHazardThatLastsCountsAgainOnlyAfterSomeDriving) {
  GestaltSetup setup;
  setup.params.drive.felt_again_m = 0.2;
  setup.felt = FeltBeyond(-100.0, {VehicleHazardKind::kTilt, HazardSide::kAhead});
  GestaltDrive drive(setup);  // stands tilted from the start
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
  EXPECT_NEAR(drive.log().back().estimate.distance_m, 0.2,
              setup.rover.tick_distance_m() + kRounding);
}

TEST(GestaltFelt, ATouchBehindEndsABackOffAndNothingElse) {
  GestaltSetup setup = TrueSetup();
  setup.felt = FeltBeyond(0.3);
  setup.touches_behind = [](const FakeRover& rover) { return rover.X_WR().x_m < 0.28; };
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
  const double felt_m = drive.log().back().estimate.distance_m;
  EXPECT_GT(felt_m, 0.3) << "driving forward it does not matter";
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.decision.looks(); }));
  // From 0.30 to 0.28, a tick late at either end.
  EXPECT_NEAR(drive.log().back().estimate.distance_m - felt_m, 0.02,
              2.0 * setup.rover.tick_distance_m() + kRounding);
}

TEST(GestaltFelt, TouchedAtBothEndsDoesNotBackOff) {
  GestaltSetup setup{.felt = FeltBeyond(0.2),
                     .touches_behind = [](const FakeRover&) { return true; }};
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil([&setup](const GestaltTick& t) { return t.X_WR.x_m > 0.2; }));
  EXPECT_TRUE(drive.log().back().looks(LookDirection::kAhead));
}

TEST(GestaltFelt, DuringASearchTurnsTheOtherWay) {
  GestaltSetup setup;
  setup.range.range_m = 0.2;  // sees nothing: it turns in place to search
  setup.goal = {4.0, 1.0};
  setup.felt = [](const FakeRover& rover) -> std::optional<VehicleHazard> {
    if (rover.X_WR().heading_rad > 0.5) return kTouchAhead;
    return std::nullopt;
  };
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.turns(); }));
  EXPECT_EQ(drive.log().back().decision.motion.direction, +1);
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.decision.looks(); }));
  EXPECT_NEAR(drive.rover().X_WR().heading_rad, 0.5, 0.03);
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.turns(); }));
  EXPECT_EQ(drive.log().back().decision.motion.direction, -1);
}

// Something that no camera sees and that marks too little to block the way stands ahead. The arc
// that met it is not taken again from there; without the veto it is.
TEST(GestaltFelt, TheArcOnWhichItFeltIsNotChosenAgainFromThere) {
  for (const bool veto : {true, false}) {
    GestaltSetup setup = TrueSetup();
    setup.params.drive.veto_felt = veto;
    setup.params.drive.max_felt = 3;
    // The mark lies nearer than paths are judged from.
    setup.params.plan.plan_min_dist_m = 1.5;
    setup.felt = [](const FakeRover& rover) -> std::optional<VehicleHazard> {
      const math::Pose2& X_WR = rover.X_WR();
      if (X_WR.x_m > 0.2 && std::abs(X_WR.y_m) < 1e-6) return kTouchAhead;
      return std::nullopt;
    };
    GestaltDrive drive(setup);
    std::vector<double> forward_per_m;
    EXPECT_EQ(drive.Run(), veto ? NavigatorStatus::kArrived : NavigatorStatus::kGaveUp);
    for (std::size_t i = 1; i < drive.log().size(); ++i) {
      const GestaltTick& tick = drive.log()[i];
      if (tick.has_cloud && tick.drives() && tick.decision.motion.direction > 0) {
        forward_per_m.push_back(tick.decision.motion.curvature_per_m);
      }
    }
    ASSERT_GE(forward_per_m.size(), 3U);
    EXPECT_EQ(forward_per_m[0], 0.0);
    EXPECT_EQ(forward_per_m[1] != 0.0, veto);
  }
}

// What GESTALT feels while it drives backward, and what becomes of it when its estimate is moved.

constexpr VehicleHazard kTiltLeft{VehicleHazardKind::kTilt, HazardSide::kLeft};
constexpr double kHalfLength_m = 0.52;
constexpr double kHalfWidth_m = 0.42;

// A touch ahead for a tick, as soon as each of these distances is measured; counts them.
FeltSource FeltOnceAfter(const std::vector<double>& driven_m, int& count) {
  return [driven_m, &count](const FakeRover& rover) -> std::optional<VehicleHazard> {
    const auto next = static_cast<std::size_t>(count);
    if (next >= driven_m.size() || rover.estimate().distance_m < driven_m[next]) {
      return std::nullopt;
    }
    ++count;
    return kTouchAhead;
  };
}

// A goal straight behind, to which the rover drives backward on flat ground that it has seen.
GestaltSetup Backward() {
  GestaltSetup setup = TrueSetup();
  setup.goal = {-6.0, 0.0};
  setup.params.drive.backward_arcs = BackwardArcs::kAlways;
  setup.params.votes.min_fwd_threshold = 256.0;  // looks both ways, always
  return setup;
}

bool DrivesForward(const GestaltTick& t) { return t.drives() && t.decision.motion.direction > 0; }
bool Looks(const GestaltTick& t) { return t.decision.looks(); }

TEST(GestaltBackward, ATouchBehindIsMarkedBehindAndBackedOffFromForward) {
  GestaltSetup setup = Backward();
  setup.touches_behind = [](const FakeRover& rover) {
    return rover.X_WR().x_m < -0.2 && rover.X_WR().x_m > -0.25;
  };
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
  ASSERT_TRUE(drive.StepUntil(DrivesForward));
  const double felt_m = drive.rover().estimate().distance_m;
  EXPECT_NEAR(drive.log().back().X_WR.x_m, -0.2, setup.rover.tick_distance_m() + kRounding);
  ASSERT_TRUE(drive.StepUntil(Looks));
  EXPECT_NEAR(drive.rover().X_WR().x_m, 0.0, 2.0 * setup.rover.tick_distance_m() + kRounding)
      << "where it came from";
  EXPECT_GT(drive.rover().estimate().distance_m, felt_m + 0.19);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::chooses));
  EXPECT_EQ(GoodnessAt(drive, -0.2 - kHalfLength_m, 0.0), 0);
  EXPECT_GT(GoodnessAt(drive, -0.2 + kHalfLength_m + 0.3, 0.0), 200);
}

TEST(GestaltBackward, ATiltIsMarkedAtTheEndThatLed) {
  GestaltSetup setup = Backward();
  setup.felt = FeltBetween(-0.25, -0.2, kTiltLeft);
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
  ASSERT_TRUE(drive.StepUntil(DrivesForward));
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::chooses));
  EXPECT_EQ(GoodnessAt(drive, -0.2 - kHalfLength_m, kHalfWidth_m), 0);
  EXPECT_GT(GoodnessAt(drive, -0.2 - kHalfLength_m, -kHalfWidth_m - 0.3), 200);
  EXPECT_GT(GoodnessAt(drive, -0.2 + kHalfLength_m + 0.3, kHalfWidth_m), 200);
}

// Its front swings out, or it stands at a rock: the front is no place to back off to.
TEST(GestaltBackward, ATouchAheadIsMarkedAheadAndNotDrivenInto) {
  GestaltSetup setup = Backward();
  setup.felt = FeltBetween(-0.25, -0.2, kTouchAhead);
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
  ASSERT_TRUE(drive.StepUntil(Looks));
  EXPECT_NEAR(drive.log().back().X_WR.x_m, -0.2, setup.rover.tick_distance_m() + kRounding);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::chooses));
  EXPECT_EQ(GoodnessAt(drive, -0.2 + kHalfLength_m, 0.0), 0);
  EXPECT_GT(GoodnessAt(drive, -0.2 - kHalfLength_m - 0.3, 0.0), 200);
}

TEST(GestaltBackward, ATouchAheadEndsABackOffForward) {
  GestaltSetup setup = Backward();
  const auto touch = FeltBetween(-0.1, 1.0, kTouchAhead);
  const auto tilt = FeltBetween(-0.25, -0.2, kTiltLeft);
  setup.felt = [=](const FakeRover& rover) {
    // On the way there the front is free.
    const bool back = rover.estimate().distance_m > 0.2;
    return back && touch(rover) ? touch(rover) : tilt(rover);
  };
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(DrivesForward));
  ASSERT_TRUE(drive.StepUntil(Looks));
  EXPECT_NEAR(drive.rover().X_WR().x_m, -0.1, setup.rover.tick_distance_m() + kRounding);
}

// The arena turns the estimate about during a back-off: no camera sees what was felt, so the place
// has to move with the rover, to a far window too.
TEST(GestaltMovedEstimate, WhatWasFeltStaysWhereTheRoverFeltIt) {
  for (const math::Pose2& to : {math::Pose2{1.2, 0.0, 0.0}, math::Pose2{40.0, -30.0, 2.0}}) {
    GestaltSetup setup = TrueSetup();
    setup.felt = FeltBetween(1.2, 1.3, kTouchAhead);
    GestaltDrive drive(setup);
    ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
    const double ahead_m = 1.2 + kHalfLength_m - drive.rover().X_WR().x_m;
    drive.UpdatePose({to.x_m, to.y_m, to.heading_rad});
    ASSERT_TRUE(drive.StepUntil(&GestaltTick::chooses));
    const auto goodness = [&](double further_m) {
      const double x_m = ahead_m + further_m;
      return GoodnessAt(drive, to.x_m + x_m * std::cos(to.heading_rad),
                        to.y_m + x_m * std::sin(to.heading_rad));
    };
    EXPECT_EQ(goodness(0.0), 0);
    EXPECT_GT(goodness(1.2), 200);
  }
}

TEST(GestaltMovedEstimate, WhatWasFeltBeforeTheLastProgressIsForgotten) {
  GestaltSetup setup = TrueSetup();
  setup.goal = {8.0, 0.0};
  int felt = 0;
  setup.felt = FeltOnceAfter({2.1}, felt);
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.X_WR.x_m > 5.0; }));
  const math::Pose2& at = drive.rover().X_WR();
  drive.UpdatePose({at.x_m, at.y_m, at.heading_rad});
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::chooses));
  for (const auto& cell : drive.navigator().view()->map.cells) ASSERT_GT(cell.goodness, 0);
}

// Two hazards with progress between them, where one in a row is allowed.
TEST(GestaltMovedEstimate, ProgressForgivesWhatWasFelt) {
  GestaltSetup setup = TrueSetup();
  setup.goal = {10.0, 0.0};
  setup.params.drive.max_felt = 1;
  int felt = 0;
  setup.felt = FeltOnceAfter({2.1, 6.0}, felt);
  GestaltDrive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_EQ(felt, 2);
  EXPECT_GT(std::count_if(drive.log().begin(), drive.log().end(), std::mem_fn(&GestaltTick::backs)),
            0);
}

// Walls 0.5 rad to either side, felt until 0.4 rad, stop each turn: half a radian, then one each.
// What was turned counts in the search, and a wall that is felt when a turn begins does not stop
// it.
TEST(GestaltMovedEstimate, TurnsThatAreStoppedCountInASearch) {
  GestaltSetup setup = TrueSetup();
  setup.range.range_m = 0.2;
  setup.goal = {4.0, 1.0};
  setup.params.drive.max_felt = 1000;
  bool touches = false;
  setup.felt = [&touches](const FakeRover& rover) -> std::optional<VehicleHazard> {
    touches = std::abs(rover.X_WR().heading_rad) > (touches ? 0.4 : 0.5);
    if (touches) return kTouchAhead;
    return std::nullopt;
  };
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::drives));
  // 0.5 + 6 x 1 > 2 pi with a tick's turn at either end of each.
  EXPECT_EQ(Stretches(drive.log(), std::mem_fn(&GestaltTick::turns)), 7);
}

}  // namespace
}  // namespace rockyard::navigation

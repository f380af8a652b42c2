// What GESTALT feels while it drives backward, and what becomes of it when its estimate is moved.
#include <gtest/gtest.h>

#include <algorithm>

#include "drive.h"

namespace rockyard::navigation {
namespace {

using messages::HazardSide;
using messages::VehicleHazard;
using messages::VehicleHazardKind;

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

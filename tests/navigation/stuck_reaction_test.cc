// What a rover does that notices that it is stuck, whichever navigator it has.
#include "navigation/stuck_reaction.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace rockyard::navigation {
namespace {

using messages::MotionKind;

constexpr double kTick_m = 0.01;

// Tells what it is told to tell, and remembers what it was asked.
class ScriptedNavigator final : public Navigator {
 public:
  NavigatorDecision Decide(const NavigatorInput& input) override {
    odometers_m.push_back(input.estimate.distance_m);
    return decision;
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate& after) override {
    updated_x_m = after.x_m;
  }
  void SetGoal(const messages::Goal& goal, GoalChange change) override {
    goal_x_m = goal.x_m;
    goal_change = change;
  }
  const messages::NavigationView* view() const override { return &kept_view; }

  NavigatorDecision decision{NavigatorStatus::kDriving, {}, {MotionKind::kArc, 0.5, +1}};
  std::vector<double> odometers_m;  // at each question
  double updated_x_m = 0.0;
  double goal_x_m = 0.0;
  GoalChange goal_change = GoalChange::kNext;
  messages::NavigationView kept_view;
};

class StuckReactionTest : public testing::Test {
 protected:
  void Make(StuckResponse response) {
    auto scripted = std::make_unique<ScriptedNavigator>();
    inner_ = scripted.get();
    reaction_ = std::make_unique<StuckReaction>(
        StuckReactionParams{.reaction = response, .back_off_m = 0.2}, std::move(scripted));
  }

  // One tick; whatever is told is driven.
  NavigatorDecision Tick(bool stuck = false) {
    input_.notices_stuck = stuck;
    const NavigatorDecision decision = reaction_->Decide(input_);
    if (decision.motion.kind == MotionKind::kArc) input_.estimate.distance_m += kTick_m;
    return decision;
  }

  // The ticks for which the rover is told to drive the other way.
  int BackOff(NavigatorDecision decision) {
    int ticks = 0;
    for (const int direction = decision.motion.direction; decision.motion.direction == direction;
         decision = Tick()) {
      if (++ticks > 1000) break;
    }
    return ticks;
  }

  ScriptedNavigator* inner_ = nullptr;
  std::unique_ptr<StuckReaction> reaction_;
  NavigatorInput input_;
};

TEST_F(StuckReactionTest, LeavesARoverThatGetsOnToItsNavigator) {
  for (const StuckResponse response : {StuckResponse::kGiveUp, StuckResponse::kBackOff}) {
    Make(response);
    EXPECT_EQ(Tick().motion.curvature_per_m, 0.5);
    inner_->decision = {NavigatorStatus::kDriving, messages::LookDirection::kAhead, {}};
    EXPECT_TRUE(Tick().looks());
    inner_->decision = {NavigatorStatus::kArrived, {}, {}};
    EXPECT_EQ(Tick().status, NavigatorStatus::kArrived);
    EXPECT_EQ(inner_->odometers_m.size(), 3U);
    EXPECT_EQ(reaction_->view(), &inner_->kept_view);
    reaction_->OnPoseUpdate({}, {.x_m = 3.0});
    EXPECT_EQ(inner_->updated_x_m, 3.0);
    reaction_->SetGoal({.x_m = 5.0}, GoalChange::kMoved);
    EXPECT_EQ(inner_->goal_x_m, 5.0);
    EXPECT_EQ(inner_->goal_change, GoalChange::kMoved);
  }
}

TEST_F(StuckReactionTest, GivesUpWhereItIsToldTo) {
  Make(StuckResponse::kGiveUp);
  EXPECT_EQ(Tick().status, NavigatorStatus::kDriving);
  EXPECT_EQ(Tick(true).status, NavigatorStatus::kStuck);
  EXPECT_EQ(inner_->odometers_m.size(), 1U);
}

TEST_F(StuckReactionTest, BacksOffAlongItsLastArcThenGivesUp) {
  Make(StuckResponse::kBackOff);
  Tick();
  inner_->decision.motion = {MotionKind::kTurnInPlace, 0.0, +1};  // jams in a turn after the arc
  Tick();
  const NavigatorDecision back = Tick(true);
  EXPECT_EQ(back.status, NavigatorStatus::kDriving);
  EXPECT_EQ(back.motion.kind, MotionKind::kArc);
  EXPECT_EQ(back.motion.curvature_per_m, 0.5);
  EXPECT_EQ(back.motion.direction, -1);
  EXPECT_NEAR(BackOff(back) * kTick_m, 0.2, kTick_m);
  // Its navigator was not asked meanwhile, and is now.
  EXPECT_EQ(inner_->odometers_m.size(), 3U);
  EXPECT_EQ(Tick().motion.kind, MotionKind::kTurnInPlace);
  EXPECT_EQ(Tick(true).status, NavigatorStatus::kStuck);
}

TEST_F(StuckReactionTest, DrivesForwardWhereItCameBackward) {
  Make(StuckResponse::kBackOff);
  inner_->decision.motion = {MotionKind::kArc, -1.0, -1};
  Tick();
  const NavigatorDecision back = Tick(true);
  EXPECT_EQ(back.motion.curvature_per_m, -1.0);
  EXPECT_EQ(back.motion.direction, +1);
}

TEST_F(StuckReactionTest, NoticesThatItIsStuckWhileItBacksOff) {
  Make(StuckResponse::kBackOff);
  Tick();
  Tick(true);
  EXPECT_EQ(Tick().motion.direction, -1);
  EXPECT_EQ(Tick(true).status, NavigatorStatus::kStuck);
}

TEST_F(StuckReactionTest, ATouchAtTheEndThatLeadsEndsIt) {
  Make(StuckResponse::kBackOff);
  Tick();
  EXPECT_EQ(Tick(true).motion.direction, -1);
  input_.touches_behind = true;
  EXPECT_EQ(Tick().motion.direction, +1);

  Make(StuckResponse::kBackOff);
  input_ = {};
  inner_->decision.motion.direction = -1;
  Tick();
  EXPECT_EQ(Tick(true).motion.direction, +1);
  input_.touches_behind = true;  // that is where it came from
  EXPECT_EQ(Tick().motion.direction, +1);
  const messages::VehicleHazard tilt{messages::VehicleHazardKind::kTilt};
  input_.vehicle_hazard = &tilt;
  EXPECT_EQ(Tick().motion.direction, +1);
  const messages::VehicleHazard touch{messages::VehicleHazardKind::kContact};
  input_.vehicle_hazard = &touch;
  EXPECT_EQ(Tick().motion.direction, -1);
}

}  // namespace
}  // namespace rockyard::navigation

// A navigator that is led from waypoint to waypoint.
#include "navigation/waypoint_sequence.h"

#include <gmock/gmock.h>

#include <cmath>
#include <utility>

#include "navigation/stuck_reaction.h"

namespace rockyard::navigation {
namespace {

using messages::Goal;
using testing::ElementsAre;

constexpr double kTolerance_m = 0.1;

// Drives along x, arrives near its goal, and remembers what it was told and asked.
class FakeNavigator final : public Navigator {
 public:
  explicit FakeNavigator(const Goal& first) : goal(first) {}

  NavigatorDecision Decide(const NavigatorInput& input) override {
    inputs.push_back(input);
    if (said != NavigatorStatus::kDriving) return {said, {}, {}};
    if (std::abs(input.estimate.x_m - goal.x_m) <= kTolerance_m) {
      return {NavigatorStatus::kArrived, {}, {}};
    }
    if (looks) return {NavigatorStatus::kDriving, messages::LookDirection::kBehind, {}};
    return {NavigatorStatus::kDriving, {}, {messages::MotionKind::kArc, 0.25, +1}};
  }
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override {
    jump_m = after.x_m - before.x_m;
  }
  void SetGoal(const Goal& next, GoalChange change) override {
    goal = next;
    told_x_m.push_back(next.x_m);
    changes.push_back(change);
  }
  const messages::NavigationView* view() const override { return &kept_view; }

  Goal goal;
  std::vector<double> told_x_m;
  std::vector<GoalChange> changes;
  std::vector<NavigatorInput> inputs;
  NavigatorStatus said = NavigatorStatus::kDriving;
  bool looks = false;
  double jump_m = 0.0;
  messages::NavigationView kept_view;
};

class WaypointSequenceTest : public testing::Test {
 protected:
  void Make(const std::vector<Goal>& goals, std::optional<double> pass_within_m = {}) {
    auto fake = std::make_unique<FakeNavigator>(goals.front());
    inner_ = fake.get();
    sequence_ = std::make_unique<WaypointSequence>(goals, std::move(fake), pass_within_m);
  }

  // How many waypoints are reached there.
  std::size_t ReachedAt(double x_m, double y_m) {
    sequence_->Decide({.estimate = {.x_m = x_m, .y_m = y_m}});
    return sequence_->reached();
  }

  NavigatorDecision At(double x_m) { return sequence_->Decide({.estimate = {.x_m = x_m}}); }

  FakeNavigator* inner_ = nullptr;
  std::unique_ptr<WaypointSequence> sequence_;
};

TEST_F(WaypointSequenceTest, LeadsToEveryWaypointInOrderAndToldOnce) {
  Make({{1.0, 0.0}, {2.0, 0.0}, {1.5, 0.0}, {4.0, 0.0}});
  std::vector<double> arrivals_m;
  for (int step = 0; step <= 400; ++step) {
    // To the farthest waypoint but one, back, and on.
    const double way_m = 0.01 * step;
    const double x_m = way_m <= 2.0 ? way_m : (way_m <= 2.5 ? 4.0 - way_m : way_m - 1.0);
    const std::size_t before = sequence_->reached();
    const NavigatorDecision decision = At(x_m);
    EXPECT_EQ(decision.status, NavigatorStatus::kDriving);
    EXPECT_EQ(decision.motion.curvature_per_m, 0.25) << "no tick without a motion";
    if (sequence_->reached() != before) arrivals_m.push_back(x_m);
  }
  ASSERT_EQ(arrivals_m.size(), 3U);
  EXPECT_NEAR(arrivals_m[0], 0.9, 0.011);
  EXPECT_NEAR(arrivals_m[1], 1.9, 0.011);
  EXPECT_NEAR(arrivals_m[2], 1.6, 0.011);
  EXPECT_THAT(inner_->told_x_m, ElementsAre(2.0, 1.5, 4.0));
  EXPECT_THAT(inner_->changes,
              ElementsAre(GoalChange::kNext, GoalChange::kNext, GoalChange::kNext));
  EXPECT_EQ(At(3.95).status, NavigatorStatus::kArrived);
  EXPECT_EQ(sequence_->reached(), 3U) << "the goal is no waypoint";
  EXPECT_EQ(inner_->told_x_m.size(), 3U);
}

TEST_F(WaypointSequenceTest, AlonePassesEverythingThrough) {
  Make({{1.0, 0.0}});
  EXPECT_TRUE(sequence_->IsOnLastLeg());
  EXPECT_EQ(At(0.0).motion.curvature_per_m, 0.25);
  EXPECT_EQ(At(0.95).status, NavigatorStatus::kArrived);
  EXPECT_EQ(inner_->inputs.size(), 2U);
  EXPECT_TRUE(inner_->told_x_m.empty());
  EXPECT_EQ(sequence_->reached(), 0U);
}

TEST_F(WaypointSequenceTest, PassesOnWhatIsNoArrival) {
  Make({{1.0, 0.0}, {2.0, 0.0}});
  inner_->looks = true;
  ASSERT_TRUE(At(0.0).looks());
  EXPECT_EQ(At(0.0).look, messages::LookDirection::kBehind);
  for (const NavigatorStatus status : {NavigatorStatus::kGaveUp, NavigatorStatus::kStuck}) {
    inner_->said = status;
    EXPECT_EQ(At(0.5).status, status);
    EXPECT_EQ(At(1.0).status, status);
  }
  EXPECT_EQ(sequence_->reached(), 0U);
  EXPECT_TRUE(inner_->told_x_m.empty());
  sequence_->OnPoseUpdate({.x_m = 1.0}, {.x_m = 3.5});
  EXPECT_EQ(inner_->jump_m, 2.5);
  EXPECT_EQ(sequence_->view(), &inner_->kept_view);
}

// Waypoints nearer to each other than the navigator's tolerance are reached at one tick.
TEST_F(WaypointSequenceTest, GoesOnFromSeveralAtOnce) {
  Make({{1.0, 0.0}, {1.05, 0.0}, {1.02, 0.0}});
  EXPECT_EQ(At(1.0).status, NavigatorStatus::kArrived);
  EXPECT_EQ(sequence_->reached(), 2U);
  EXPECT_EQ(inner_->inputs.size(), 3U);
}

TEST_F(WaypointSequenceTest, KeepsAMovedGoalForTheLastLeg) {
  Make({{1.0, 0.0}, {2.0, 0.0}});
  EXPECT_FALSE(sequence_->IsOnLastLeg());
  EXPECT_EQ(sequence_->goal().x_m, 1.0);
  sequence_->SetGoal({3.0, 0.0}, GoalChange::kMoved);
  EXPECT_TRUE(inner_->told_x_m.empty());
  EXPECT_EQ(sequence_->last_goal().x_m, 3.0);
  At(1.0);
  EXPECT_TRUE(sequence_->IsOnLastLeg());
  sequence_->SetGoal({3.2, 0.0}, GoalChange::kMoved);
  EXPECT_THAT(inner_->told_x_m, ElementsAre(3.0, 3.2));
  EXPECT_THAT(inner_->changes, ElementsAre(GoalChange::kNext, GoalChange::kMoved));
  EXPECT_EQ(sequence_->goal().x_m, 3.2);
}

// A rover that cannot back off any further asks its navigator at once; that this was at a waypoint
// makes it no second time of being stuck.
TEST_F(WaypointSequenceTest, BeingStuckAtAWaypointIsNoticedOnce) {
  const std::vector<Goal> goals{{1.0, 0.0}, {2.0, 0.0}};
  WaypointSequence sequence(
      goals, std::make_unique<StuckReaction>(
                 StuckReactionParams{.reaction = StuckResponse::kBackOff, .back_off_m = 0.2},
                 std::make_unique<FakeNavigator>(goals.front())));
  NavigatorInput input{.estimate = {.x_m = 1.0}};
  input.touches_behind = true;
  input.notices_stuck = true;
  EXPECT_EQ(sequence.Decide(input).status, NavigatorStatus::kDriving);
  EXPECT_EQ(sequence.reached(), 1U);
  EXPECT_EQ(sequence.Decide(input).status, NavigatorStatus::kStuck) << "the next tick";
}

NavigatorInput InputAt(double x_m, double y_m) { return {.estimate = {.x_m = x_m, .y_m = y_m}}; }

// Within 0.5 m the next is told, before the navigator is asked, and once.
TEST_F(WaypointSequenceTest, ABendIsPassedFromAsFarAsItIsTold) {
  Make({{2.0, 0.0}, {4.0, 0.0}}, 0.5);
  At(1.49);
  EXPECT_EQ(sequence_->reached(), 0U);
  EXPECT_TRUE(inner_->told_x_m.empty());
  At(1.51);
  EXPECT_EQ(sequence_->reached(), 1U);
  EXPECT_THAT(inner_->told_x_m, ElementsAre(4.0));
  EXPECT_THAT(inner_->changes, ElementsAre(GoalChange::kNext));
  EXPECT_EQ(inner_->inputs.size(), 2U);
  At(1.52);
  EXPECT_EQ(inner_->told_x_m.size(), 1U);
}

// Beside it at y = 1.4 m, beyond the line through it across the leg: nothing to go back for.
TEST_F(WaypointSequenceTest, ABendThatLiesBehindIsPassed) {
  Make({{2.0, 0.0}, {2.0, 3.0}, {6.0, 3.0}}, 0.5);
  sequence_->Decide(InputAt(0.0, 0.0));
  EXPECT_EQ(ReachedAt(1.85, 1.4), 0U);
  EXPECT_EQ(ReachedAt(2.15, 1.4), 1U);
  // The second leg begins at the first waypoint and leads along y.
  EXPECT_EQ(ReachedAt(3.0, 2.9), 1U);
  EXPECT_EQ(ReachedAt(3.0, 3.1), 2U);
  EXPECT_TRUE(sequence_->IsOnLastLeg());
}

// Legs are counted from where the rover begins, and from waypoints that it arrives at itself.
TEST_F(WaypointSequenceTest, LegsBeginWhereTheOneBeforeEnded) {
  Make({{2.0, 0.0}, {0.0, 0.0}, {6.0, 0.0}}, 0.05);
  sequence_->Decide(InputAt(3.0, 1.0));  // the first leg leads to (2, 0) from there
  EXPECT_EQ(ReachedAt(2.5, 0.6), 0U);
  EXPECT_EQ(ReachedAt(1.92, 0.1), 1U);  // the navigator's own arrival, or beyond
  EXPECT_EQ(ReachedAt(1.0, 0.3), 1U);
  EXPECT_EQ(ReachedAt(-0.01, 0.3), 2U);
}

// At (2, 0) the navigator itself arrives. From there to (5, 5) the way leads along (3, 5), and
// (-1, 0.8) from that place is beyond it; along (5, 5), from the start, it would not be.
TEST_F(WaypointSequenceTest, ALegAfterAnArrivalBeginsThere) {
  Make({{2.0, 0.0}, {5.0, 5.0}, {9.0, 9.0}}, 0.01);
  sequence_->Decide(InputAt(0.0, 0.0));
  EXPECT_EQ(ReachedAt(1.95, 0.0), 1U);
  EXPECT_EQ(ReachedAt(4.0, 5.8), 2U);
}

TEST_F(WaypointSequenceTest, BendsCloseTogetherArePassedAtOnceAndTheLastGoalNever) {
  Make({{1.0, 0.0}, {1.2, 0.0}, {1.4, 0.0}}, 0.5);
  const NavigatorDecision decision = At(0.9);
  EXPECT_EQ(sequence_->reached(), 2U);
  EXPECT_THAT(inner_->told_x_m, ElementsAre(1.4));
  EXPECT_EQ(decision.status, NavigatorStatus::kDriving);
  EXPECT_EQ(At(1.35).status, NavigatorStatus::kArrived);
  EXPECT_EQ(sequence_->reached(), 2U);
}

// Places that somebody named are arrived at.
TEST_F(WaypointSequenceTest, WithoutADistanceNothingIsPassed) {
  Make({{2.0, 0.0}, {4.0, 0.0}});
  At(0.0);
  At(1.8);
  At(2.5);
  EXPECT_EQ(sequence_->reached(), 0U);
}

// On the first of three legs: what was left is left out, and the new goal is the last.
TEST_F(WaypointSequenceTest, ANewLastGoalLeavesOutTheRest) {
  Make({{1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}});
  At(0.5);
  sequence_->DriveTo({0.7, 0.2});
  EXPECT_TRUE(sequence_->IsOnLastLeg());
  EXPECT_EQ(sequence_->goal().x_m, 0.7);
  EXPECT_EQ(sequence_->last_goal().y_m, 0.2);
  EXPECT_THAT(inner_->told_x_m, ElementsAre(0.7));
  EXPECT_THAT(inner_->changes, ElementsAre(GoalChange::kMoved));
  EXPECT_EQ(At(0.7).status, NavigatorStatus::kArrived);
  EXPECT_EQ(sequence_->reached(), 0U);
}

}  // namespace
}  // namespace rockyard::navigation

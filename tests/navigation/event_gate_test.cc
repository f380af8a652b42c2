// When a navigator is asked, and what goes on between two questions; alone, and in the wrappers of
// a drive.
#include "navigation/event_gate.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "fake_rover.h"
#include "navigation/stuck_reaction.h"
#include "navigation/waypoint_sequence.h"

namespace rockyard::navigation {
namespace {

using messages::MotionKind;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kTick_s = 0.05;
constexpr std::array<const char*, 13> kNames{
    "tick",        "start",      "look", "manoeuvre", "period",       "near_goal", "end_of_plan",
    "pose_update", "correction", "goal", "hazard",    "touch_behind", "stuck"};

// "start hazard", in the order of the bits.
std::string Text(const Events& events) {
  std::string text;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if ((events.bits() >> i & 1u) == 0) continue;
    text += (text.empty() ? "" : " ") + std::string(kNames[i]);
  }
  return text;
}

Events Of(Event event) {
  Events events;
  events.Add(event);
  return events;
}

// Decides what it is told to decide, and notes what it is asked and told.
class Asked final : public Navigator {
 public:
  NavigatorDecision Decide(const NavigatorInput& input) override {
    questions.push_back(Text(input.events));
    last = input;
    if (!script.empty()) {
      decision = script.front();
      script.erase(script.begin());
    }
    return decision;
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate& after) override {
    told.push_back("pose_update " + std::to_string(after.heading_rad));
  }
  void OnCorrection(const messages::PoseEstimate&, const messages::PoseEstimate& after) override {
    told.push_back("correction " + std::to_string(after.heading_rad));
  }
  void SetGoal(const messages::Goal& goal, GoalChange change) override {
    told.push_back((change == GoalChange::kMoved ? "moved " : "next ") + std::to_string(goal.x_m));
  }
  const messages::NavigationView* view() const override { return &kept_view; }
  PlanCounts plan_counts() const override { return {.plans = 3}; }
  const messages::Overlay* overlay() const override { return &kept_overlay; }
  std::span<const double> own_values() const override { return kept_values; }

  NavigatorDecision decision = Move({MotionKind::kArc, 0.5, +1}, AtEvents());
  std::vector<NavigatorDecision> script;  // decided one after the other, before `decision` stays
  std::vector<std::string> questions;
  std::vector<std::string> told;
  NavigatorInput last;
  messages::NavigationView kept_view;
  messages::Overlay kept_overlay;
  std::array<double, 2> kept_values{1.0, 2.0};
};

class EventGateTest : public testing::Test {
 protected:
  EventGateTest() : gate_(Make()) {}

  std::unique_ptr<EventGate> Make() {
    auto asked = std::make_unique<Asked>();
    inner_ = asked.get();
    return std::make_unique<EventGate>(std::move(asked), messages::Goal{10.0, 0.0});
  }

  // One tick; `events` are those of wrappers.
  NavigatorDecision Tick(const Events& events = {}) {
    input_.events = events;
    const NavigatorDecision decision = gate_->Decide(input_);
    input_.time_s += kTick_s;
    return decision;
  }
  void Ticks(int count) {
    for (int i = 0; i < count; ++i) Tick();
  }
  // What was asked since the last call.
  std::vector<std::string> Questions() { return std::exchange(inner_->questions, {}); }
  // What is asked at the next tick.
  std::vector<std::string> At(const Events& events = {}) {
    Tick(events);
    return Questions();
  }
  // Asks the first question, which is answered with this rule.
  void Begin(const Until& until) {
    inner_->decision.until = until;
    Tick();
    Questions();
  }

  // Turns the rover and ticks. Returns what was asked.
  std::vector<std::string> TurnBy(double turn_rad) {
    input_.estimate.heading_rad = math::WrapAngle(input_.estimate.heading_rad + turn_rad);
    return At();
  }
  std::vector<std::string> RollBy(double way_m) {
    input_.estimate.distance_m += way_m;
    return At();
  }
  std::vector<std::string> StandAt(double x_m) {
    input_.estimate.x_m = x_m;
    return At();
  }
  // The estimate jumps, and the gate is told.
  void Jump(double x_m, double turn_rad, bool corrected) {
    const messages::PoseEstimate before = input_.estimate;
    input_.estimate.x_m += x_m;
    input_.estimate.heading_rad = math::WrapAngle(before.heading_rad + turn_rad);
    if (corrected) {
      gate_->OnCorrection(before, input_.estimate);
    } else {
      gate_->OnPoseUpdate(before, input_.estimate);
    }
  }

  Asked* inner_ = nullptr;
  std::unique_ptr<EventGate> gate_;
  NavigatorInput input_;
};

Until With(double Until::*member, double value) {
  Until until = AtEvents();
  until.*member = value;
  return until;
}

TEST_F(EventGateTest, TheFirstQuestionIsTheStartAndThenNothingHappens) {
  EXPECT_THAT(At(), ElementsAre("start"));
  for (int i = 0; i < 1000; ++i) {
    const NavigatorDecision decision = Tick();
    EXPECT_EQ(decision.status, NavigatorStatus::kDriving);
    EXPECT_EQ(decision.motion, inner_->decision.motion);
  }
  EXPECT_THAT(Questions(), IsEmpty());
}

// As rockyard's own navigators do.
TEST_F(EventGateTest, WhoSaysNothingIsAskedAtEveryTick) {
  inner_->decision.until = {};
  Ticks(4);
  EXPECT_THAT(Questions(), ElementsAre("start", "tick", "tick", "tick"));
  input_.touches_behind = true;
  EXPECT_THAT(At(), ElementsAre("touch_behind"));
  EXPECT_THAT(At(), ElementsAre("tick"));
}

// What is asked passes on all that is known, whatever the question before was.
TEST_F(EventGateTest, TheQuestionHoldsTheWholeInput) {
  const messages::HazardReport report;
  const messages::PointCloud cloud;
  const messages::LookMoment look;
  const messages::VehicleHazard hazard;
  const messages::PoseCovariance covariance = messages::PoseCovariance::Zero();
  const messages::VehicleState felt;
  input_ = {.time_s = 7.0,
            .events = {},
            .estimate = {1.0, 2.0, 0.5, 3.0},
            .attitude = {0.1, 0.2, 0.3},
            .odometry = {4.0, 5.0, 0.25, 6.0},
            .report = &report,
            .cloud = &cloud,
            .look = &look,
            .vehicle_hazard = &hazard,
            .touches_behind = true,
            .notices_stuck = true,
            .covariance = &covariance,
            .felt = &felt};
  Tick();
  const NavigatorInput& asked = inner_->last;
  EXPECT_EQ(asked.time_s, 7.0);
  EXPECT_EQ(asked.estimate.distance_m, 3.0);
  EXPECT_EQ(asked.attitude.pitch_rad, 0.2);
  EXPECT_EQ(asked.odometry.y_m, 5.0);
  EXPECT_EQ(asked.report, &report);
  EXPECT_EQ(asked.cloud, &cloud);
  EXPECT_EQ(asked.look, &look);
  EXPECT_EQ(asked.vehicle_hazard, &hazard);
  EXPECT_TRUE(asked.touches_behind && asked.notices_stuck);
  EXPECT_EQ(asked.covariance, &covariance);
  EXPECT_EQ(asked.felt, &felt);
}

// Steps are powers of two, so that sums are exact; odometers of estimators may count either way.
TEST_F(EventGateTest, ADistanceEndsAManoeuvreWhicheverWayTheOdometerRuns) {
  for (const double way_m : {0.0625, -0.0625}) {
    SCOPED_TRACE(way_m);
    gate_ = Make();
    Begin(With(&Until::distance_m, 0.125));
    EXPECT_THAT(RollBy(way_m), IsEmpty());
    EXPECT_THAT(RollBy(way_m), ElementsAre("manoeuvre"));
    // It is measured from the last decision, not from the start.
    EXPECT_THAT(RollBy(way_m), IsEmpty());
    EXPECT_THAT(RollBy(way_m), ElementsAre("manoeuvre"));
    EXPECT_THAT(TurnBy(3.0), IsEmpty());
  }
}

TEST_F(EventGateTest, ATurnEndsAManoeuvreEitherWay) {
  for (const double turn_rad : {0.25, -0.25}) {
    SCOPED_TRACE(turn_rad);
    gate_ = Make();
    Begin(With(&Until::turn_rad, 0.5));
    EXPECT_THAT(TurnBy(turn_rad), IsEmpty());
    EXPECT_THAT(TurnBy(turn_rad), ElementsAre("manoeuvre"));
    EXPECT_THAT(TurnBy(turn_rad), IsEmpty());
    EXPECT_THAT(TurnBy(turn_rad), ElementsAre("manoeuvre"));
    EXPECT_THAT(RollBy(100.0), IsEmpty());
  }
}

TEST_F(EventGateTest, ATurnBackIsNoTurn) {
  Begin(With(&Until::turn_rad, 0.5));
  for (int i = 0; i < 20; ++i) EXPECT_THAT(TurnBy(i % 2 == 0 ? 0.4 : -0.4), IsEmpty()) << i;
}

// Headings are wrapped, or count on beyond half a turn: messages leave it open.
TEST_F(EventGateTest, ATurnGoesOnAcrossHalfATurn) {
  for (const double side : {+1.0, -1.0}) {
    for (const double whole_turn_rad : {0.0, 2.0 * std::numbers::pi}) {
      SCOPED_TRACE(testing::Message() << side << " " << whole_turn_rad);
      gate_ = Make();
      input_.estimate.heading_rad = side * (std::numbers::pi - 0.125);
      Begin(With(&Until::turn_rad, 0.5));
      input_.estimate.heading_rad = side * (std::numbers::pi + 0.125 - whole_turn_rad);
      EXPECT_THAT(At(), IsEmpty());
      input_.estimate.heading_rad = side * (std::numbers::pi + 0.376 - whole_turn_rad);
      EXPECT_THAT(At(), ElementsAre("manoeuvre"));
    }
  }
}

// Of a turn of 4 rad the heading at its end tells only that it is 2.28 rad the other way.
TEST_F(EventGateTest, ATurnMayBeMoreThanHalfATurn) {
  Begin(With(&Until::turn_rad, 4.0));
  for (int i = 1; i < 16; ++i) EXPECT_THAT(TurnBy(0.25), IsEmpty()) << i;
  EXPECT_THAT(TurnBy(0.251), ElementsAre("manoeuvre"));
}

// Ticks of 1/20 s do not add up exactly, whether they are added or counted.
TEST_F(EventGateTest, APeriodIsOverAtItsTick) {
  int rounded_down = 0;
  for (const bool added : {false, true}) {
    for (const int ticks : {2, 3, 6, 7, 20, 21}) {
      SCOPED_TRACE(testing::Message() << ticks << " ticks, added: " << added);
      gate_ = Make();
      input_ = {};
      const double period_s = ticks * kTick_s;
      Begin(With(&Until::period_s, period_s));
      double asked_s = 0.0;
      for (int i = 1; i <= 40 * ticks; ++i) {
        if (!added) input_.time_s = i * kTick_s;
        const double now_s = input_.time_s;
        ASSERT_THAT(
            At(), i % ticks == 0 ? std::vector<std::string>{"period"} : std::vector<std::string>{});
        if (i % ticks != 0) continue;
        rounded_down += now_s - asked_s < period_s ? 1 : 0;
        asked_s = now_s;
      }
    }
  }
  // The control: without an allowance for rounding some of these would come a tick late.
  EXPECT_GT(rounded_down, 10);
}

TEST_F(EventGateTest, APeriodBetweenTwoTicksIsOverAtTheSecond) {
  Begin(With(&Until::period_s, 0.12));
  EXPECT_THAT(At(), IsEmpty());
  EXPECT_THAT(At(), IsEmpty());
  EXPECT_THAT(At(), ElementsAre("period"));
}

TEST_F(EventGateTest, TheGoalComesNearOnceWheneverItDoes) {
  Begin(With(&Until::near_goal_m, 2.0));
  EXPECT_THAT(StandAt(7.75), IsEmpty());
  EXPECT_THAT(StandAt(8.0), ElementsAre("near_goal"));
  EXPECT_THAT(StandAt(8.5), IsEmpty());
  EXPECT_THAT(StandAt(7.0), IsEmpty());
  EXPECT_THAT(StandAt(9.0), ElementsAre("near_goal"));
}

// A navigator that decides where it is near already has seen that.
TEST_F(EventGateTest, ARuleThatBeginsNearTheGoalTellsNothing) {
  input_.estimate.x_m = 9.0;
  Begin(With(&Until::near_goal_m, 2.0));
  Ticks(3);
  EXPECT_THAT(Questions(), IsEmpty());
}

TEST_F(EventGateTest, ThingsThatComeTogetherAreToldTogether) {
  Begin({.period_s = 0.05, .distance_m = 1.0, .turn_rad = 1.0, .near_goal_m = 2.0});
  input_.estimate = {9.0, 0.0, 2.0, 1.5};
  input_.touches_behind = true;
  gate_->SetGoal({10.0, 0.5}, GoalChange::kMoved);
  EXPECT_THAT(At(Of(Event::kEndOfPlan)),
              ElementsAre("manoeuvre period near_goal end_of_plan goal touch_behind"));
}

class Jumps : public EventGateTest, public testing::WithParamInterface<bool> {
 protected:
  std::string Name() const { return GetParam() ? "correction" : "pose_update"; }
};

INSTANTIATE_TEST_SUITE_P(Kinds, Jumps, testing::Bool(),
                         [](const auto& jump) { return jump.param ? "Correction" : "PoseUpdate"; });

// The rover did not turn, though its heading did.
TEST_P(Jumps, OfTheEstimateAreToldAndAreNoManoeuvre) {
  for (const double turn_rad : {3.0, -3.0, 0.7}) {
    SCOPED_TRACE(turn_rad);
    gate_ = Make();
    input_ = {};
    Begin(With(&Until::turn_rad, 0.5));
    Jump(-5.0, turn_rad, GetParam());
    EXPECT_THAT(inner_->told, ElementsAre(Name() + " " + std::to_string(turn_rad)));
    EXPECT_THAT(At(), ElementsAre(Name()));
    EXPECT_THAT(At(), IsEmpty());
    // Turns count from the new heading on.
    EXPECT_THAT(TurnBy(0.25), IsEmpty());
    EXPECT_THAT(TurnBy(0.25), ElementsAre("manoeuvre"));
  }
}

// What it truly turned before the jump and at its tick counts.
TEST_P(Jumps, LeaveTheTurnOfTheRoverAsItIs) {
  Begin(With(&Until::turn_rad, 0.5));
  EXPECT_THAT(TurnBy(0.25), IsEmpty());
  Jump(0.0, -2.0, GetParam());
  EXPECT_THAT(TurnBy(0.25), ElementsAre("manoeuvre " + Name()));
}

TEST_P(Jumps, MayShowTheGoalNear) {
  Begin(With(&Until::near_goal_m, 2.0));
  Jump(9.0, 0.0, GetParam());
  EXPECT_THAT(At(), ElementsAre("near_goal " + Name()));
}

TEST_P(Jumps, BeforeTheFirstQuestionAreToldWithIt) {
  Jump(1.0, 1.0, GetParam());
  EXPECT_THAT(At(), ElementsAre("start " + Name()));
}

TEST_F(EventGateTest, AnotherGoalIsToldAtTheNextTickOnce) {
  Begin(With(&Until::near_goal_m, 2.0));
  gate_->SetGoal({20.0, 0.0}, GoalChange::kNext);
  gate_->SetGoal({30.0, 0.0}, GoalChange::kMoved);
  EXPECT_THAT(inner_->told, ElementsAre("next 20.000000", "moved 30.000000"));
  EXPECT_THAT(Questions(), IsEmpty());
  EXPECT_THAT(At(), ElementsAre("goal"));
  // It is the last of them that comes near.
  EXPECT_THAT(StandAt(9.0), IsEmpty());
  EXPECT_THAT(StandAt(19.0), IsEmpty());
  EXPECT_THAT(StandAt(29.0), ElementsAre("near_goal"));
}

TEST_F(EventGateTest, AHazardIsToldWhereItAppearsChangesAndGoes) {
  using messages::HazardSide;
  using messages::VehicleHazardKind;
  Begin(AtEvents());
  messages::VehicleHazard hazard{VehicleHazardKind::kContact, HazardSide::kAhead};
  input_.vehicle_hazard = &hazard;
  EXPECT_THAT(At(), ElementsAre("hazard"));
  EXPECT_THAT(At(), IsEmpty());
  hazard.kind = VehicleHazardKind::kTilt;
  EXPECT_THAT(At(), ElementsAre("hazard"));
  hazard.side = HazardSide::kLeft;
  EXPECT_THAT(At(), ElementsAre("hazard"));
  // Another message of the same hazard is none.
  const messages::VehicleHazard same = hazard;
  input_.vehicle_hazard = &same;
  EXPECT_THAT(At(), IsEmpty());
  input_.vehicle_hazard = nullptr;
  EXPECT_THAT(At(), ElementsAre("hazard"));
  EXPECT_THAT(At(), IsEmpty());
}

TEST_F(EventGateTest, ATouchBehindIsToldWhereItAppearsAndGoes) {
  Begin(AtEvents());
  input_.touches_behind = true;
  EXPECT_THAT(At(), ElementsAre("touch_behind"));
  EXPECT_THAT(At(), IsEmpty());
  input_.touches_behind = false;
  EXPECT_THAT(At(), ElementsAre("touch_behind"));
  EXPECT_THAT(At(), IsEmpty());
}

TEST_F(EventGateTest, BeingStuckIsToldAsLongAsItIsNoticed) {
  Begin(AtEvents());
  input_.notices_stuck = true;
  EXPECT_THAT(At(), ElementsAre("stuck"));
  EXPECT_THAT(At(), ElementsAre("stuck"));
  input_.notices_stuck = false;
  EXPECT_THAT(At(), IsEmpty());
}

// Of wrappers, and of what follows the motion.
TEST_F(EventGateTest, EventsOfOthersPassThrough) {
  Begin(AtEvents());
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    EXPECT_THAT(At(Events(1u << i)), ElementsAre(kNames[i]));
    EXPECT_THAT(At(), IsEmpty());
  }
}

TEST_F(EventGateTest, AStopToLookIsAskedForUntilItIsAnswered) {
  inner_->decision = LookAt(messages::LookDirection::kBehind);
  inner_->decision.until = AtEvents();
  EXPECT_TRUE(Tick().stops_to_look());
  EXPECT_TRUE(Tick().stops_to_look());
  EXPECT_THAT(Questions(), ElementsAre("start", "tick"));
  const messages::LookMoment look;
  input_.look = &look;
  inner_->decision = Move({MotionKind::kArc, 0.25, +1}, AtEvents());
  EXPECT_EQ(Tick().motion.curvature_per_m, 0.25);
  input_.look = nullptr;
  EXPECT_EQ(Tick().motion.curvature_per_m, 0.25);
  EXPECT_THAT(Questions(), ElementsAre("look"));
}

// Another look would be taken at each tick.
TEST_F(EventGateTest, ALookOnTheMoveIsNotAskedForTwice) {
  inner_->decision.look = messages::LookDirection::kAhead;
  inner_->decision.looks_on_the_move = true;
  const NavigatorDecision first = Tick();
  EXPECT_TRUE(first.looks());
  EXPECT_TRUE(first.looks_on_the_move);
  Questions();
  for (int i = 0; i < 5; ++i) {
    const NavigatorDecision next = Tick();
    EXPECT_FALSE(next.looks());
    EXPECT_EQ(next.motion, first.motion);
  }
  EXPECT_THAT(Questions(), IsEmpty());
  const messages::LookMoment look;
  input_.look = &look;
  EXPECT_THAT(At(), ElementsAre("look"));
}

TEST_F(EventGateTest, OperationsOfADecisionAreSpentOnce) {
  inner_->decision.work_ops = 5e6;
  EXPECT_EQ(Tick().work_ops, 5e6);
  EXPECT_EQ(Tick().work_ops, 0.0);
  EXPECT_EQ(Tick(Of(Event::kHazard)).work_ops, 5e6);
}

TEST_F(EventGateTest, WhatANavigatorShowsAndCountsPassesThrough) {
  EXPECT_EQ(gate_->view(), &inner_->kept_view);
  EXPECT_EQ(gate_->overlay(), &inner_->kept_overlay);
  EXPECT_EQ(gate_->plan_counts().plans, 3);
  EXPECT_THAT(gate_->own_values(), ElementsAre(1.0, 2.0));
  inner_->decision = Finish(NavigatorStatus::kGaveUp);
  EXPECT_EQ(Tick().status, NavigatorStatus::kGaveUp);
}

// Two behaviour controllers on one rover: the one in a gate decides the same at every tick.
TEST_F(EventGateTest, ANavigatorThatAsksForEveryTickDecidesAsWithoutAGate) {
  const messages::Goal goal{7.6, 0.0};
  PathfinderNavigator bare({}, goal, true);
  EventGate gated(std::make_unique<PathfinderNavigator>(PathfinderParams{}, goal, true), goal);
  FakeRover rover({}, {});
  messages::HazardReport report;
  int looks = 0;
  bool seen = false;
  for (int i = 0; i < 400; ++i) {
    report.stripe_hazard = looks % 3 == 2 ? kLeftHazard : kClear;
    input_ = {.time_s = i * kTick_s, .estimate = rover.estimate()};
    if (seen) input_.report = &report;
    const NavigatorDecision a = bare.Decide(input_);
    const NavigatorDecision b = gated.Decide(input_);
    ASSERT_EQ(a.motion, b.motion) << i;
    ASSERT_EQ(a.look, b.look) << i;
    ASSERT_EQ(a.status, b.status) << i;
    seen = a.looks();
    looks += seen ? 1 : 0;
    if (!seen) rover.Move(a.motion);
  }
  EXPECT_GT(looks, 5);
  EXPECT_GT(rover.estimate().distance_m, 0.5);
}

// The reaction backs off by itself. What the navigator wanted to be asked for is over then.
TEST_F(EventGateTest, AfterBackingOffItIsAskedAsStuck) {
  Asked* asked = inner_;
  StuckReaction reaction({.reaction = StuckResponse::kBackOff, .back_off_m = 0.2},
                         std::move(gate_));
  const auto tick = [&](bool stuck) {
    input_.notices_stuck = stuck;
    const NavigatorDecision decision = reaction.Decide(input_);
    input_.estimate.distance_m += 0.0625;
    return decision;
  };
  EXPECT_EQ(tick(false).motion.direction, +1);
  EXPECT_EQ(tick(true).motion.direction, -1);
  int backwards = 1;
  while (tick(false).motion.direction < 0 && backwards < 100) ++backwards;
  EXPECT_EQ(backwards, 4);
  EXPECT_THAT(asked->questions, ElementsAre("start", "stuck"));
  tick(false);
  EXPECT_EQ(asked->questions.size(), 2U);
}

// No tick is lost between two goals, however seldom the navigator wants to be asked.
TEST_F(EventGateTest, AtAWaypointItIsAskedAtOnceForTheNextGoal) {
  Asked* asked = inner_;
  const NavigatorDecision drive = Move({MotionKind::kArc, 0.5, +1}, With(&Until::near_goal_m, 1.0));
  const NavigatorDecision on = Move({MotionKind::kArc, -0.5, +1}, With(&Until::near_goal_m, 1.0));
  asked->script = {drive, Finish(NavigatorStatus::kArrived), on, Finish(NavigatorStatus::kArrived)};
  WaypointSequence sequence({{10.0, 0.0}, {20.0, 0.0}}, std::move(gate_));
  const auto at = [&](double x_m) {
    input_.estimate.x_m = x_m;
    return sequence.Decide(input_);
  };
  EXPECT_EQ(at(0.0).motion, drive.motion);
  EXPECT_EQ(at(5.0).motion, drive.motion);
  const NavigatorDecision second = at(9.5);
  EXPECT_EQ(second.motion, on.motion);
  EXPECT_EQ(second.status, NavigatorStatus::kDriving);
  EXPECT_THAT(asked->questions, ElementsAre("start", "near_goal", "goal"));
  EXPECT_THAT(asked->told, ElementsAre("next 20.000000"));
  EXPECT_EQ(at(15.0).motion, on.motion);
  EXPECT_EQ(at(19.5).status, NavigatorStatus::kArrived);
  EXPECT_THAT(asked->questions, ElementsAre("start", "near_goal", "goal", "near_goal"));
}

}  // namespace
}  // namespace rockyard::navigation

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"
#include "navigation/pathfinder/pathfinder_params.h"
#include "navigation/stuck_reaction.h"

namespace rockyard::navigation {
namespace {

using core::Assumed;
using messages::MotionKind;
using testing::ElementsAre;
using testing::HasSubstr;

struct ToyParams {
  double patience_s = 5.0;
  double tolerance_m = 0.2;

  void Visit(core::FieldVisitor& v) {
    v.Real("patience_s", patience_s, Assumed("until it gives up", {}, {0, 10}));
    v.Real("tolerance_m", tolerance_m, Assumed("at the goal", {}, {0, 1}));
  }
};

class Toy final : public Navigator {
 public:
  Toy(const ToyParams& params, const NavigatorSetup& setup) : params_(params), setup_(setup) {}

  NavigatorDecision Decide(const NavigatorInput& input) override {
    const bool gives_up = input.time_s > params_.patience_s || setup_.goal.x_m > 7.0;
    return {.status = gives_up ? NavigatorStatus::kGaveUp : NavigatorStatus::kDriving};
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, GoalChange) override {}

 private:
  ToyParams params_;
  NavigatorSetup setup_;
};

NavigatorDescription<ToyParams> DescribeToy(std::string_view name = "toy") {
  return {.name = name,
          .doc = "gives up",
          .traits = [](const ToyParams& params) -> NavigatorTraits {
            return {LookReading::kNothing, CostOfLook{0.5}, {"tolerance_m", params.tolerance_m}};
          },
          .make = [](const ToyParams& params, const NavigatorSetup& setup)
              -> std::unique_ptr<Navigator> { return std::make_unique<Toy>(params, setup); }};
}

// What a set lists where it is visited: a group of its own in a file.
struct Group {
  NavigatorSet set = StandardNavigators();

  void Visit(core::FieldVisitor& v) { set.Visit(v); }
};

Group WithToy() {
  Group group;
  group.set.Add(DescribeToy());
  return group;
}

Group Read(const std::string& json) {
  Group group = WithToy();
  const core::JsonValue document = core::ParseJson(json, "test");
  core::ReadParams(document, group);
  return group;
}

std::string ProblemOf(const NavigatorDescription<ToyParams>& description) {
  NavigatorSet set = StandardNavigators();
  return core::RefusalOf([&] { set.Add(description); });
}

NavigatorStatus StatusAt(const NavigatorKind& kind, double time_s, double goal_x_m) {
  return kind.Make({.goal = {goal_x_m, 0.0}})->Decide({.time_s = time_s}).status;
}

TEST(NavigatorSet, TheStandardOneBeginsWithTheBehaviourController) {
  const NavigatorSet set = StandardNavigators();
  EXPECT_THAT(set.names(), ElementsAre("pathfinder", "gestalt", "route", "enav"));
  EXPECT_EQ(set.chosen().name(), "pathfinder");
}

TEST(NavigatorSet, ReadsTheChoiceAndTheGroupOfANavigatorThatWasAdded) {
  const Group group = Read(R"({"navigator": "toy", "toy": {"patience_s": 3}})");
  EXPECT_EQ(group.set.chosen().name(), "toy");
  EXPECT_EQ(group.set.params<ToyParams>().patience_s, 3.0);
  EXPECT_EQ(group.set.params<ToyParams>().tolerance_m, 0.2);
  EXPECT_EQ(StatusAt(group.set.chosen(), 2.9, 1.0), NavigatorStatus::kDriving);
  EXPECT_EQ(StatusAt(group.set.chosen(), 3.1, 1.0), NavigatorStatus::kGaveUp);
  EXPECT_EQ(StatusAt(group.set.chosen(), 0.0, 8.0), NavigatorStatus::kGaveUp);
}

TEST(NavigatorSet, RefusesAnUnknownNameAndNamesTheNearest) {
  EXPECT_THAT(core::ProblemsIn([] { Read(R"({"navigator": "toi"})"); }),
              core::OneProblem("navigator", "", "toy"));
  NavigatorSet set = StandardNavigators();
  EXPECT_THROW(set.Choose("toy"), core::UserError);
}

TEST(NavigatorSet, WritesWhatItReads) {
  const Group group = Read(R"({"navigator": "toy", "toy": {"tolerance_m": 0.25}})");
  const std::string text = core::DumpJson(core::WriteParams(group));
  EXPECT_EQ(core::DumpJson(core::WriteParams(Read(text))), text);
  EXPECT_THAT(text, HasSubstr("\"tolerance_m\": 0.25"));
}

TEST(NavigatorSet, ACopyHasParametersOfItsOwn) {
  NavigatorSet set = WithToy().set;
  NavigatorSet copy = set;
  copy.params<ToyParams>().patience_s = 1.0;
  copy.params<PathfinderParams>().scan_interval_m = 1.0;
  copy.Choose("toy");
  EXPECT_EQ(set.params<ToyParams>().patience_s, 5.0);
  EXPECT_EQ(set.params<PathfinderParams>().scan_interval_m, PathfinderParams{}.scan_interval_m);
  EXPECT_EQ(set.chosen().name(), "pathfinder");
  set = copy;
  copy.params<ToyParams>().patience_s = 2.0;
  EXPECT_EQ(set.params<ToyParams>().patience_s, 1.0);
  EXPECT_EQ(set.chosen().name(), "toy");
}

TEST(NavigatorSet, RefusesNamesThatAreTakenOrNoKeys) {
  for (const char* taken : {"gestalt", "navigator", "on_board_stuck", "wheel_driver", "extends"}) {
    EXPECT_THAT(ProblemOf(DescribeToy(taken)),
                testing::StartsWith("navigation." + std::string(taken) + ": is taken"));
  }
  for (const char* odd : {"", "Toy", "a.b", "to y", "toy\n"}) {
    EXPECT_THAT(ProblemOf(DescribeToy(odd)), HasSubstr("cannot be the name")) << odd;
  }
  EXPECT_EQ(ProblemOf(DescribeToy("toy_2")), "");
}

TEST(NavigatorSet, TraitsFollowTheParameters) {
  NavigatorSet set = WithToy().set;
  set.params<ToyParams>().tolerance_m = 0.3;
  set.Choose("toy");
  const NavigatorTraits traits = set.chosen().traits();
  EXPECT_EQ(traits.goal.tolerance_m, 0.3);
  EXPECT_EQ(set.chosen().PathOf(traits.goal.path), "navigation.toy.tolerance_m");
  EXPECT_EQ(std::get<CostOfLook>(traits.cost).time_s, 0.5);

  set.params<GestaltParams>().map.grid = {.xN_m = 6.0, .yN_m = 5.0, .xstep_m = 0.1, .ystep_m = 0.4};
  set.Choose("gestalt");
  const auto cost = std::get<CostOfMap>(set.chosen().traits().cost);
  EXPECT_DOUBLE_EQ(cost.cell_m, 0.2);
  EXPECT_DOUBLE_EQ(cost.area_m2, 30.0);
}

TEST(NavigatorSet, TheSizeOfARoverThatIsNotModelledIsNotBelieved) {
  NavigatorSet set = StandardNavigators();
  set.Choose("gestalt");
  set.params<GestaltParams>().map.rover.modelled = true;
  ASSERT_TRUE(set.chosen().traits().size.has_value());
  EXPECT_EQ(set.chosen().traits().size->length_m, set.params<GestaltParams>().map.rover.length_m);
  EXPECT_EQ(set.chosen().traits().size->width_m, set.params<GestaltParams>().map.rover.width_m);
  set.params<GestaltParams>().map.rover.modelled = false;
  EXPECT_FALSE(set.chosen().traits().size.has_value());
}

// What a rover does that notices that it is stuck, whichever navigator it has.

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

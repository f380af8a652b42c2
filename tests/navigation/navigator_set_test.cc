#include <gmock/gmock.h>

#include <memory>
#include <string>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"
#include "navigation/pathfinder/pathfinder_params.h"

namespace rockyard::navigation {
namespace {

using core::Assumed;

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
  const auto navigator = kind.Make({.goal = {goal_x_m, 0.0}});
  return navigator->Decide({.time_s = time_s}).status;
}

TEST(NavigatorSet, TheStandardOneBeginsWithTheBehaviourController) {
  const NavigatorSet set = StandardNavigators();
  EXPECT_THAT(set.names(), ElementsAre("pathfinder", "gestalt", "route"));
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

}  // namespace
}  // namespace rockyard::navigation

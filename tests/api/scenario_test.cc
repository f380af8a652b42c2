// A scenario as other programs hold it.
#include "api/scenario.h"

#include <gmock/gmock.h>

#include <fstream>
#include <utility>

#include "core/refusals.h"
#include "core/test_folder.h"
#include "localization/toy_estimator.h"

namespace rockyard::api {
namespace {

using testing::HasSubstr;
using testing::NanSensitiveDoubleEq;
using testing::Not;
using testing::Pointwise;

TEST(PublicScenario, IsAValue) {
  Scenario first;
  const Scenario copy = first;
  first.Set("trials=7");
  EXPECT_EQ(first.trials(), 7);
  EXPECT_EQ(copy.trials(), 300);
  Scenario assigned;
  assigned = first;
  EXPECT_EQ(assigned.ResolvedJson(), first.ResolvedJson());
  const Scenario moved = std::move(assigned);
  EXPECT_EQ(moved.trials(), 7);
}

TEST(PublicScenario, IsLoadedWithOverridesInOrder) {
  const core::TestFolder folder;
  const std::filesystem::path file = folder.path() / "mine.json";
  std::ofstream(file) << R"({"name": "mine", "seed": 3})";
  const std::vector<std::string> overrides = {"trials=5", "trials=6"};
  const Scenario scenario = Scenario::Load(file, overrides);
  EXPECT_EQ(scenario.name(), "mine");
  EXPECT_EQ(scenario.seed(), 3U);
  EXPECT_EQ(scenario.trials(), 6);
  EXPECT_EQ(Scenario::Parse(scenario.ResolvedJson()).ResolvedJson(), scenario.ResolvedJson());
}

TEST(PublicScenario, KeepsItsValuesWhereASettingIsWrong) {
  Scenario scenario;
  const std::string before = scenario.ResolvedJson();
  EXPECT_THAT(core::RefusalOf([&] { scenario.Set("trials=-1"); }), HasSubstr("trials"));
  EXPECT_EQ(scenario.ResolvedJson(), before);
}

TEST(PublicScenario, IsAssignedToWhatWasMovedFrom) {
  Scenario scenario = Scenario::Parse(R"({"trials": 7})");
  Scenario moved = std::move(scenario);
  scenario = moved;
  EXPECT_EQ(scenario.trials(), 7);
  EXPECT_EQ(scenario.ResolvedJson(), moved.ResolvedJson());
}

TEST(PublicScenario, TakesAnEstimatorOfAnotherProgram) {
  Scenario defaults;
  defaults.estimators().Add(localization::DescribeToy());
  const std::vector<std::string> toy = {"localization.estimator=toy"};
  EXPECT_THAT(Scenario::Parse("{}", toy, ".", defaults).ResolvedJson(), HasSubstr("\"toy\""));
  EXPECT_THAT(core::RefusalOf([&] { Scenario::Parse("{}", toy); }), HasSubstr("toy"));
}

TEST(PublicScenario, ChangesDoNotReachItsExperiment) {
  const std::vector<std::string> cheap = {"rover.fidelity=quasi_static", "referee.time_limit_s=1"};
  Scenario scenario = Scenario::Parse("{}", cheap);
  const auto experiment = scenario.MakeExperiment();
  const truth::Record before = experiment->Run(1, 0);
  scenario.Set("referee.time_limit_s=100");
  const auto same = Pointwise(NanSensitiveDoubleEq(), before.values);
  EXPECT_THAT(experiment->Run(1, 0).values, same);
  EXPECT_THAT(scenario.MakeExperiment()->Run(1, 0).values, Not(same));
}

}  // namespace
}  // namespace rockyard::api

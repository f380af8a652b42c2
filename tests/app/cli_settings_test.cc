// A run with other settings than its scenario's is not taken for the published case.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/command.h"

namespace rockyard::app {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kRocks = "terrain.rocks.k_per_m2=0.002";

class CliSettings : public CommandTest {
 protected:
  static std::string Reference() {
    return std::string(ROCKYARD_SOURCE_DIR) + "/results/reference/matthies1995.json";
  }
  CommandResult Check(const std::string& run, const std::vector<std::string>& more = {}) const {
    return Run(With({"check", run, "--against", Reference(), "--replicates", "100"}, more));
  }
  json Changed(const std::string& run) const {
    return json::parse(Check(run, {"--json"}).out)["not_the_published_case"];
  }
  json Settings(const std::string& run, const std::string& file = "summary.json") const {
    return json::parse(ReadFile(work() / run / file))["settings"];
  }
};

TEST_F(CliSettings, OfARunAreToldAndRecorded) {
  const CommandResult run =
      Run(With(QuickRun("a", 2), {"--set", kRocks, "--ablate", "perfect_localization"}));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("with referee.time_limit_s=1, terrain.rocks.k_per_m2=0.002"));
  const json told = {"referee.time_limit_s=1", kRocks, "--ablate perfect_localization"};
  EXPECT_EQ(Settings("a"), told);
  EXPECT_EQ(Settings("a", "scenario.resolved.json"), told);
  // What comes of it, has them too.
  json more = told;
  more.push_back("course.goal_x_m=4");
  for (const char* source : {"a", "a/scenario.resolved.json"}) {
    const CommandResult again = Run(
        {"run", source, "--out", "b", "--force", "--trials", "1", "--set", "course.goal_x_m=4"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(Settings("b"), more) << source;
  }
}

TEST_F(CliSettings, OfAnotherCaseStandBesideItsVerdicts) {
  ASSERT_EQ(Run(With(QuickRun("a", 2), {"--set", kRocks})).exit_code, 0);
  const CommandResult table = Check("a");
  EXPECT_THAT(table.out,
              Says("NOT the published case", "terrain.rocks.k_per_m2 is 0.002, 0.00415 in"));
  const json changed = Changed("a");
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed[0]["scenario"], "nominal");
  EXPECT_EQ(changed[0]["settings"].size(), 2U);
}

TEST_F(CliSettings, OfThePublishedCaseAreNot) {
  ASSERT_EQ(
      Run({"run", Scenario("nominal"), "--trials", "1", "--seed", "7", "--out", "a"}).exit_code, 0);
  EXPECT_EQ(Settings("a"), json::array());
  EXPECT_THAT(Check("a").out, Not(HasSubstr("NOT the published case")));
  EXPECT_EQ(Changed("a"), json::array());
}

// Nothing is recorded of a file that was edited under its name.
TEST_F(CliSettings, OfAnEditedFileAreFound) {
  json scenario = json::parse(ReadFile(Scenario("nominal")), nullptr, true, true);
  scenario["referee"]["time_limit_s"] = 1;
  WriteFile(work() / "mine.json", scenario.dump());
  ASSERT_EQ(Run({"run", "mine.json", "--trials", "1", "--out", "a"}).exit_code, 0);
  EXPECT_EQ(Settings("a"), json::array());
  const json changed = Changed("a");
  ASSERT_EQ(changed.size(), 1U);
  ASSERT_EQ(changed[0]["settings"].size(), 1U);
  EXPECT_THAT(changed[0]["settings"][0].get<std::string>(), HasSubstr("referee.time_limit_s is 1"));
}

// A reference away from its scenarios: what the run itself has recorded.
TEST_F(CliSettings, AreThoseRecordedWhereTheFileIsNotThere) {
  ASSERT_EQ(Run(With(QuickRun("a", 1), {"--set", kRocks})).exit_code, 0);
  WriteFile(work() / "reference.json", ReadFile(Reference()));
  const CommandResult result =
      Run({"check", "a", "--against", "reference.json", "--replicates", "100", "--json"});
  EXPECT_THAT(result.err, HasSubstr("is not known"));
  const json changed = json::parse(result.out)["not_the_published_case"];
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_THAT(changed[0]["settings"], ElementsAre("referee.time_limit_s=1", kRocks));
}

}  // namespace
}  // namespace rockyard::app

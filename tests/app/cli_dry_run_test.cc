// rockyard sweep --dry-run, and sweep files that it refuses.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/command.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kSweep = R"({
  "name": "small", "trials": 6, "seed": 4,
  "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 1},
  "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]}]
})";

class CliDryRun : public CommandTest {
 protected:
  CliDryRun() { WriteFile(work() / "small.json", kSweep); }

  CommandResult Plan(const std::string& out, const std::vector<std::string>& more) const {
    return Run(With({"sweep", "small.json", "--dry-run", "--out", out}, more));
  }
  json PlanIn(const std::string& folder) const {
    return json::parse(ReadFile(work() / folder / "plan.json"));
  }
  CommandResult SweepOf(const std::string& document) const {
    WriteFile(work() / "other.json", document);
    return Run({"sweep", "other.json", "--out", "refused"});
  }
};

TEST_F(CliDryRun, CountsTheTrialsOfTheRuleTheBudgetAndTheShard) {
  EXPECT_THAT(Plan("plain", {"--pilots", "2"}).out, HasSubstr("2 cells, 12 trials, seed 4"));
  EXPECT_EQ(PlanIn("plain")["trials"], 12);
  EXPECT_EQ(PlanIn("plain")["at_most"], false);

  const CommandResult rule =
      Plan("rule", {"--pilots", "2", "--until-half-width", "0.1", "--max-trials", "300"});
  EXPECT_THAT(rule.out, Says("2 cells, at most 600 trials", "pilot trials: at most "));
  EXPECT_EQ(PlanIn("rule")["trials"], 600);
  EXPECT_EQ(PlanIn("rule")["at_most"], true);
  EXPECT_EQ(PlanIn("rule")["cells"][0]["trials"], 300);

  Plan("budget", {"--pilots", "0", "--until-half-width", "0.1", "--budget", "70"});
  EXPECT_EQ(PlanIn("budget")["trials"], 70);
  Plan("shard", {"--pilots", "0", "--shard", "1/4"});
  EXPECT_EQ(PlanIn("shard")["trials"], 4) << "trials 0 and 4 of each cell";
  const CommandResult both = Plan("both", {"--shard", "1/4", "--until-half-width", "0.1"});
  EXPECT_EQ(both.exit_code, 2) << "as without --dry-run";
  EXPECT_FALSE(fs::exists(work() / "both"));
}

TEST_F(CliDryRun, OnePilotTellsNoScatter) {
  const CommandResult one = Plan("one", {"--pilots", "1"});
  EXPECT_THAT(one.out, HasSubstr("(standard error unknown)"));
  EXPECT_FALSE(PlanIn("one")["cost"].contains("cpu_s_standard_error"));
  Plan("two", {"--pilots", "2"});
  EXPECT_TRUE(PlanIn("two")["cost"].contains("cpu_s_standard_error"));
}

// Whenever it is interrupted, the same command works again; what a plan has no part in stays.
TEST_F(CliDryRun, AnInterruptedOneCanBeRepeated) {
  const pid_t process = Start({"sweep", "small.json", "--dry-run", "--pilots", "1000", "--out", "p",
                               "--set", "referee.time_limit_s=1e4"});
  usleep(300000);
  kill(process, SIGKILL);
  Wait(process);
  EXPECT_FALSE(fs::exists(work() / "p")) << "pilots come first";
  fs::create_directories(work() / "p" / "cells");
  WriteFile(work() / "p" / "cells" / "0001-k_per_m2_0.001.json.tmp-7", "{");
  WriteFile(work() / "p" / "plan.csv", "cell");
  const CommandResult again = Plan("p", {"--pilots", "0"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(PlanIn("p")["cells"].size(), 2u);

  WriteFile(work() / "p" / "letter.txt", "dear");
  EXPECT_EQ(Plan("p", {"--pilots", "0"}).exit_code, 2);
}

TEST_F(CliDryRun, OnRanksItIsMadeOnce) {
  setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
  setenv("OMPI_COMM_WORLD_RANK", "1", 1);
  const CommandResult second = Plan("p", {"--pilots", "0"});
  setenv("OMPI_COMM_WORLD_RANK", "0", 1);
  const bool written = fs::exists(work() / "p");
  const CommandResult first = Plan("p", {"--pilots", "0"});
  unsetenv("OMPI_COMM_WORLD_RANK");
  unsetenv("OMPI_COMM_WORLD_SIZE");
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_EQ(second.out + second.err, "");
  EXPECT_FALSE(written);
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_TRUE(fs::exists(work() / "p" / "plan.json"));
}

TEST_F(CliDryRun, ProblemsNameTheFile) {
  const CommandResult result = SweepOf(R"({"trials": -3, "axes": [{"values": 4}]})");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("error: other.json: trials: "));
  EXPECT_THAT(result.err, Not(HasSubstr("error: axes")));
  EXPECT_THAT(result.err, Not(HasSubstr("other.json: other.json")));
  EXPECT_FALSE(fs::exists(work() / "refused"));
}

// A scale that was asked for is not given up in silence.
TEST_F(CliDryRun, NoLogarithmicFitOverZero) {
  const std::string axes = R"("axes": [{"path": "terrain.rocks.k_per_m2", "values": [0, 0.01]}])";
  const std::string rest = R"("trials": 2, "set": {"rover.fidelity": "quasi_static",
                               "referee.time_limit_s": 1}, )";
  const CommandResult asked = SweepOf(R"({"fit": {"scale": "log"}, )" + rest + axes + "}");
  EXPECT_EQ(asked.exit_code, 2);
  EXPECT_THAT(asked.err, HasSubstr("fit.scale: is log, and axis k_per_m2 has the number 0"));
  EXPECT_FALSE(fs::exists(work() / "refused"));
  EXPECT_EQ(SweepOf(R"({"fit": {"scale": "linear"}, )" + rest + axes + "}").exit_code, 0);
}

TEST_F(CliDryRun, SweepsAndScenariosAreToldApart) {
  const CommandResult sweep = RunTo(2, {"sweep", Scenario("nominal")});
  EXPECT_THAT(sweep.err, HasSubstr("use rockyard run"));
  EXPECT_THAT(RunTo(2, {"run", "small.json"}).err,
              HasSubstr("`rockyard sweep FILE --dry-run` writes"));
}

}  // namespace
}  // namespace rockyard::app

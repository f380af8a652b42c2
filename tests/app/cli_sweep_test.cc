// rockyard sweep, with real trials of one simulated second.

#include "app/command.h"

namespace rockyard::app {
namespace {

// Two abundances, two speeds; a trial ends after a simulated second.
constexpr const char* kSweep = R"({
  "name": "small", "trials": 3, "seed": 4,
  "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 1},
  "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]},
           {"name": "speed", "levels": [{"name": "<slow>", "set": {"rover.drive.speed_m_s": 0.05}},
                                        {"name": "../fast", "set": {}}]}]
})";

class CliSweep : public CommandTest {
 protected:
  CliSweep() { WriteFile(work() / "small.json", kSweep); }

  static Words SweepTo(const std::string& out) { return {"sweep", "small.json", "--out", out}; }
};

TEST_F(CliSweep, WritesTheWholeFolder) {
  const CommandResult result = RunTo(0, SweepTo("a"));
  for (const char* name : {"results.sqlite", "summary.json", "sweep.json", "cells.csv",
                           "curves.csv", "fit.csv", "fits.csv", "differences.csv", "success.svg"}) {
    EXPECT_TRUE(fs::exists(work() / "a" / name)) << name;
  }
  const json summary = Summary("a");
  EXPECT_EQ(summary["kind"], "sweep");
  EXPECT_EQ(summary["trials"]["completed"], 12);
  ASSERT_EQ(summary["cells"].size(), 4u);
  EXPECT_EQ(summary["cells"][1]["levels"]["k_per_m2"], 0.001);
  EXPECT_EQ(summary["cells"][1]["levels"]["speed"], "../fast");
  EXPECT_EQ(summary["cells"][3]["outcomes"]["time_limit"], 3);
  EXPECT_THAT(result.out,
              Says("12 of 12 trials", "no fit: nothing but successes, or nothing but failures"));
  EXPECT_THAT(result.err, HasSubstr("12/12 done"));
}

TEST_F(CliSweep, MergedShardsAreTheSweepOfOneMachine) {
  RunTo(0, SweepTo("whole"));
  for (const char* part : {"1", "2"}) {
    const std::string out = std::string("s") + part;
    const CommandResult shard = RunTo(0, With(SweepTo(out), {"--shard", std::string(part) + "/2"}));
    EXPECT_THAT(shard.out, HasSubstr(std::string("shard ") + part + " of 2"));
  }
  // Trials 0, 2 of each of four cells here, trial 1 there.
  EXPECT_EQ(Summary("s1")["accounting"]["completed"], 8);
  EXPECT_EQ(Summary("s2")["accounting"]["planned"], 4);
  EXPECT_EQ(Summary("s2")["cells"][3]["accounting"]["completed"], 1);
  EXPECT_FALSE(Summary("s2")["cells"][3].contains("declared_success")) << "no rates from a shard";
  const CommandResult merged = RunTo(0, {"merge", "s2", "s1", "--out", "merged"});
  EXPECT_EQ(Hash("merged"), Hash("whole"));
  EXPECT_EQ(ReadFile(work() / "merged" / "cells.csv"), ReadFile(work() / "whole" / "cells.csv"));
  EXPECT_EQ(Summary("merged")["accounting"], Summary("whole")["accounting"]);
}

TEST_F(CliSweep, SaysWhereEachCellStoppedAndWhy) {
  const CommandResult result = RunTo(
      0, With(SweepTo("a"), {"--until-half-width", "0.15", "--block", "5", "--max-trials", "60"}));
  EXPECT_THAT(result.out, Says("stopping rule: half-width 15.00 %", "precise enough after"));
  const json summary = Summary("a");
  std::int64_t planned = 0;
  for (const json& cell : summary["cells"]) {
    EXPECT_EQ(cell["stopping"]["end"], "precise");
    EXPECT_EQ(cell["stopping"]["trials"], cell["accounting"]["planned"]);
    EXPECT_EQ(cell["accounting"]["pending"], 0);
    EXPECT_LE(cell["stopping"]["interval"][1], 0.3);
    planned += cell["accounting"]["planned"].get<std::int64_t>();
  }
  EXPECT_EQ(summary["accounting"]["planned"], planned);
  EXPECT_THAT(result.out, HasSubstr(std::to_string(planned) + " planned = "));
  EXPECT_THAT(ReadFile(work() / "a" / "cells.csv"), HasSubstr(",precise,"));
}

TEST_F(CliSweep, ThreadsResumeAndGrowthGiveTheSameHash) {
  RunTo(0, With(SweepTo("one"), {"--threads", "1"}));
  RunTo(0, With(SweepTo("two"), {"--threads", "2", "--no-supervisor"}));
  RunTo(0, With(SweepTo("grown"), {"--trials", "2"}));
  EXPECT_NE(Hash("grown"), Hash("one"));
  RunTo(0, With(SweepTo("grown"), {"--trials", "3", "--resume"}));
  EXPECT_EQ(Hash("two"), Hash("one"));
  EXPECT_EQ(Hash("grown"), Hash("one"));
  RunTo(0, With(SweepTo("other"), {"--seed", "5"}));
  EXPECT_NE(Hash("other"), Hash("one")) << "the comparison could not fail";
}

TEST_F(CliSweep, ResumeRefusesAnotherDesign) {
  RunTo(0, SweepTo("a"));
  EXPECT_THAT(RunTo(2, SweepTo("a")).err, HasSubstr("--resume"));
  EXPECT_THAT(RunTo(2, With(SweepTo("a"), {"--resume", "--set", "course.goal_radius_m=0.9"})).err,
              HasSubstr("course.goal_radius_m"));
}

TEST_F(CliSweep, OverridesReachEveryCell) {
  RunTo(0, With(SweepTo("a"), {"--dry-run", "--pilots", "0", "--set", "course.goal_x_m=5"}));
  for (const auto& entry : fs::directory_iterator(work() / "a" / "cells")) {
    EXPECT_EQ(json::parse(ReadFile(entry.path()))["course"]["goal_x_m"], 5.0);
  }
}

TEST_F(CliSweep, ADryRunWritesThePlanAndRunsNothing) {
  const CommandResult result = RunTo(0, With(SweepTo("plan"), {"--dry-run", "--pilots", "2"}));
  EXPECT_FALSE(fs::exists(work() / "plan" / "results.sqlite"));
  const json plan = json::parse(ReadFile(work() / "plan" / "plan.json"));
  EXPECT_EQ(plan["trials"], 12);
  EXPECT_EQ(plan["cost"]["pilots"], 8);
  EXPECT_GT(plan["cost"]["cpu_s"], 0.0);
  ASSERT_EQ(plan["cells"].size(), 4u);
  for (const json& cell : plan["cells"]) {
    const fs::path file = work() / "plan" / std::string(cell["file"]);
    ASSERT_TRUE(fs::exists(file)) << file;
    const json scenario = json::parse(ReadFile(file));
    EXPECT_EQ(scenario["seed"], cell["seed"]);
    EXPECT_EQ(scenario["terrain"]["rocks"]["k_per_m2"], cell["levels"]["k_per_m2"]);
    // A cell's file is a scenario like any other.
    const CommandResult valid = Run({"validate", file.string()});
    EXPECT_THAT(valid.out, HasSubstr(std::string(cell["fingerprint"])));
  }
  EXPECT_TRUE(fs::exists(work() / "plan" / "cells" / "0002-k_per_m2_0.001_speed_.._fast.json"));
  EXPECT_THAT(result.out, HasSubstr("expected cost, from 8 pilot trials"));
}

TEST_F(CliSweep, APlanReplacesAPlanAndNothingElse) {
  RunTo(0, With(SweepTo("p"), {"--dry-run", "--pilots", "0"}));
  RunTo(0, With(SweepTo("p"), {"--dry-run", "--pilots", "0"}));
  fs::create_directories(work() / "mine");
  WriteFile(work() / "mine" / "letter.txt", "dear");
  EXPECT_THAT(RunTo(2, With(SweepTo("mine"), {"--dry-run", "--pilots", "0"})).err,
              HasSubstr("something else than a plan"));
}

// What has no effect comes to light where the numbers are common.
TEST_F(CliSweep, CellsWithEqualTrialsAreNamed) {
  WriteFile(work() / "idle.json", R"({
    "name": "idle", "trials": 2, "common_random_numbers": true,
    "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 1},
    "axes": [{"path": "terrain.rocks.uniform_max_diameter_m", "values": [0.4, 0.5]}]})");
  EXPECT_THAT(RunTo(0, {"sweep", "idle.json", "--out", "a"}).out, HasSubstr("had no effect"));
  const CommandResult plan = Run({"sweep", "idle.json", "--out", "p", "--dry-run"});
  EXPECT_THAT(plan.err, HasSubstr("may have no effect"));
  EXPECT_THAT(Run(SweepTo("b")).out, Not(HasSubstr("no effect")));
}

TEST_F(CliSweep, NamesAreTextInEveryFile) {
  RunTo(0, SweepTo("a"));
  const std::string drawing = ReadFile(work() / "a" / "success.svg");
  EXPECT_THAT(drawing, HasSubstr("speed=&lt;slow&gt;"));
  EXPECT_THAT(drawing, Not(HasSubstr("<slow>")));
  EXPECT_THAT(ReadFile(work() / "a" / "cells.csv"), HasSubstr("\"k_per_m2=0.001,speed=<slow>\""));
}

TEST_F(CliSweep, BadFilesAreRefusedAndNothingIsWritten) {
  WriteFile(work() / "small.json",
            R"({"axes": [{"path": "terrain.rocks.kper_m2", "values": [1]}]})");
  const CommandResult result = RunTo(2, SweepTo("a"));
  EXPECT_THAT(result.err, Says("axes[0].path", "did you mean \"terrain.rocks.k_per_m2\"?"));
  EXPECT_FALSE(fs::exists(work() / "a"));
  RunTo(2, {"sweep", "none.json"});
}

TEST_F(CliSweep, OtherCommandsKnowSweeps) {
  EXPECT_THAT(RunTo(0, {"validate", "small.json"}).out, HasSubstr("a sweep of 4 cells"));
  EXPECT_THAT(Run({"list", "."}).out, HasSubstr("sweep of 4 cells: small"));
  EXPECT_THAT(RunTo(2, {"run", "small.json"}).err,
              HasSubstr("`rockyard sweep FILE --dry-run` writes"));
}

TEST_F(CliSweep, JsonIsTheSummary) {
  const CommandResult result = Run(With(SweepTo("a"), {"--json"}));
  EXPECT_EQ(json::parse(result.out)["trial_hash"], Hash("a"));
  EXPECT_TRUE(Run(With(SweepTo("b"), {"--quiet"})).out.empty());
}

// rockyard sweep --dry-run, and sweep files that it refuses.

constexpr const char* kPlannedSweep = R"({
  "name": "small", "trials": 6, "seed": 4,
  "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 1},
  "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]}]
})";

class CliDryRun : public CommandTest {
 protected:
  CliDryRun() { WriteFile(work() / "small.json", kPlannedSweep); }

  CommandResult Plan(const std::string& out, const Words& more) const {
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
  EXPECT_THAT(Plan("one", {"--pilots", "1"}).out, HasSubstr("(standard error unknown)"));
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

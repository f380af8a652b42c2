// rockyard sweep, with real trials of one simulated second.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/command.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

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

  static std::vector<std::string> SweepTo(const std::string& out) {
    return {"sweep", "small.json", "--out", out};
  }
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
  ASSERT_EQ(Run(SweepTo("whole")).exit_code, 0);
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

}  // namespace
}  // namespace rockyard::app

// Planning, metrics, baselines and the check against them, as typed.

#include "app/command.h"

namespace rockyard::app {
namespace {

class CliRegression : public CommandTest {
 protected:
  void MakeBaseline(int trials) {
    RunTo(0, QuickRun("a", trials));
    RunTo(0, {"baseline", "a", "--reason", "first", "--out", "b.json"});
  }
  Words CheckOf(const std::string& run) const { return {"check", run, "--against", "b.json"}; }
  json Baseline() const { return json::parse(ReadFile(work() / "b.json")); }
  void Write(const json& baseline) const { WriteFile(work() / "b.json", baseline.dump()); }
};

TEST_F(CliRegression, PlanAnswersInTextAndJson) {
  const CommandResult claim = RunTo(0, {"plan", "claim", "--below", "0.001", "--json"});
  EXPECT_EQ(json::parse(claim.out)["trials"], 2995);
  EXPECT_EQ(json::parse(claim.out)["rule_of_three"], 3000);
  // The rule is that of no failure; two of them ask for more than 3 over the rate.
  const json two =
      json::parse(Run({"plan", "claim", "--below", "0.001", "--failures", "2", "--json"}).out);
  EXPECT_GT(two["trials"], 6000);
  EXPECT_FALSE(two.contains("rule_of_three"));
  const CommandResult difference = Run(
      {"plan", "difference", "--from", "0.85", "--to", "0.75", "--discordant", "0.2", "--json"});
  EXPECT_GE(json::parse(difference.out)["fisher_power"], 0.8);
  EXPECT_GT(json::parse(difference.out)["mcnemar"], 0);
  EXPECT_THAT(Run({"plan", "half-width", "--half-width", "0.02"}).out, HasSubstr("Wilson"));
  EXPECT_THAT(Run({"plan", "equivalence", "--margin", "1", "--deviation", "2"}).out,
              HasSubstr("pairs"));
}

TEST_F(CliRegression, PlanRefusesWhatHasNoAnswer) {
  RunTo(2, {"plan"});
  RunTo(2, {"plan", "claim", "--below", "2"});
  RunTo(2, {"plan", "half-width", "--half-width", "0.5"});
  EXPECT_THAT(Run({"plan", "difference", "--from", "0.5", "--to", "0.5"}).err, HasSubstr("--to"));
  EXPECT_THAT(
      Run({"plan", "difference", "--from", "0.9", "--to", "0.8", "--discordant", "0.01"}).err,
      HasSubstr("--discordant"));
}

TEST_F(CliRegression, MetricsAreListed) {
  EXPECT_THAT(RunTo(0, {"metrics"}).out, Says("path_ratio", "min_clearance_m"));
}

TEST_F(CliRegression, IdenticalRunsAreDoneHoweverFewAndLonger) {
  MakeBaseline(4);
  EXPECT_THAT(RunTo(0, CheckOf("a")).out, HasSubstr("identical: 4 trials, every bit"));
  RunTo(0, QuickRun("longer", 6));
  EXPECT_THAT(RunTo(0, CheckOf("longer")).out, HasSubstr("the first 4 of 6 trials are used"));
}

TEST_F(CliRegression, AnotherHashOfTheSameBuildIsADifference) {
  MakeBaseline(4);
  json baseline = Baseline();
  baseline["cells"][0]["trial_hash"] = "0000000000000000";
  Write(baseline);
  const bool dirty = std::string(baseline["build"]).find("-dirty") != std::string::npos;
  const CommandResult result = Run(With(CheckOf("a"), {"--junit", "j.xml"}));
  EXPECT_EQ(result.exit_code, dirty ? 4 : 1) << "a build of changed files proves nothing";
  EXPECT_EQ(result.out.starts_with("determinism is broken"), !dirty);
  baseline["build"] = "another";
  Write(baseline);
  EXPECT_EQ(Run(CheckOf("a")).exit_code, 4) << "four trials of another build tell nothing";
}

// Records and distribution are two findings: bits may change where nothing else does.
TEST_F(CliRegression, ChangedRecordsAreAFindingOfTheirOwn) {
  MakeBaseline(4);
  const auto told = [&] { return json::parse(Run(With(CheckOf("a"), {"--json"})).out); };
  EXPECT_EQ(told()["records"], "same");
  RunTo(0, With(CheckOf("a"), {"--same-records"}));

  json baseline = Baseline();
  baseline["build"] = "another";
  json& cell = baseline["cells"][0];
  cell["trial_hash"] = "0000000000000000";
  Write(baseline);
  EXPECT_EQ(told()["records"], "changed");
  EXPECT_EQ(told()["cells"][0]["records"],
            json::parse(R"({"pairs": 4, "changed": 0, "only_hash": true, "columns": []})"));
  EXPECT_THAT(Run(CheckOf("a")).out, HasSubstr("another hash"));

  cell["metrics"]["scans"][2] = cell["metrics"]["scans"][2].get<double>() + 1.0;
  cell["metrics"]["scans"][3] = cell["metrics"]["scans"][3].get<double>() + 1.0;
  cell["metrics"]["stops"][3] = cell["metrics"]["stops"][3].get<double>() + 1.0;
  Write(baseline);
  EXPECT_EQ(told()["cells"][0]["records"],
            json::parse(R"({"pairs": 4, "changed": 2, "only_hash": false,
                            "columns": [{"column": "scans", "trials": 2},
                                        {"column": "stops", "trials": 1}]})"));
  const CommandResult result = Run(CheckOf("a"));
  EXPECT_EQ(result.exit_code, 4) << "four trials tell nothing of the distribution";
  EXPECT_THAT(result.out, Says("records: changed", "2 of 4 trials: scans 2, stops 1",
                               "distribution: inconclusive"));
  RunTo(1, With(CheckOf("a"), {"--same-records"}));
}

TEST_F(CliRegression, RecordsOfOtherSeedsAreNotComparable) {
  MakeBaseline(4);
  RunTo(0, With(QuickRun("other", 4), {"--seed", "77"}));
  EXPECT_THAT(RunTo(4, With(CheckOf("other"), {"--same-records"})).out,
              HasSubstr("records: not comparable"));
}

TEST_F(CliRegression, UnknownMetricsAreNotPassedOver) {
  MakeBaseline(4);
  json baseline = Baseline();
  baseline["cells"][0]["margins"]["smoothness"] = 1.0;
  baseline["cells"][0]["metrics"]["smoothness"] = {1, 2, 3, 4};
  Write(baseline);
  EXPECT_THAT(RunTo(4, CheckOf("a")).out, HasSubstr("unknown to this program: smoothness"));
}

TEST_F(CliRegression, OtherScenariosAreRefused) {
  MakeBaseline(4);
  RunTo(0, With(QuickRun("c", 4), {"--set", "terrain.rocks.k_per_m2=0.01"}));
  EXPECT_THAT(RunTo(2, CheckOf("c")).err, HasSubstr("terrain.rocks.k_per_m2"));
  EXPECT_NE(Run(With(CheckOf("c"), {"--allow-scenario-change"})).exit_code, 2);
}

// A setting that the baseline's program did not have: harmless at its default only.
TEST_F(CliRegression, YoungerSettingsAreAnotherScenarioUnlessAtTheirDefault) {
  MakeBaseline(4);
  json baseline = Baseline();
  json& cell = baseline["cells"][0];
  cell["fingerprint"] = "0";
  json& referee = cell["resolved"]["referee"];
  referee.erase("time_limit_s");  // which the run has at 1 s, not at its default
  Write(baseline);
  EXPECT_THAT(RunTo(2, CheckOf("a")).err, HasSubstr("referee.time_limit_s"));
  baseline = Baseline();
  json& resolved = baseline["cells"][0]["resolved"];
  resolved["referee"]["time_limit_s"] = 1.0;
  resolved["course"].erase("trials_per_layout");
  Write(baseline);
  EXPECT_THAT(RunTo(0, CheckOf("a")).out, HasSubstr("course.trials_per_layout"));
  for (const char* key : {"tip_over_deg", "stall_window_s", "stall_distance_m", "stall_turn_deg"}) {
    resolved["referee"].erase(key);
  }
  Write(baseline);
  EXPECT_THAT(RunTo(0, CheckOf("a")).out,
              testing::ContainsRegex("note: .*: 5 settings are younger .*, \\.\\.\\.\n$"));
}

TEST_F(CliRegression, SharedRocksAreRefused) {
  RunTo(0, With(QuickRun("s", 4), {"--set", "course.trials_per_layout=2"}));
  EXPECT_THAT(RunTo(2, {"baseline", "s", "--reason", "r", "--out", "b.json"}).err,
              HasSubstr("not independent"));
  MakeBaseline(4);
  EXPECT_THAT(RunTo(2, With(CheckOf("s"), {"--allow-scenario-change"})).err,
              HasSubstr("not independent"));
}

TEST_F(CliRegression, BaselinesNeedAReasonAndARun) {
  RunTo(0, QuickRun("a", 2));
  RunTo(2, {"baseline", "a"});
  EXPECT_THAT(Run({"baseline", "a", "--reason", " "}).err, HasSubstr("--reason"));
  RunTo(2, {"baseline", "nowhere", "--reason", "r", "--out", "b.json"});
  EXPECT_FALSE(fs::exists(work() / "b.json"));
}

// A deliberate change of the vehicle against the committed baseline: stripe points are missed.
TEST_F(CliRegression, AChangedBuildIsCaught) {
  const std::string root = ROCKYARD_SOURCE_DIR;
  const CommandResult run =
      RunTo(0, {"sweep", root + "/scenarios/sweeps/regression.json", "--out", "changed", "--quiet",
                "--trials", "60", "--set", "sensors.light_stripe.missed_probability=0.05"});
  const CommandResult result =
      RunTo(1, {"check", "changed", "--against", root + "/results/baselines/regression.json",
                "--allow-scenario-change"});
  EXPECT_THAT(result.out, Says("missed_probability", "time_to_goal_s rose"));
}

}  // namespace
}  // namespace rockyard::app

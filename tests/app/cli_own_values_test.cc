// What a navigator of one's own counts, from a run of a plugin to every command that tells of runs;
// and drives whose navigator ended their process.

#include "app/cli_report.h"
#include "batch/forged_store.h"

namespace rockyard::app {
namespace {

class CliOwnValues : public CliReportTest {
 protected:
  static std::string Plugins() {
    return std::string(R"(plugins=[{"library": ")") + COUNTING_NAVIGATOR + R"("}])";
  }

  // Drives by the plugin's navigator.
  Words Counting(const std::string& out, int trials, const Words& more = {}) const {
    return With(QuickRun(out, trials),
                With({"--set", "rover.fidelity=quasi_static", "--set", "referee.time_limit_s=60",
                      "--set", Plugins(), "--set", "navigation.navigator=counter"},
                     more));
  }
  Words Plain(const std::string& out, int trials) const {
    return With(QuickRun(out, trials),
                {"--set", "rover.fidelity=quasi_static", "--set", "referee.time_limit_s=60"});
  }
  static Words Checked(const std::string& run, const std::string& baseline = "b.json") {
    return {"check", run, "--against", baseline, "--allow-scenario-change"};
  }
};

TEST_F(CliOwnValues, StandInTheFilesOfARun) {
  const CommandResult told = RunTo(0, Counting("a", 5));
  EXPECT_THAT(told.out, Says("counter.decisions", "counter.last_s [s]"));
  const json summary = Summary("a");
  EXPECT_EQ(summary["metrics"]["counter.decisions"]["count"], 5);
  EXPECT_GT(summary["metrics"]["counter.decisions"]["mean"], 1.0);
  EXPECT_THAT(ReadFile(work() / "a/trials.csv"), HasSubstr(",counter.decisions,counter.last_s,"));
  EXPECT_THAT(RunTo(0, {"metrics", "nominal", "--set", Plugins()}).out,
              Says("counter.decisions", "times that it decided"));
  EXPECT_THAT(RunTo(0, {"metrics", "nominal"}).out, Not(HasSubstr("counter")));
  RunTo(0, Plain("plain", 2));
  EXPECT_FALSE(Summary("plain")["columns"].contains("counter.decisions")) << "the control";
}

TEST_F(CliOwnValues, AreLeftOutOfAComparisonWithARunThatHasNone) {
  RunTo(0, Counting("own", 4));
  RunTo(0, Plain("plain", 4));
  EXPECT_THAT(RunTo(0, {"compare", "plain", "own"}).out,
              Says("4 pairs", "by the navigator of B alone, and left out: counter.decisions,"));
  EXPECT_THAT(RunTo(0, {"compare", "own", "plain"}).out, HasSubstr("by the navigator of A alone"));
  RunTo(0, Counting("longer", 4, {"--set", "navigation.counter.stretch_m=1"}));
  const CommandResult both = RunTo(0, {"compare", "own", "longer"});
  EXPECT_THAT(both.out, AllOf(HasSubstr("\n  counter.decisions"), Not(HasSubstr("left out:"))));
  const json told = json::parse(RunTo(0, {"compare", "plain", "own", "--json"}).out);
  EXPECT_THAT(told["comparison"]["notes"].back(), HasSubstr("counter.last_s"));
}

TEST_F(CliOwnValues, AreCheckedAgainstABaseline) {
  RunTo(0, Counting("a", 6));
  RunTo(0, {"baseline", "a", "--reason", "first", "--out", "b.json"});
  const json baseline = json::parse(ReadFile(work() / "b.json"));
  EXPECT_EQ(baseline["cells"][0]["metrics"]["counter.decisions"].size(), 6u);
  EXPECT_THAT(RunTo(0, Checked("a")).out, HasSubstr("identical: 6 trials, every bit"));
  // Asked half as often it decides less: the records say so.
  RunTo(0, Counting("longer", 6, {"--set", "navigation.counter.stretch_m=1"}));
  EXPECT_THAT(Run(Checked("longer")).out, HasSubstr("6 of 6 trials: counter.decisions 6"));
  // A run that counts nothing is no failure of the check, but leaves it undecided.
  RunTo(0, Plain("plain", 6));
  const CommandResult lacking = Run(Checked("plain"));
  EXPECT_THAT(lacking.out, HasSubstr("the run has no column for counter.decisions"));
  EXPECT_NE(lacking.exit_code, 0);
  EXPECT_NE(lacking.exit_code, 2) << lacking.err;
  // What the baseline does not know is noted.
  RunTo(0, {"baseline", "plain", "--reason", "first", "--out", "p.json"});
  EXPECT_THAT(Run(Checked("a", "p.json")).out,
              HasSubstr("not checked: counter.decisions, counter.last_s"));
  RunTo(0, Checked("plain", "p.json"));
}

// Two navigators at two abundances.
TEST_F(CliOwnValues, OfASweepAreInEveryCellOfTheirNavigator) {
  WriteFile(work() / "s.json", std::string(R"({
      "name": "s", "trials": 3, "common_random_numbers": true,
      "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 60,
              "plugins": [{"library": ")") +
                                   COUNTING_NAVIGATOR + R"("}]},
      "axes": [{"path": "navigation.navigator", "values": ["pathfinder", "counter"]},
               {"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]}]})");
  const CommandResult told = RunTo(0, {"sweep", "s.json", "--out", "s"});
  EXPECT_THAT(told.out, HasSubstr("counted by navigators"));
  const json summary = Summary("s");
  for (std::size_t cell = 0; cell < 4; ++cell) {
    const json& metric = summary["cells"][cell]["metrics"]["counter.decisions"];
    EXPECT_EQ(metric["count"], cell < 2 ? 0 : 3);
    EXPECT_EQ(metric["mean"].is_null(), cell < 2);
  }
  ASSERT_EQ(Report({"s", "--tracks", "0"}).exit_code, 0);
  const json data = Data();
  EXPECT_GT(data["sweeps"][0]["summary"]["cells"][2]["metrics"]["counter.decisions"]["mean"], 1.0);
  const json& columns = data["runs"][2]["trials"]["columns"];
  const auto own = std::find_if(columns.begin(), columns.end(), [](const json& each) {
    return each["name"] == "counter.decisions";
  });
  ASSERT_NE(own, columns.end());
  EXPECT_EQ((*own)["meaning"], "times that it decided");
  RunTo(0, {"baseline", "s", "--reason", "first", "--out", "b.json"});
  RunTo(0, Checked("s"));
}

// As a supervisor leaves them; that they would end this program too cannot be seen from outside, so
// that they must not be driven again.
TEST_F(CliOwnValues, CrashedDrivesAreReportedWithoutBeingDrivenAgain) {
  RunTo(0, Counting("a", 6, {"--set", "course.trials_per_layout=2"}));
  const std::string columns = [&] {
    std::string head = ReadFile(work() / "a/trials.csv");
    head = head.substr(0, head.find(",cause,"));
    std::string sql;
    std::size_t from = head.find(",", head.find(",") + 1) + 1;
    for (std::size_t to = 0; from < head.size(); from = to + 1) {
      to = std::min(head.find(',', from), head.size());
      sql += ", \"" + head.substr(from, to - from) + "\" = NULL";
    }
    return sql;
  }();
  batch::Forge(work() / "a/results.sqlite",
               "UPDATE trials SET outcome = 'navigator_fault', detail = 'stopped because its "
               "navigator crashed the process that ran it: signal 11'" +
                   columns + " WHERE trial = 3");
  ASSERT_EQ(Report({"a", "--plugins"}, 3).exit_code, 0);
  const json run = Data()["runs"][0];
  EXPECT_EQ(run["summary"]["outcomes"]["navigator_fault"], 1);
  EXPECT_EQ(run["summary"]["causes"]["navigator_crashed"], 1);
  EXPECT_EQ(run["summary"]["declared_success"]["trials"], 6);
  EXPECT_EQ(run["shared_layouts"], true);
  EXPECT_FALSE(run["replays"].contains("3"));
  EXPECT_TRUE(run["replays"].contains("2") || run["replays"].contains("1")) << "the control";
  for (const json& track : run["tracks"]) EXPECT_NE(track["trial"], 3);
  EXPECT_EQ(run["tracks"].size(), 5u);
  const CommandResult compared = RunTo(0, {"compare", "a", "a"});
  EXPECT_THAT(compared.out, HasSubstr("6 pairs"));
}

}  // namespace
}  // namespace rockyard::app

// rockyard run and check on the experiment "hazard_detection".

#include "app/command.h"

namespace rockyard::app {
namespace {

class CliHazard : public CommandTest {
 protected:
  static Words Study(const std::string& name, const std::string& out, int trials) {
    return {"run",      Source("scenarios/hazard_detection/") + name + ".json",
            "--set",    "hazard_detection.scenes_per_run=20",
            "--out",    out,
            "--trials", std::to_string(trials)};
  }
};

TEST_F(CliHazard, WritesCellsAndNoSuccess) {
  const CommandResult result = RunTo(0, Study("approach", "a", 96));
  for (const char* name : {"results.sqlite", "summary.json", "trials.csv", "cells.csv", "cells.svg",
                           "scenario.resolved.json"}) {
    EXPECT_TRUE(fs::exists(work() / "a" / name)) << name;
  }
  EXPECT_FALSE(fs::exists(work() / "a" / "distance_cdf.csv"));
  EXPECT_EQ(Summary("a")["cells"].size(), 96u);
  EXPECT_THAT(result.out + result.err, Not(HasSubstr("success")));
  EXPECT_THAT(result.out, HasSubstr("widest 95 % interval of detected_double"));
}

TEST_F(CliHazard, ThreadsAndResumeGiveTheSameHash) {
  Run(With(Study("detection", "one", 30), {"--threads", "1"}));
  Run(With(Study("detection", "two", 30), {"--threads", "2"}));
  Run(Study("detection", "parts", 11));
  RunTo(0, With(Study("detection", "parts", 30), {"--resume"}));
  EXPECT_EQ(Summary("two")["trial_hash"], Summary("one")["trial_hash"]);
  EXPECT_EQ(Summary("parts")["trial_hash"], Summary("one")["trial_hash"]);
}

TEST_F(CliHazard, ABadScenarioWritesNothing) {
  EXPECT_THAT(
      RunTo(2, With(Study("detection", "a", 3), {"--set", "hazard_detection.heights_m=[]"})).err,
      HasSubstr("hazard_detection.heights_m"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliHazard, CheckJudgesByTolerance) {
  Run(With(Study("false_alarm", "runs/alarm", 60),
           {"--set", "hazard_detection.scenes_per_run=500"}));
  const CommandResult result =
      Run({"check", "runs", "--against",
           Source("results/reference/matthies1995_hazard_detection.json"), "--csv", "check.csv"});
  EXPECT_THAT(result.out, Says("a wrong point among 20", "tolerance 0.16 .. 0.2"));
  EXPECT_THAT(ReadFile(work() / "check.csv"), HasSubstr("false_alarm.single"));
}

TEST_F(CliHazard, CompareShowsNoSuccess) {
  Run(Study("false_alarm", "a", 6));
  Run(Study("false_alarm", "b", 6));
  const CommandResult result = RunTo(0, {"compare", "a", "b"});
  EXPECT_THAT(result.out, Not(HasSubstr("success")));
  EXPECT_THAT(result.out, Says("alarm_single", "6 cells in both; none differs"));
}

TEST_F(CliHazard, CompareMatchesCellsAndReportsADifference) {
  // The second height of the first run is the only one of the second.
  const auto heights = [](const std::string& list) {
    return Words{"--set", "hazard_detection.heights_m=" + list,
                 "--set", "hazard_detection.diameters_m=[0.25]",
                 "--set", "hazard_detection.lateral_offsets_m=[0.05]",
                 "--set", "hazard_detection.distances_m=[0.09]"};
  };
  Run(With(Study("detection", "a", 20), heights("[0.03, 0.09]")));
  Run(With(Study("detection", "b", 10), heights("[0.09]")));
  Run(With(Study("detection", "dull", 10),
           With(heights("[0.09]"), {"--set", "perception.hazard.neighbour_threshold_m=1", "--set",
                                    "perception.hazard.range_threshold_m=1"})));
  const CommandResult same = RunTo(0, {"compare", "a", "b", "--csv", "cells.csv"});
  EXPECT_THAT(same.out, HasSubstr("1 cell in both, 1 only in A; none differs"));
  EXPECT_THAT(ReadFile(work() / "cells.csv"), HasSubstr("detected_double,0.09,0.25,"));
  const CommandResult other = RunTo(1, {"compare", "a", "dull"});
  EXPECT_THAT(other.out, HasSubstr("1 of them differs"));
}

TEST_F(CliHazard, CompareRefusesWhatHasNothingInCommon) {
  Run(Study("detection", "detection", 3));
  Run(With(Study("detection", "others", 3), {"--set", "hazard_detection.heights_m=[0.123]"}));
  Run(Study("approach", "approach", 3));
  Run(QuickRun("drive", 1));
  EXPECT_THAT(RunTo(2, {"compare", "detection", "others"}).err, HasSubstr("shares no cell"));
  const CommandResult study = RunTo(2, {"compare", "detection", "approach"});
  EXPECT_THAT(study.err, HasSubstr("study approach of experiment hazard_detection"));
  const CommandResult experiment = RunTo(2, {"compare", "drive", "detection"});
  EXPECT_THAT(experiment.err, HasSubstr("is one of experiment drive"));
}

// rockyard check of one cell against a baseline, and of trials that are the same.

class CliCheckCell : public CommandTest {
 protected:
  CliCheckCell() {
    WriteFile(work() / "two.json", R"({
      "name": "two", "trials": 25,
      "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 300},
      "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]}]})");
  }
  // Long enough that something happens.
  static Words Drives(const std::string& out, int trials) {
    return With(QuickRun(out, trials),
                {"--set", "rover.fidelity=quasi_static", "--set", "referee.time_limit_s=300"});
  }
  CommandResult Check(const std::string& run, const Words& more) const {
    return Run(With({"check", run, "--against", "base.json"}, more));
  }
  void MakeBaseline(const std::string& run) const {
    const CommandResult made =
        RunTo(0, {"baseline", run, "--reason", "test", "--out", "base.json"});
  }
};

TEST_F(CliCheckCell, OnlyThatCellIsCompared) {
  RunTo(0, {"sweep", "two.json", "--out", "a"});
  MakeBaseline("a");
  EXPECT_THAT(Check("a", {}).out, Says("k_per_m2=0.001", "k_per_m2=0.004"));
  for (const char* cell : {"k_per_m2=0.004", "1"}) {
    const CommandResult one = Check("a", {"--cell", cell});
    EXPECT_THAT(one.out, HasSubstr("k_per_m2=0.004"));
    EXPECT_THAT(one.out, Not(HasSubstr("k_per_m2=0.001")));
  }
  const CommandResult wrong = Check("a", {"--cell", "foo"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("\"foo\" is no cell of a"));
  EXPECT_EQ(wrong.out, "");
}

TEST_F(CliCheckCell, ARunOfOneCellHasNoOther) {
  RunTo(0, Drives("a", 2));
  MakeBaseline("a");
  const CommandResult wrong = Check("a", {"--cell", "foo"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("--cell"));
}

// A run that was interrupted, or that is shorter than the baseline, may still be the same.
TEST_F(CliCheckCell, PairsThatAreTheSameAreCounted) {
  RunTo(0, Drives("long", 30));
  RunTo(0, Drives("short", 21));
  MakeBaseline("long");
  EXPECT_THAT(Check("short", {}).out, Says("21 pairs with the baseline's trials (seed 1)\n",
                                           "records: the same, as far as the baseline keeps them"));
  RunTo(0, With(Drives("other", 21), {"--set", "rover.drive.speed_m_s=0.03"}));
  const std::string text = Check("other", {"--allow-scenario-change"}).out;
  EXPECT_THAT(text, Says("21 pairs with the baseline's trials (seed 1)\n", "records: changed"));
}

}  // namespace
}  // namespace rockyard::app

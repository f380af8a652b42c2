// rockyard replay

#include <algorithm>

#include "app/command.h"
#include "batch/forged_store.h"

namespace rockyard::app {
namespace {

using testing::ElementsAre;

class CliReplay : public CommandTest {
 protected:
  // Half a minute of simulated time: two scans.
  Words Trial(const Words& more) const {
    return With({"replay", Scenario("nominal"), "--trial", "1", "--set",
                 "rover.fidelity=quasi_static", "--set", "referee.time_limit_s=30"},
                more);
  }
};

TEST_F(CliReplay, ListsTheScansOfATrial) {
  const CommandResult result = RunTo(0, Trial({"--list"}));
  EXPECT_THAT(result.out, Says("scan     0   x   0.000 m", "2 scans; --scan N draws one of them"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliReplay, DrawsOneScan) {
  EXPECT_THAT(RunTo(0, Trial({"--scan", "1", "--out", "scan"})).out, HasSubstr("elevation [mm]"));
  // Two lasers at a time: three groups, of which the last holds the centre stripe alone.
  for (const char* stem :
       {"left-group0", "left-group1", "left-group2", "right-group0", "right-group1"}) {
    for (const char* what : {"lit", "dark", "difference"}) {
      EXPECT_THAT(ReadFile(work() / "scan" / (std::string(stem) + "-" + what + ".png")),
                  StartsWith("\x89PNG"))
          << stem << " " << what;
    }
  }
  EXPECT_FALSE(fs::exists(work() / "scan" / "right-group2-lit.png"));
  EXPECT_THAT(ReadFile(work() / "scan" / "array.svg"), HasSubstr("trial 1, scan 1</text>"));
  const std::string points = ReadFile(work() / "scan" / "points.csv");
  EXPECT_EQ(std::count(points.begin(), points.end(), '\n'), 21);
}

TEST_F(CliReplay, AStoredTrialComesOutTheSame) {
  RunTo(0, With(QuickRun("run", 2), {"--set", "referee.time_limit_s=30", "--quiet"}));
  for (const Words& how : {Words{}, Words{"--list"}}) {
    EXPECT_THAT(RunTo(0, With({"replay", "run", "--trial", "1"}, how)).out,
                HasSubstr("same as the stored record, bit for bit"));
  }
}

// Another trial than the stored one, as if a program had changed.
TEST_F(CliReplay, ATrialThatComesOutOtherwiseIsSaidOnThePageToo) {
  RunTo(0, With(QuickRun("run", 2), {"--set", "referee.time_limit_s=30", "--quiet"}));
  batch::Forge(work() / "run" / "results.sqlite",
               "UPDATE trials SET outcome = 'jammed' WHERE trial = 1");
  EXPECT_THAT(
      RunTo(1, {"replay", "run", "--trial", "1", "--out", "page.html", "--data", "page.json"}).err,
      HasSubstr("this trial is not the stored one"));
  EXPECT_THAT(ReadFile(work() / "page.json"), HasSubstr("\"repeats_stored\":false"));
}

TEST_F(CliReplay, WritesPagePlanAndData) {
  EXPECT_THAT(RunTo(0, Trial({"--out", "page.html", "--data", "data.json"})).out,
              HasSubstr("3-D replay in page.html"));
  EXPECT_THAT(ReadFile(work() / "page.html"), HasSubstr("<title>nominal, seed 1, trial 1"));
  EXPECT_THAT(ReadFile(work() / "page.svg"), HasSubstr("<title>goal</title>"));
  EXPECT_THAT(ReadFile(work() / "data.json"), StartsWith("{\"version\":1,"));
}

TEST_F(CliReplay, ChoosesNamesByItself) {
  RunTo(0, Trial({}));
  EXPECT_TRUE(fs::exists(work() / "results/runs/nominal-seed1-trial1.svg"));
  EXPECT_TRUE(fs::exists(work() / "results/runs/nominal-seed1-trial1.html"));
  RunTo(0, QuickRun("sub/run", 1));
  RunTo(0, {"replay", "sub/run/", "--trial", "0"});
  EXPECT_TRUE(fs::exists(work() / "sub/run-trial0.html"));
}

TEST_F(CliReplay, TwoTrialsStandOnOnePage) {
  RunTo(0, With(QuickRun("one", 3), {"--set", "referee.time_limit_s=30"}));
  RunTo(0, With(QuickRun("two", 3), {"--set", "referee.time_limit_s=20"}));
  const auto data = [&](const Words& with) {
    const CommandResult result = RunTo(
        0,
        With({"replay", "one", "--trial", "1", "--out", "both.html", "--data", "both.json"}, with));
    EXPECT_THAT(result.out, HasSubstr("same as the stored record, bit for bit"));
    return json::parse(ReadFile(work() / "both.json"));
  };
  const auto time_of = [](const json& drive) { return drive["motion"]["t"].back(); };
  EXPECT_TRUE(data({})["beside"].is_null());
  const auto same_trial = data({"--with", "two"});
  EXPECT_EQ(same_trial["beside"]["trial"], 1);
  EXPECT_LT(time_of(same_trial["beside"]), time_of(same_trial));
  EXPECT_EQ(same_trial["beside"]["repeats_stored"], true);
  const auto same_run = data({"--with-trial", "2"});
  EXPECT_EQ(same_run["beside"]["trial"], 2);
  EXPECT_EQ(same_run["beside"]["command"], "rockyard replay one --trial 2");
  EXPECT_EQ(data({"--with", "two", "--with-trial", "0"})["beside"]["trial"], 0);
}

// What is not the first trial is checked as well as that.
TEST_F(CliReplay, ASecondTrialThatIsNotThereWritesNothing) {
  RunTo(0, With(QuickRun("one", 2), {"--set", "referee.time_limit_s=30"}));
  RunTo(2, {"replay", "one", "--trial", "1", "--with-trial", "7"});
  RunTo(2, {"replay", "one", "--trial", "1", "--with", "three"});
  RunTo(2, {"replay", "one", "--trial", "1", "--with", "one", "--list"});
  EXPECT_FALSE(fs::exists(work() / "results"));
}

TEST_F(CliReplay, FilesThatCannotBeAreSaidBeforeTheDrive) {
  for (const Words& more : {Words{"--out", "none/page.html"},
                            {"--out", "page.pdf"},
                            {"--svg", "none/plan.svg"},
                            {"--out", "a.html", "--svg", "a.html"},
                            {"--svg", "a", "--data", "./a"},
                            {"--list", "--out", "a"},
                            {"--scan", "1", "--svg", "a.svg"}}) {
    EXPECT_EQ(Run(Trial(more)).exit_code, 2) << more.front();
    EXPECT_TRUE(NothingWritten()) << more.front();
  }
}

TEST_F(CliReplay, AStudyOfASensorHasNoCourse) {
  const CommandResult result =
      RunTo(2, {"replay", Source("scenarios/hazard_detection/false_alarm.json"), "--trial", "0"});
  EXPECT_THAT(result.err, Says("is no drive", "replay --list"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliReplay, AScanThatWasNotTakenIsSaid) {
  const CommandResult result = RunTo(2, Trial({"--scan", "99", "--out", "scan"}));
  EXPECT_THAT(result.err, Says("scan 99 does not occur in this trial", "the trial has 2 scans"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliReplay, PicturesOfTwoScansAreNotMixed) {
  fs::create_directories(work() / "scan");
  WriteFile(work() / "scan" / "array.svg", "");
  EXPECT_THAT(RunTo(2, Trial({"--scan", "1", "--out", "scan"})).err,
              HasSubstr("scan exists and is no empty folder"));
  RunTo(2, Trial({"--scan", "-1", "--out", "other"}));
}

// A study takes the sensor of each cell from its factors: the lasers of the first are the weakest.
TEST_F(CliReplay, ScansOfAStudyAreDrawnWithTheSensorOfTheirCell) {
  const std::string study = Source("scenarios/hazard_detection/false_alarm_image.json");
  const auto words = [&](const std::string& trial) {
    return Words{
        "replay", study, "--trial", trial,         "--set", "hazard_detection.scenes_per_run=1",
        "--scan", "0",   "--out",   "cell" + trial};
  };
  RunTo(0, words("0"));
  RunTo(0, words("14"));
  EXPECT_NE(ReadFile(work() / "cell0" / "left-group0-lit.png"),
            ReadFile(work() / "cell14" / "left-group0-lit.png"));
}

TEST_F(CliReplay, AFolderThatCannotBeMadeIsSaid) {
  WriteFile(work() / "file", "");
  EXPECT_THAT(RunTo(5, Trial({"--scan", "0", "--out", "file/scan"})).err, HasSubstr("--out"));
}

class CliReplayStep : public CommandTest {
 protected:
  // Four minutes of simulated time: some steps of a map-based navigator.
  Words Trial(const Words& more) const {
    return With({"replay", Source("scenarios/gestalt/viking_lander_2.json"), "--trial", "0",
                 "--set", "referee.time_limit_s=240"},
                more);
  }
};

TEST_F(CliReplayStep, ListsTheSteps) {
  const CommandResult result = RunTo(0, Trial({"--list"}));
  EXPECT_THAT(result.out,
              Says("step     0   x   0.000 m", "(vote ", "steps; --step N draws one of them"));
  EXPECT_THAT(result.out, Not(HasSubstr("scans")));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliReplayStep, DrawsOneStep) {
  RunTo(0, Trial({"--step", "2", "--out", "step"}));
  const std::string svg = ReadFile(work() / "step" / "step.svg");
  EXPECT_THAT(svg, HasSubstr("trial 0, step 2: forward"));
  // Both paths, the outline of the rover, cells of the grid in the view ahead; of some hundred
  // rocks.
  EXPECT_THAT(svg, Says("stroke=\"#b0005a\"", "<title>goal</title>", "left front camera",
                        "fill-opacity=\"0.55\""));
  EXPECT_LT(svg.size(), 400000u);
  const std::string votes = ReadFile(work() / "step" / "votes.csv");
  EXPECT_EQ(std::count(votes.begin(), votes.end(), '\n'), 1 + 23 + 23 + 2);
  const std::string map = ReadFile(work() / "step" / "map.csv");
  EXPECT_EQ(std::count(map.begin(), map.end(), '\n'), 1 + 50 * 50);
  const std::string points = ReadFile(work() / "step" / "points.csv");
  EXPECT_GT(std::count(points.begin(), points.end(), '\n'), 1000);
  EXPECT_TRUE(fs::exists(work() / "step" / "scenario.resolved.json"));
}

TEST_F(CliReplayStep, AStepThatDoesNotOccur) {
  EXPECT_THAT(RunTo(2, Trial({"--step", "99", "--out", "step"})).err,
              HasSubstr("step 99 does not occur in this trial"));
  EXPECT_TRUE(NothingWritten());
  RunTo(2, Trial({"--step", "1", "--scan", "1"}));
}

// rockyard run --traces

class CliTraces : public CommandTest {
 protected:
  Words Campaign(int trials, const Words& more) const {
    return With(QuickRun("run", trials), more);
  }

  Words Files(const std::string& folder = "run/traces") const {
    Words names;
    for (const auto& entry : fs::recursive_directory_iterator(work() / folder)) {
      if (entry.is_regular_file()) {
        names.push_back(fs::relative(entry.path(), work() / folder).string());
      }
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  // What the records of the run hash to.
  std::string Hash(const std::string& folder) const {
    const std::string summary = ReadFile(work() / folder / "summary.json");
    const std::size_t at = summary.find("\"trial_hash\"");
    return at == std::string::npos ? "" : summary.substr(at, 40);
  }
};

// Trials of one second reach no goal: all of them fail, at the time limit.
TEST_F(CliTraces, OfTheWorstTrials) {
  EXPECT_THAT(RunTo(0, Campaign(5, {"--traces", "worst:2"})).err,
              HasSubstr("2 traces written, in run/traces"));
  EXPECT_EQ(Files().size(), 2U);
  EXPECT_THAT(ReadFile(work() / "run/traces" / Files().front()), testing::StartsWith("PK"));
}

TEST_F(CliTraces, ChangeNoRecord) {
  RunTo(0, Campaign(4, {"--traces", "all", "--quiet"}));
  RunTo(0, With(QuickRun("plain", 4), {"--quiet"}));
  EXPECT_FALSE(Hash("run").empty());
  EXPECT_EQ(Hash("run"), Hash("plain"));
}

TEST_F(CliTraces, AsCsv) {
  RunTo(0, Campaign(2, {"--traces", "all", "--trace-format", "csv"}));
  EXPECT_THAT(Files(), ElementsAre("trial-000000.csv", "trial-000001.csv"));
  EXPECT_THAT(ReadFile(work() / "run/traces/trial-000001.csv"), HasSubstr("row,time_s,kind"));
}

TEST_F(CliTraces, ThoseThatAreThereAreKept) {
  RunTo(0, Campaign(3, {"--traces", "all"}));
  WriteFile(work() / "run/traces/trial-000001.npz", "mine");
  EXPECT_THAT(RunTo(0, Campaign(5, {"--traces", "all", "--resume", "--threads", "2"})).err,
              HasSubstr("2 traces written, 3 were there"));
  EXPECT_EQ(ReadFile(work() / "run/traces/trial-000001.npz"), "mine");
  EXPECT_EQ(Files().size(), 5U);
}

// The same file whatever wrote it: resumed or not, on one thread or on two, or the single command.
TEST_F(CliTraces, AreTheSameBytesWhateverWritesThem) {
  RunTo(0, Campaign(3, {"--traces", "all", "--threads", "2"}));
  RunTo(0, Campaign(3, {"--traces", "all", "--trace-format", "mcap", "--resume"}));
  const CommandResult one =
      RunTo(0, {"trace", "run", "--trial", "2", "--npz", "one.npz", "--mcap", "one.mcap"});
  EXPECT_THAT(one.out, Says("arrays for NumPy in one.npz", "readers of MCAP in one.mcap"));
  for (const std::string form : {"npz", "mcap"}) {
    const std::string bytes = ReadFile(work() / ("one." + form));
    EXPECT_FALSE(bytes.empty());
    EXPECT_EQ(bytes, ReadFile(work() / ("run/traces/trial-000002." + form))) << form;
  }
}

TEST_F(CliTraces, OfEveryCellOfASweep) {
  WriteFile(work() / "sweep.json",
            "{\"name\": \"s\", \"scenario\": \"" + Scenario("nominal") +
                "\", \"trials\": 2, \"axes\": [{\"path\": \"referee.time_limit_s\", "
                "\"values\": [1, 2]}]}");
  const CommandResult result =
      RunTo(0, {"sweep", "sweep.json", "--out", "run", "--traces", "worst:1"});
  const Words files = Files();
  ASSERT_EQ(files.size(), 2U);
  EXPECT_NE(fs::path(files[0]).parent_path(), fs::path(files[1]).parent_path());
}

TEST_F(CliTraces, ARuleThatIsNoneWritesNothing) {
  const CommandResult result = RunTo(2, Campaign(2, {"--traces", "worst:0", "--traces", "most"}));
  EXPECT_THAT(result.err, Says("--traces: \"worst:0\" is no rule", "\"most\" is no rule",
                               "use all, failures, worst:N"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliTraces, MeasurementsHaveNone) {
  const CommandResult result =
      RunTo(2, {"run", Source("scenarios/hazard_detection/false_alarm.json"), "--trials", "1",
                "--out", "run", "--traces", "all"});
  EXPECT_THAT(result.err, HasSubstr("--traces: needs drives"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliTraces, ADryRunSaysWhichAndWritesNothing) {
  EXPECT_THAT(
      RunTo(0, Campaign(20, {"--dry-run", "--traces", "failures", "--traces", "share:0.1"})).out,
      HasSubstr("traces of every failure, 10 % of all trials"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliTraces, AFolderThatCannotBeWrittenFailsAfterTheCampaign) {
  RunTo(0, Campaign(1, {"--quiet"}));
  WriteFile(work() / "run" / "traces", "a file");
  EXPECT_THAT(RunTo(5, Campaign(2, {"--resume", "--traces", "all"})).err,
              HasSubstr("error: run/traces: cannot be made"));
  EXPECT_FALSE(Hash("run").empty());
}

// Killed while it writes traces, whole files alone are there, and the next command writes the rest.
TEST_F(CliTraces, GoOnAfterTheyWereKilled) {
  // Trials of some tenths of a second each, so that there is time to kill between two of them.
  const Words words{
      "run", Scenario("nominal"), "--out", "run", "--trials", "6", "--traces", "all", "--threads",
      "1",   "--no-supervisor"};
  const pid_t process = Start(words);
  const fs::path second = work() / "run/traces/trial-000001.npz";
  WaitUntil([&] { return fs::exists(second) || !Alive(process); });
  kill(process, SIGKILL);
  Wait(process);
  ASSERT_TRUE(fs::exists(second)) << "ended before its second trace";
  const Words before = Files();
  RunTo(0, With(words, {"--resume"}));
  EXPECT_EQ(Files().size(), 6U) << "no temporary file is left";
  EXPECT_LT(before.size(), 6U);
  const CommandResult one = Run({"trace", "run", "--trial", "1", "--npz", "one.npz"});
  EXPECT_EQ(ReadFile(work() / "one.npz"), ReadFile(second));
}

}  // namespace
}  // namespace rockyard::app

// rockyard replay
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/command.h"
#include "batch/older_store.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

class CliReplay : public CommandTest {
 protected:
  // Half a minute of simulated time: two scans.
  std::vector<std::string> Trial(const std::vector<std::string>& more) const {
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
  ASSERT_EQ(
      Run(With(QuickRun("run", 2), {"--set", "referee.time_limit_s=30", "--quiet"})).exit_code, 0);
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{}, std::vector<std::string>{"--list"}}) {
    EXPECT_THAT(RunTo(0, With({"replay", "run", "--trial", "1"}, how)).out,
                HasSubstr("same as the stored record, bit for bit"));
  }
}

// Another trial than the stored one, as if a program had changed.
TEST_F(CliReplay, ATrialThatComesOutOtherwiseIsSaidOnThePageToo) {
  ASSERT_EQ(
      Run(With(QuickRun("run", 2), {"--set", "referee.time_limit_s=30", "--quiet"})).exit_code, 0);
  batch::MakeOlder(work() / "run" / "results.sqlite",
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
}

TEST_F(CliReplay, TwoTrialsStandOnOnePage) {
  ASSERT_EQ(Run(With(QuickRun("one", 3), {"--set", "referee.time_limit_s=30"})).exit_code, 0);
  ASSERT_EQ(Run(With(QuickRun("two", 3), {"--set", "referee.time_limit_s=20"})).exit_code, 0);
  const auto data = [&](const std::vector<std::string>& with) {
    const CommandResult result = RunTo(
        0,
        With({"replay", "one", "--trial", "1", "--out", "both.html", "--data", "both.json"}, with));
    EXPECT_THAT(result.out, HasSubstr("same as the stored record, bit for bit"));
    return nlohmann::json::parse(ReadFile(work() / "both.json"));
  };
  const auto time_of = [](const nlohmann::json& drive) { return drive["motion"]["t"].back(); };
  const auto alone = data({});
  EXPECT_TRUE(alone["beside"].is_null());
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
  ASSERT_EQ(Run(With(QuickRun("one", 2), {"--set", "referee.time_limit_s=30"})).exit_code, 0);
  RunTo(2, {"replay", "one", "--trial", "1", "--with-trial", "7"});
  RunTo(2, {"replay", "one", "--trial", "1", "--with", "three"});
  RunTo(2, {"replay", "one", "--trial", "1", "--with", "one", "--list"});
  EXPECT_FALSE(fs::exists(work() / "results"));
}

TEST_F(CliReplay, FilesThatCannotBeAreSaidBeforeTheDrive) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--out", "none/page.html"},
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
      RunTo(2, {"replay",
                std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/hazard_detection/false_alarm.json",
                "--trial", "0"});
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
  const std::string study =
      std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/hazard_detection/false_alarm_image.json";
  const auto words = [&](const std::string& trial) {
    return std::vector<std::string>{
        "replay", study, "--trial", trial,         "--set", "hazard_detection.scenes_per_run=1",
        "--scan", "0",   "--out",   "cell" + trial};
  };
  ASSERT_EQ(Run(words("0")).exit_code, 0);
  ASSERT_EQ(Run(words("14")).exit_code, 0);
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
  std::vector<std::string> Trial(const std::vector<std::string>& more) const {
    return With(
        {"replay", std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/gestalt/viking_lander_2.json",
         "--trial", "0", "--set", "referee.time_limit_s=240"},
        more);
  }
};

TEST_F(CliReplayStep, ListsTheSteps) {
  const CommandResult result = RunTo(0, Trial({"--list"}));
  EXPECT_THAT(result.out,
              Says("step     0   x   0.000 m", "(vote ", "steps; --step N draws one of them"));
  EXPECT_THAT(result.out, testing::Not(HasSubstr("scans")));
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

}  // namespace
}  // namespace rockyard::app

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
  const CommandResult result = Run(Trial({"--list"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("scan     0   x   0.000 m"));
  EXPECT_THAT(result.out, HasSubstr("2 scans; --scan N draws one of them"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliReplay, DrawsOneScan) {
  const CommandResult result = Run(Trial({"--scan", "1", "--out", "scan"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("elevation [mm]"));
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
    const CommandResult result = Run(With({"replay", "run", "--trial", "1"}, how));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("same as the stored record, bit for bit"));
  }
}

// Another trial than the stored one, as if a program had changed.
TEST_F(CliReplay, ATrialThatComesOutOtherwiseIsSaidOnThePageToo) {
  ASSERT_EQ(
      Run(With(QuickRun("run", 2), {"--set", "referee.time_limit_s=30", "--quiet"})).exit_code, 0);
  batch::MakeOlder(work() / "run" / "results.sqlite",
                   "UPDATE trials SET outcome = 'jammed' WHERE trial = 1");
  const CommandResult result =
      Run({"replay", "run", "--trial", "1", "--out", "page.html", "--data", "page.json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("this trial is not the stored one"));
  EXPECT_THAT(ReadFile(work() / "page.json"), HasSubstr("\"repeats_stored\":false"));
}

TEST_F(CliReplay, WritesPagePlanAndData) {
  const CommandResult result = Run(Trial({"--out", "page.html", "--data", "data.json"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("3-D replay in page.html"));
  EXPECT_THAT(ReadFile(work() / "page.html"), HasSubstr("<title>nominal, seed 1, trial 1"));
  EXPECT_THAT(ReadFile(work() / "page.svg"), HasSubstr("<title>goal</title>"));
  EXPECT_THAT(ReadFile(work() / "data.json"), StartsWith("{\"version\":1,"));
}

TEST_F(CliReplay, ChoosesNamesByItself) {
  const CommandResult result = Run(Trial({}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(fs::exists(work() / "results/runs/nominal-seed1-trial1.svg"));
  EXPECT_TRUE(fs::exists(work() / "results/runs/nominal-seed1-trial1.html"));
}

TEST_F(CliReplay, TwoTrialsStandOnOnePage) {
  ASSERT_EQ(Run(With(QuickRun("one", 3), {"--set", "referee.time_limit_s=30"})).exit_code, 0);
  ASSERT_EQ(Run(With(QuickRun("two", 3), {"--set", "referee.time_limit_s=20"})).exit_code, 0);
  const auto data = [&](const std::vector<std::string>& with) {
    const CommandResult result = Run(
        With({"replay", "one", "--trial", "1", "--out", "both.html", "--data", "both.json"}, with));
    EXPECT_EQ(result.exit_code, 0) << result.err;
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
  EXPECT_EQ(Run({"replay", "one", "--trial", "1", "--with-trial", "7"}).exit_code, 2);
  EXPECT_EQ(Run({"replay", "one", "--trial", "1", "--with", "three"}).exit_code, 2);
  const CommandResult list = Run({"replay", "one", "--trial", "1", "--with", "one", "--list"});
  EXPECT_EQ(list.exit_code, 2);
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
  const CommandResult result = Run(
      {"replay", std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/hazard_detection/false_alarm.json",
       "--trial", "0"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("is no drive"));
  EXPECT_THAT(result.err, HasSubstr("replay --list"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliReplay, AScanThatWasNotTakenIsSaid) {
  const CommandResult result = Run(Trial({"--scan", "99", "--out", "scan"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("scan 99 does not occur in this trial"));
  EXPECT_THAT(result.err, HasSubstr("the trial has 2 scans"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliReplay, PicturesOfTwoScansAreNotMixed) {
  fs::create_directories(work() / "scan");
  WriteFile(work() / "scan" / "array.svg", "");
  const CommandResult result = Run(Trial({"--scan", "1", "--out", "scan"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("scan exists and is no empty folder"));
  EXPECT_EQ(Run(Trial({"--scan", "-1", "--out", "other"})).exit_code, 2);
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
  const CommandResult result = Run(Trial({"--scan", "0", "--out", "file/scan"}));
  EXPECT_EQ(result.exit_code, 5) << result.err;
  EXPECT_THAT(result.err, HasSubstr("--out"));
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
  const CommandResult result = Run(Trial({"--list"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("step     0   x   0.000 m"));
  EXPECT_THAT(result.out, HasSubstr("(vote "));
  EXPECT_THAT(result.out, HasSubstr("steps; --step N draws one of them"));
  EXPECT_THAT(result.out, testing::Not(HasSubstr("scans")));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliReplayStep, DrawsOneStep) {
  const CommandResult result = Run(Trial({"--step", "2", "--out", "step"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string svg = ReadFile(work() / "step" / "step.svg");
  EXPECT_THAT(svg, HasSubstr("trial 0, step 2: forward"));
  // Both paths, the outline of the rover, cells of the grid in the view ahead; of some hundred
  // rocks.
  EXPECT_THAT(svg, HasSubstr("stroke=\"#b0005a\""));
  EXPECT_THAT(svg, HasSubstr("<title>goal</title>"));
  EXPECT_THAT(svg, HasSubstr("left front camera"));
  EXPECT_THAT(svg, HasSubstr("fill-opacity=\"0.55\""));
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
  const CommandResult result = Run(Trial({"--step", "99", "--out", "step"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("step 99 does not occur in this trial"));
  EXPECT_TRUE(NothingWritten());
  EXPECT_EQ(Run(Trial({"--step", "1", "--scan", "1"})).exit_code, 2);
}

}  // namespace
}  // namespace rockyard::app

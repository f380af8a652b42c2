// rockyard run --traces
#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <string>
#include <vector>

#include "app/command.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class CliTraces : public CommandTest {
 protected:
  std::vector<std::string> Campaign(int trials, const std::vector<std::string>& more) const {
    return With(QuickRun("run", trials), more);
  }

  std::vector<std::string> Files(const std::string& folder = "run/traces") const {
    std::vector<std::string> names;
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
  ASSERT_EQ(Run(Campaign(4, {"--traces", "all", "--quiet"})).exit_code, 0);
  ASSERT_EQ(Run(With(QuickRun("plain", 4), {"--quiet"})).exit_code, 0);
  EXPECT_FALSE(Hash("run").empty());
  EXPECT_EQ(Hash("run"), Hash("plain"));
}

TEST_F(CliTraces, AsCsv) {
  ASSERT_EQ(Run(Campaign(2, {"--traces", "all", "--trace-format", "csv"})).exit_code, 0);
  EXPECT_THAT(Files(), ElementsAre("trial-000000.csv", "trial-000001.csv"));
  EXPECT_THAT(ReadFile(work() / "run/traces/trial-000001.csv"), HasSubstr("row,time_s,kind"));
}

TEST_F(CliTraces, ThoseThatAreThereAreKept) {
  ASSERT_EQ(Run(Campaign(3, {"--traces", "all"})).exit_code, 0);
  WriteFile(work() / "run/traces/trial-000001.npz", "mine");
  EXPECT_THAT(RunTo(0, Campaign(5, {"--traces", "all", "--resume", "--threads", "2"})).err,
              HasSubstr("2 traces written, 3 were there"));
  EXPECT_EQ(ReadFile(work() / "run/traces/trial-000001.npz"), "mine");
  EXPECT_EQ(Files().size(), 5U);
}

// The same file whatever wrote it: resumed or not, on one thread or on two, or the single command.
TEST_F(CliTraces, AreTheSameBytesWhateverWritesThem) {
  ASSERT_EQ(Run(Campaign(3, {"--traces", "all", "--threads", "2"})).exit_code, 0);
  const CommandResult one = RunTo(0, {"trace", "run", "--trial", "2", "--npz", "one.npz"});
  EXPECT_THAT(one.out, HasSubstr("arrays for NumPy in one.npz"));
  EXPECT_EQ(ReadFile(work() / "one.npz"), ReadFile(work() / "run/traces/trial-000002.npz"));
}

TEST_F(CliTraces, OfEveryCellOfASweep) {
  WriteFile(work() / "sweep.json",
            "{\"name\": \"s\", \"scenario\": \"" + Scenario("nominal") +
                "\", \"trials\": 2, \"axes\": [{\"path\": \"referee.time_limit_s\", "
                "\"values\": [1, 2]}]}");
  const CommandResult result = Run({"sweep", "sweep.json", "--out", "run", "--traces", "worst:1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::string> files = Files();
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
  const CommandResult result = RunTo(
      2, {"run", std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/hazard_detection/false_alarm.json",
          "--trials", "1", "--out", "run", "--traces", "all"});
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
  ASSERT_EQ(Run(Campaign(1, {"--quiet"})).exit_code, 0);
  WriteFile(work() / "run" / "traces", "a file");
  EXPECT_THAT(RunTo(5, Campaign(2, {"--resume", "--traces", "all"})).err,
              HasSubstr("error: run/traces: cannot be made"));
  EXPECT_FALSE(Hash("run").empty());
}

// Killed while it writes traces, whole files alone are there, and the next command writes the rest.
TEST_F(CliTraces, GoOnAfterTheyWereKilled) {
  // Trials of some tenths of a second each, so that there is time to kill between two of them.
  const std::vector<std::string> words{
      "run", Scenario("nominal"), "--out", "run", "--trials", "6", "--traces", "all", "--threads",
      "1",   "--no-supervisor"};
  const pid_t process = Start(words);
  const fs::path second = work() / "run/traces/trial-000001.npz";
  WaitUntil([&] { return fs::exists(second) || !Alive(process); });
  kill(process, SIGKILL);
  Wait(process);
  ASSERT_TRUE(fs::exists(second)) << "ended before its second trace";
  const std::vector<std::string> before = Files();
  RunTo(0, With(words, {"--resume"}));
  const std::vector<std::string> files = Files();
  EXPECT_EQ(files.size(), 6U) << "no temporary file is left";
  EXPECT_LT(before.size(), 6U);
  const CommandResult one = Run({"trace", "run", "--trial", "1", "--npz", "one.npz"});
  EXPECT_EQ(ReadFile(work() / "one.npz"), ReadFile(second));
}

}  // namespace
}  // namespace rockyard::app

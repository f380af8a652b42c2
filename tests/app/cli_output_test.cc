// Standard output that takes nothing, and one that nobody reads; files that may not be written.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "app/command.h"
#include "core/count_of.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr const char* kLost = "error: standard output: cannot be written: No space left on device";

class OutputTest : public CommandTest {
 protected:
  OutputTest() : full_(open("/dev/full", O_WRONLY | O_CLOEXEC)) {
    std::array<int, 2> ends{};
    EXPECT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
    close(ends[0]);
    unread_ = ends[1];
  }
  ~OutputTest() override {
    close(full_);
    close(unread_);
  }

  // One of each kind of text on standard output, and every subcommand that needs no run.
  static std::vector<Words> Commands() {
    return {{"--help"},
            {"--version"},
            {"run", "--help"},
            {"list", std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/pathfinder"},
            {"list", "--ablations", "--json"},
            {"defaults"},
            {"schema"},
            {"parameters"},
            {"parameters", "--csv"},
            {"metrics"},
            {"completion", "bash"},
            {"plan", "claim", "--below", "0.1"},
            {"plan", "claim", "--below", "0.1", "--json"},
            {"validate", Scenario("nominal")},
            {"rover", Scenario("nominal")},
            {"terrain", Scenario("nominal"), "--density", "--fields", "1"},
            With(QuickRun("dry", 1), {"--dry-run"})};
  }

  int full_;
  int unread_;  // a pipe whose reader has gone
};

std::string Joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += word + " ";
  return text;
}

TEST_F(OutputTest, ThatIsFullEndsEveryCommandWithFive) {
  for (const Words& words : Commands()) {
    const CommandResult told = RunInto(full_, words);
    EXPECT_EQ(told.exit_code, 5) << Joined(words);
    EXPECT_EQ(core::CountOf(told.err, kLost), 1) << Joined(words) << told.err;
  }
}

TEST_F(OutputTest, ThatNobodyReadsIsNoFailure) {
  for (const Words& words : Commands()) {
    const CommandResult told = RunInto(unread_, words);
    EXPECT_EQ(told.exit_code, 0) << Joined(words);
    EXPECT_EQ(told.err, "") << Joined(words);
  }
}

TEST_F(OutputTest, ThatIsClosedIsAFailureWhereSomethingIsSaid) {
  const CommandResult told = RunInto(kClosed, {"list", "--ablations"});
  EXPECT_EQ(told.exit_code, 5);
  EXPECT_NE(told.err.find("standard output: cannot be written"), std::string::npos) << told.err;
  EXPECT_EQ(RunInto(kClosed, With(QuickRun("quiet", 1), {"--quiet"})).exit_code, 0);
}

// The number of the closed stream would be that of the first file to be opened.
TEST_F(OutputTest, ThatIsClosedGetsIntoNoFile) {
  ASSERT_EQ(RunInto(kClosed, QuickRun("closed", 2)).exit_code, 5);
  ASSERT_EQ(Run(QuickRun("open", 2)).exit_code, 0);
  for (const char* name : {"trials.csv", "scenario.resolved.json", "distance_cdf.csv"}) {
    EXPECT_EQ(ReadFile(work() / "closed" / name), ReadFile(work() / "open" / name)) << name;
  }
}

TEST_F(OutputTest, BadInputSaysMoreThanAFullDisk) {
  EXPECT_EQ(RunInto(full_, {"validate", Scenario("nominal"), "no-such-file.json"}).exit_code, 2);
}

TEST_F(OutputTest, ThatIsFullLosesNoTrialOfARunAndNoTrace) {
  for (const Words& how : {Words{}, Words{"--json"}, Words{"--no-supervisor"}}) {
    const std::string folder = "full" + Joined(how);
    const CommandResult told =
        RunInto(full_, With(With(QuickRun(folder, 2), {"--traces", "all"}), how));
    EXPECT_EQ(told.exit_code, 5) << Joined(how);
    EXPECT_NE(told.err.find(kLost), std::string::npos) << told.err;
    EXPECT_TRUE(fs::exists(work() / folder / "summary.json")) << Joined(how);
    EXPECT_EQ(told.err.find("crashed"), std::string::npos) << told.err;
    const CommandResult again =
        RunTo(0, With(With(QuickRun(folder, 2), {"--traces", "all", "--resume"}), how));
    EXPECT_NE(again.err.find("0 traces written, 2 were there"), std::string::npos)
        << "all were written the first time: " << again.err;
  }
}

TEST_F(OutputTest, ThatNobodyReadsLosesNoTrialOfARunAndNoTrace) {
  const CommandResult told = RunInto(unread_, With(QuickRun("run", 2), {"--traces", "all"}));
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_EQ(told.err.find("error"), std::string::npos) << told.err;
  EXPECT_TRUE(fs::exists(work() / "run" / "summary.json"));
}

TEST_F(OutputTest, OfASweepAndOfARunThatIsLookedAtAgain) {
  WriteFile(work() / "sweep.json",
            R"({"name": "two", "scenario": ")" + Scenario("nominal") +
                R"(", "trials": 1, "seed": 1,)" +
                R"( "axes": [{"path": "referee.time_limit_s", "values": [1, 2]}]})");
  ASSERT_EQ(Run(QuickRun("run", 2)).exit_code, 0);
  const std::vector<Words> commands = {{"trace", "run", "--trial", "0", "--csv", "trace.csv"},
                                       {"replay", "run", "--trial", "0", "--list"},
                                       {"compare", "run", "run"},
                                       {"compare", "run", "run", "--json"},
                                       {"sweep", "sweep.json", "--dry-run", "--pilots", "0"}};
  for (const Words& words : commands) {
    EXPECT_EQ(RunInto(full_, words).exit_code, 5) << Joined(words);
    EXPECT_EQ(RunInto(unread_, words).exit_code, 0) << Joined(words);
  }
  EXPECT_TRUE(fs::exists(work() / "trace.csv")) << "what is asked for elsewhere is written";
}

TEST_F(OutputTest, BeyondALimitOnFilesIsAFailureToo) {
  const rlimit former = [] {
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlimit small{100, limit.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    return limit;
  }();
  const CommandResult told = Run({"list", "--ablations"});
  setrlimit(RLIMIT_FSIZE, &former);
  EXPECT_EQ(told.exit_code, 5);
}

// By their names, by links, by the names of scenarios, and in the folders of runs.
TEST_F(OutputTest, IsNeverAnInput) {
  fs::create_directory(work() / "scenarios");
  fs::copy_file(Scenario("nominal"), work() / "scenarios/mine.json");
  WriteFile(work() / "scenarios/base.json", "{}");
  WriteFile(work() / "scenarios/far.json", R"({"trials": 2})");
  WriteFile(work() / "scenarios/near.json", R"({"extends": "far.json"})");
  WriteFile(work() / "heir.json", R"({"rover": {"extends": "scenarios/near.json"}})");
  fs::create_symlink("scenarios/mine.json", work() / "link.json");
  RunTo(0, QuickRun("run", 1));
  RunTo(0, {"baseline", "run", "--reason", "a test", "--out", "base.json"});
  const std::vector<Words> commands = {
      {"terrain", "scenarios/mine.json", "--out", "scenarios/mine.json"},
      {"terrain", "mine", "--out", "link.json"},
      {"terrain", "heir.json", "--out", "scenarios/near.json"},
      {"terrain", "heir.json", "--out", "scenarios/far.json"},
      {"rover", "mine", "--out", "scenarios/../scenarios/mine.json"},
      {"trace", "run", "--trial", "0", "--csv", "run/trials.csv"},
      {"trace", "link.json", "--trial", "0", "--svg", "link.json"},
      {"replay", "run", "--trial", "0", "--data", "run/results.sqlite"},
      {"report", "run", "--out", "page.html", "--data", "./run/summary.json"},
      {"compare", "run", "run", "--csv", "run/trials.csv"},
      {"check", "run", "--against", "base.json", "--junit", "base.json"}};
  for (const Words& words : commands) {
    const std::string before = ReadFile(work() / words.back());
    EXPECT_THAT(RunTo(2, words).err, testing::ContainsRegex("error: --[a-z]+: is .*, which is read|"
                                                            "is a file of the run itself"));
    EXPECT_EQ(ReadFile(work() / words.back()), before) << Joined(words);
  }
  RunTo(0, {"terrain", "mine", "--out", "scenarios/base.json"});
  RunTo(0, {"trace", "run", "--trial", "0", "--csv", "run/trial.csv"});
}

}  // namespace
}  // namespace rockyard::app

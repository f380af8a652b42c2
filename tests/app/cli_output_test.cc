// Standard output that takes nothing, and one that nobody reads; files that may not be written.
#include <sys/resource.h>

#include <array>

#include "app/command.h"
#include "core/count_of.h"

namespace rockyard::app {
namespace {

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
            {"list", Source("scenarios/pathfinder")},
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
  RunTo(0, QuickRun("open", 2));
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
  RunTo(0, QuickRun("run", 2));
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
      {"trace", "mine", "--trial", "0", "--npz", "scenarios/mine.json"},
      {"trace", "mine", "--trial", "0", "--mcap", "scenarios/mine.json"},
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

// What programs get: one JSON object on standard output.

class CliJson : public CommandTest {
 protected:
  // Nothing but the object, and the same exit code as without.
  json Told(const Words& words, int exit_code) const {
    const CommandResult result = Run(With(words, {"--json"}));
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    const json object = json::parse(result.out, nullptr, false);
    EXPECT_TRUE(object.is_object()) << result.out;
    return object;
  }
};

TEST_F(CliJson, ComparisonOfDrives) {
  RunTo(0, QuickRun("a", 4));
  RunTo(0, With(QuickRun("b", 4), {"--set", "course.goal_radius_m=0.7"}));
  const json told = Told({"compare", "a", "b"}, 0);
  EXPECT_EQ(told["schema_version"], 1);
  EXPECT_EQ(told["kind"], "drive_comparison");
  const json& comparison = told["comparison"];
  EXPECT_EQ(comparison["paired"], true);
  EXPECT_EQ(comparison["pairs"], 4);
  EXPECT_EQ(comparison["settings"][0]["path"], "course.goal_radius_m");
  EXPECT_EQ(comparison["successes"].size(), 2u);
  EXPECT_FALSE(comparison["columns"].empty());
}

TEST_F(CliJson, ComparisonOfMeasurements) {
  for (const char* out : {"a", "b"}) {
    RunTo(0, {"run", Source("scenarios/hazard_detection/detection.json"), "--trials", "2", "--out",
              out, "--set", "hazard_detection.scenes_per_run=5"});
  }
  const json told = Told({"compare", "a", "b"}, 0);
  EXPECT_EQ(told["kind"], "cell_comparison");
  EXPECT_EQ(told["exit_code"], 0);
  EXPECT_FALSE(told["cells"].empty());
  EXPECT_EQ(told["cells"][0]["rates"][0]["differs"], false);
}

TEST_F(CliJson, CheckAgainstPublishedValues) {
  RunTo(0, QuickRun("a", 3));
  const Words words = {"check",        "a",
                       "--against",    Source("results/reference/matthies1995.json"),
                       "--replicates", "200"};
  const int code = Run(words).exit_code;
  const json told = Told(words, code);
  EXPECT_EQ(told["kind"], "published_check");
  EXPECT_EQ(told["exit_code"], code);
  bool found = false;
  for (const json& value : told["values"]) {
    if (value["id"] != "nominal.distance.min") continue;
    found = true;
    EXPECT_EQ(value["published"], 7.0);
    EXPECT_EQ(value["simulated_runs"], 3);
    EXPECT_TRUE(value["verdict"].is_string());
  }
  EXPECT_TRUE(found);
}

TEST_F(CliJson, CheckAgainstABaseline) {
  RunTo(0, QuickRun("a", 5));
  RunTo(0, {"baseline", "a", "--out", "base.json", "--reason", "test"});
  const json told = Told({"check", "a", "--against", "base.json"}, 0);
  EXPECT_EQ(told["kind"], "baseline_check");
  EXPECT_EQ(told["exit_code"], 0);
  EXPECT_EQ(told["cells"][0]["identical"], true);
  for (const json& metric : told["metrics"]) EXPECT_EQ(metric["verdict"], "equivalent");
  EXPECT_FALSE(told["metrics"].empty());
}

TEST_F(CliJson, EveryCommandOfPeopleHasAFormForPrograms) {
  for (const char* command : {"run", "sweep", "merge", "check", "compare", "list"}) {
    EXPECT_THAT(Run({command, "--help"}).out, HasSubstr("--json")) << command;
  }
}

}  // namespace
}  // namespace rockyard::app

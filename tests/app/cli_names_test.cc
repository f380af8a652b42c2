// Scenarios and sweeps by name, and folders of runs where a run is meant.
#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "app/command.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class CliNames : public CommandTest {
 protected:
  void SetUp() override { unsetenv("ROCKYARD_SCENARIOS"); }
  void TearDown() override { unsetenv("ROCKYARD_SCENARIOS"); }

  // A valid scenario of that name.
  void Place(const std::string& path) const {
    const fs::path file = work() / path;
    fs::create_directories(file.parent_path());
    WriteFile(file, "{\"name\": \"" + file.stem().string() + "\"}");
  }
};

TEST_F(CliNames, StandForFilesWhereAFileIsTaken) {
  Place("scenarios/a/one.json");
  WriteFile(work() / "scenarios/grid.json",
            R"({"name": "grid", "scenario": "a/one.json", "trials": 1, "seed": 1,
                "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.002]}]})");
  EXPECT_THAT(
      Run({"validate", "one", "a/one", "one.json", "scenarios/a/one", "grid"}).out,
      Says("scenarios/a/one.json: valid", "scenarios/grid.json: valid, a sweep of 2 cells"));
  EXPECT_THAT(Run({"rover", "one"}).out, HasSubstr("rover of one"));
  RunTo(0, {"terrain", "one", "--out", "field.svg"});
  RunTo(0, {"parameters", "one"});
  RunTo(0, {"sweep", "grid", "--dry-run", "--pilots", "0"});
  RunTo(0, {"trace", "one", "--trial", "0", "--set", "referee.time_limit_s=1"});
  RunTo(0, {"run", "one", "--trials", "1", "--set", "referee.time_limit_s=1"});
}

TEST_F(CliNames, OfTwoFilesNameBoth) {
  Place("scenarios/a/same.json");
  Place("scenarios/b/same.json");
  Place("scenarios/b/a/same.json");
  EXPECT_THAT(RunTo(2, {"validate", "same"}).err,
              Says("error: same: is the name of 3 files", "say which: a/same, b/a/same, b/same"));
  EXPECT_THAT(Run({"validate", "a/same"}).out, HasSubstr("scenarios/a/same.json: valid"))
      << "the path from the folder itself goes first";
}

TEST_F(CliNames, AFileOfThatNameWins) {
  Place("scenarios/a/one.json");
  Place("one");
  EXPECT_THAT(Run({"validate", "one"}).out, HasSubstr("one: valid"));
  EXPECT_THAT(Run({"validate", "one"}).out, Not(HasSubstr("scenarios")));
}

// A run under the name of a scenario does not change in silence what the name means.
TEST_F(CliNames, TheFolderOfARunIsToldOf) {
  Place("scenarios/a/one.json");
  const std::vector<std::string> words{"run", "one", "--trials", "1", "--threads", "1"};
  const CommandResult first =
      RunTo(0, With(words, {"--set", "referee.time_limit_s=1", "--out", "one"}));
  EXPECT_THAT(first.out + first.err, Not(HasSubstr("the folder of a run")));
  const CommandResult second = RunTo(0, With(words, {"--out", "two"}));
  EXPECT_THAT(second.out + second.err,
              HasSubstr("one is the folder of a run, whose settings are taken"));
}

TEST_F(CliNames, KindsThatAreNotWantedDoNotCount) {
  Place("scenarios/a/both.json");
  WriteFile(work() / "scenarios/both.json",
            R"({"name": "both", "scenario": "a/both.json", "trials": 1, "seed": 1,
                "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001]}]})");
  EXPECT_THAT(Run({"rover", "a/both"}).out, HasSubstr("rover of both"));
  RunTo(0, {"terrain", "a/both", "--out", "field.svg"});
  RunTo(0, {"sweep", "both", "--dry-run", "--pilots", "0"});
  RunTo(2, {"sweep", "a/both", "--dry-run", "--pilots", "0"});
}

TEST_F(CliNames, MistypedOnesGetASuggestion) {
  Place("scenarios/a/first_try.json");
  for (const char* word : {"frist_try", "first_tri", "a/first_trx.json"}) {
    EXPECT_THAT(RunTo(2, {"run", word}).err, HasSubstr("did you mean \"first_try\"?")) << word;
  }
  EXPECT_THAT(Run({"run", "scenarios/a/frist_try.json"}).err,
              HasSubstr("did you mean \"scenarios/a/first_try.json\"?"));
  EXPECT_THAT(Run({"run", "something_else_altogether"}).err, Not(HasSubstr("did you mean")));
  EXPECT_FALSE(fs::exists(work() / "results"));
}

TEST_F(CliNames, FoldersAreTakenInOrder) {
  EXPECT_THAT(Run({"validate", "nominal"}).out,
              HasSubstr("/scenarios/pathfinder/nominal.json: valid"))
      << "those of the source tree, from any folder";
  EXPECT_THAT(Run({"list"}).out, HasSubstr("/scenarios/pathfinder\n"));
  Place("scenarios/one.json");
  EXPECT_THAT(Run({"validate", "one"}).out, HasSubstr("scenarios/one.json: valid"));
  RunTo(2, {"validate", "nominal"});
  Place("mine/two.json");
  setenv("ROCKYARD_SCENARIOS", "mine", 1);
  EXPECT_THAT(Run({"list"}).out, HasSubstr("two.json"));
  EXPECT_THAT(Run({"validate", "two"}).out, HasSubstr("mine/two.json: valid"));
  RunTo(2, {"validate", "one"});
}

TEST_F(CliNames, InstalledProgramsFindTheShareFolder) {
  fs::create_directories(work() / "bin");
  fs::create_directories(work() / "elsewhere");
  fs::copy_file(ROCKYARD_COMMAND, work() / "bin/rockyard");
  Place("share/rockyard/scenarios/one.json");
  const CommandResult result =
      Wait(StartProgram({(work() / "bin/rockyard").string(), "validate", "one"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("/share/rockyard/scenarios/one.json: valid"));
}

TEST_F(CliNames, AFolderOfRunsListsThem) {
  ASSERT_EQ(Run(QuickRun("runs/a", 2)).exit_code, 0);
  ASSERT_EQ(Run(With(QuickRun("runs/b", 3), {"--set", "name=other"})).exit_code, 0);
  fs::last_write_time(work() / "runs/a/results.sqlite",
                      fs::file_time_type::clock::now() - std::chrono::hours(1000));
  for (const std::vector<std::string>& words : {std::vector<std::string>{"report", "runs"},
                                                {"trace", "runs", "--trial", "0"},
                                                {"replay", "runs", "--trial", "0"},
                                                {"compare", "runs/a", "runs"},
                                                {"run", "runs"}}) {
    const CommandResult result = Run(words);
    EXPECT_EQ(result.exit_code, 2) << words[0];
    EXPECT_THAT(result.err, testing::ContainsRegex("runs/b .other, 3 trials, 20..-..-...; runs/a "
                                                   ".nominal, 2 trials, 20..-..-...\n"))
        << words[0];
  }
  for (int i = 0; i < 10; ++i) fs::copy(work() / "runs/a", work() / ("runs/c" + std::to_string(i)));
  EXPECT_THAT(Run({"report", "runs"}).err, HasSubstr("; and 2 more\n"));
}

}  // namespace
}  // namespace rockyard::app

// What holds for options of every command, and for the lines that commands print.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/command.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class CliOptions : public CommandTest {
 protected:
  void ExpectRefused(const std::vector<std::string>& words, const std::string& where) {
    const CommandResult result = Run(words);
    SCOPED_TRACE(testing::PrintToString(words));
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, Says(where, "  try: "));
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(NothingWritten());
  }

  std::set<std::string> FilesIn(const std::string& folder) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(work() / folder)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
};

TEST_F(CliOptions, NoNumberIsNanOrInfinite) {
  const std::string nominal = Scenario("nominal");
  for (const char* wrong : {"nan", "NaN", "-nan", "inf", "-inf", "1e999"}) {
    for (const char* option : {"--until-half-width", "--max-faults", "--trial-cpu-limit"}) {
      ExpectRefused({"run", nominal, "--out", "a", option, wrong}, option);
      ExpectRefused({"sweep", "a.json", option, wrong}, option);
    }
    ExpectRefused({"plan", "half-width", "--half-width", wrong}, "--half-width");
    ExpectRefused({"plan", "half-width", "--half-width", "0.1", "--rate", wrong}, "--rate");
    ExpectRefused({"plan", "claim", "--below", wrong}, "--below");
    ExpectRefused({"plan", "claim", "--below", "0.1", "--confidence", wrong}, "--confidence");
    ExpectRefused({"plan", "difference", "--from", "0.1", "--to", "0.2", "--discordant", wrong},
                  "--discordant");
    ExpectRefused({"plan", "equivalence", "--deviation", "1", "--margin", wrong}, "--margin");
    ExpectRefused({"check", "a", "--against", "b", "--alpha", wrong}, "--alpha");
    ExpectRefused({"check", "a", "--against", "b", "--equivalence-alpha", wrong},
                  "--equivalence-alpha");
    ExpectRefused({"terrain", nominal, "--blind-swath", "--width", wrong}, "--width");
    ExpectRefused({"replay", nominal, "--trial", "0", "--step", wrong}, "--step");
  }
  EXPECT_EQ(Run({"plan", "half-width", "--half-width", "0.1", "--rate", "0.3"}).exit_code, 0)
      << "finite numbers are taken";
}

TEST_F(CliOptions, NoValueIsEmpty) {
  const std::string nominal = Scenario("nominal");
  for (const char* option : {"--trials", "--out", "--seed", "--shard", "--set", "--threads"}) {
    ExpectRefused({"run", nominal, option, ""}, option);
    ExpectRefused({"sweep", "a.json", option, ""}, option);
  }
  ExpectRefused({"run", ""}, "SCENARIO");
  ExpectRefused({"merge", "a", "--out", ""}, "--out");
  ExpectRefused({"check", "a", "--against", ""}, "--against");
}

// What is cut off is no answer: programs must see that too.
TEST_F(CliOptions, ASearchThatWasCutOffSaysSo) {
  const std::vector<std::string> words = {"plan", "claim",      "--below",
                                          "1e-7", "--failures", "10000"};
  EXPECT_THAT(Run(words).out, HasSubstr("that many or more"));
  const json cut = json::parse(Run(With(words, {"--json"})).out);
  EXPECT_EQ(cut["trials_or_more"], true);
  EXPECT_FALSE(cut.contains("chance_at_2th")) << "of a number that is no answer";
  const json known = json::parse(Run({"plan", "claim", "--below", "0.01", "--json"}).out);
  EXPECT_FALSE(known.contains("trials_or_more"));
  EXPECT_TRUE(known.contains("chance_at_2th"));
}

TEST_F(CliOptions, ForceOverwritesNothing) {
  fs::create_directories(work() / "a");
  WriteFile(work() / "a" / "summary.json", "keep");
  WriteFile(work() / "a" / "letter.txt", "dear");
  const CommandResult first = RunTo(0, With(QuickRun("a", 1), {"--force"}));
  EXPECT_EQ(ReadFile(work() / "a" / "summary.old-1.json"), "keep");
  EXPECT_EQ(ReadFile(work() / "a" / "letter.txt"), "dear");
  EXPECT_THAT(first.err, HasSubstr("summary.old-1.json"));

  const std::string trials = ReadFile(work() / "a" / "trials.csv");
  const std::string summary = ReadFile(work() / "a" / "summary.json");
  RunTo(0, With(QuickRun("a", 2), {"--force"}));
  EXPECT_EQ(ReadFile(work() / "a" / "summary.old-2.json"), summary);
  EXPECT_EQ(ReadFile(work() / "a" / "trials.old-1.csv"), trials);
}

// Every file that a campaign writes is one that --force knows.
TEST_F(CliOptions, ForceKnowsEveryFileOfEveryCampaign) {
  const std::string scenarios = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/hazard_detection/";
  WriteFile(work() / "s.json", R"({
    "name": "s", "trials": 2, "common_random_numbers": true,
    "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 1},
    "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]},
             {"ablation": "perfect_localization"}]})");
  const std::vector<std::vector<std::string>> campaigns = {
      QuickRun("run", 2),
      {"sweep", "s.json", "--out", "sweep"},
      {"run", scenarios + "detection.json", "--trials", "2", "--out", "study", "--set",
       "hazard_detection.scenes_per_run=5"}};
  for (const std::vector<std::string>& words : campaigns) {
    SCOPED_TRACE(testing::PrintToString(words));
    const std::string folder = *(std::find(words.begin(), words.end(), "--out") + 1);
    const CommandResult first = Run(words);
    ASSERT_EQ(first.exit_code, 0) << first.err;
    const std::set<std::string> files = FilesIn(folder);
    ASSERT_EQ(Run(With(words, {"--force"})).exit_code, 0);
    const std::set<std::string> after = FilesIn(folder);
    for (const std::string& file : files) {
      if (file.ends_with("-wal") || file.ends_with("-shm")) continue;
      const fs::path name = file;
      EXPECT_TRUE(after.contains(name.stem().string() + ".old-1" + name.extension().string()))
          << file;
    }
  }
}

TEST_F(CliOptions, NoLineIsLongerThanAHundredColumns) {
  RunTo(0, QuickRun("a", 2));
  const std::vector<std::vector<std::string>> commands = {
      {"metrics"},
      {"plan", "claim", "--below", "1e-7", "--failures", "10000"},
      {"plan", "difference", "--from", "0.85", "--to", "0.86", "--discordant", "0.05"},
      With(QuickRun("b", 100000), {"--dry-run"}),
      With(QuickRun("a", 2), {"--force"}),
      {"run", Scenario("nominal"), "--until-half-width", "0.0123", "--budget", "123456789",
       "--dry-run", "--set", "referee.time_limit_s=1", "--out", "c"}};
  for (const std::vector<std::string>& words : commands) {
    SCOPED_TRACE(testing::PrintToString(words));
    const CommandResult result = RunTo(0, words);
    std::istringstream lines(result.out + result.err);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  }
}

// Processes that mpirun started beside rank 0 leave the terminal to it.
TEST_F(CliOptions, OnlyRankZeroAnswers) {
  setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
  const std::vector<std::vector<std::string>> commands = {{"metrics"},
                                                          {"fly"},
                                                          {"run", "--bogus"},
                                                          {"plan", "claim", "--below", "0.01"},
                                                          With(QuickRun("a", 2), {"--dry-run"})};
  for (const std::vector<std::string>& words : commands) {
    SCOPED_TRACE(testing::PrintToString(words));
    setenv("OMPI_COMM_WORLD_RANK", "1", 1);
    const CommandResult second = Run(words);
    EXPECT_EQ(second.out + second.err, "");
    EXPECT_TRUE(NothingWritten());
    setenv("OMPI_COMM_WORLD_RANK", "0", 1);
    const CommandResult first = Run(words);
    EXPECT_NE(first.out + first.err, "");
  }
  unsetenv("OMPI_COMM_WORLD_RANK");
  unsetenv("OMPI_COMM_WORLD_SIZE");
}

}  // namespace
}  // namespace rockyard::app

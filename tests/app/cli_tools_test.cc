// The subcommands beside run.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/command.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

using CliTools = CommandTest;

TEST_F(CliTools, VersionAndHelp) {
  const CommandResult version = Run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, StartsWith("rockyard "));
  EXPECT_THAT(version.out, HasSubstr("commit"));
  EXPECT_THAT(version.out, HasSubstr("flags"));
  const CommandResult help = Run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* name : {"run", "check", "compare", "rover", "terrain", "validate", "defaults",
                           "schema", "list", "parameters"}) {
    EXPECT_THAT(help.out, HasSubstr(name));
    EXPECT_EQ(Run({name, "--help"}).exit_code, 0) << name;
  }
}

TEST_F(CliTools, DefaultsAreAValidScenario) {
  WriteFile(work() / "defaults.json", Run({"defaults"}).out);
  const CommandResult result = Run({"validate", "defaults.json", Scenario("nominal")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("defaults.json: valid"));
  EXPECT_EQ(json::parse(Run({"schema"}).out)["type"], "object");
}

TEST_F(CliTools, ListIsWholeWherePiped) {
  const CommandResult result = Run({"list", std::string(ROCKYARD_SOURCE_DIR) + "/scenarios"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("/pathfinder\n"));
  EXPECT_THAT(result.out, HasSubstr("  obstacles_0.28.json "));
  EXPECT_THAT(result.out, testing::Not(HasSubstr("not valid")));
  EXPECT_THAT(result.out, HasSubstr("open towards the start; the goal lies behind it.\n"));
}

TEST_F(CliTools, ParametersAsTableAndCsv) {
  const CommandResult csv =
      Run({"parameters", Scenario("nominal"), "--csv", "--origin", "assumed"});
  EXPECT_EQ(csv.exit_code, 0) << csv.err;
  EXPECT_THAT(csv.out, StartsWith("path,kind,value"));
  EXPECT_THAT(csv.out, HasSubstr("referee.no_path_distance_m"));
  EXPECT_EQ(Run({"parameters", "--origin", "guessed"}).exit_code, 2);
  const CommandResult found = Run({"parameters", "--csv", "--search", "SLOPE_deg"});
  EXPECT_THAT(found.out, HasSubstr("\nterrain.ground.slope_deg,"));
  EXPECT_THAT(found.out, testing::Not(HasSubstr("referee.no_path_distance_m")));
  EXPECT_THAT(Run({"parameters", "--search", "moore"}).out, HasSubstr("terrain.rocks.k_per_m2"))
      << "in the source alone";
  const CommandResult none = Run({"parameters", "--search", "blurgh"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("no parameter has \"blurgh\""));
  EXPECT_THAT(Run({"parameters"}).out, HasSubstr("| "));
}

TEST_F(CliTools, CompareAndCheck) {
  ASSERT_EQ(Run(QuickRun("runs/a", 3)).exit_code, 0);
  ASSERT_EQ(Run(With(QuickRun("other/b", 3), {"--set", "name=b"})).exit_code, 0);
  const CommandResult compare = Run({"compare", "runs/a", "other/b"});
  EXPECT_EQ(compare.exit_code, 0) << compare.err;
  EXPECT_THAT(compare.out, HasSubstr("3 pairs"));
  EXPECT_THAT(compare.out, HasSubstr("equal rocks and equal noise"));
  Run(With(QuickRun("dense", 3), {"--set", "terrain.rocks.k_per_m2=0.01"}));
  const CommandResult other = Run({"compare", "runs/a", "dense", "--csv", "columns.csv"});
  EXPECT_THAT(other.out, HasSubstr("other settings of terrain"));
  EXPECT_THAT(other.out, HasSubstr("terrain.rocks.k_per_m2"));
  EXPECT_THAT(ReadFile(work() / "columns.csv"), HasSubstr("all,true_distance_m,m,3,"));

  const std::string reference =
      std::string(ROCKYARD_SOURCE_DIR) + "/results/reference/matthies1995.json";
  const CommandResult check = Run({"check", "runs", "other/b", "--against", reference, "--junit",
                                   "junit.xml", "--csv", "table.csv", "--replicates", "200"});
  // Three trials that all end after one second: whether that differs is not the question here.
  EXPECT_THAT((std::vector<int>{0, 1, 4}), testing::Contains(check.exit_code)) << check.err;
  EXPECT_THAT(check.out, HasSubstr("nominal"));
  EXPECT_THAT(check.err, HasSubstr("  JUnit report in junit.xml\n"));
  EXPECT_THAT(check.err, HasSubstr("  table in table.csv\n"));
  EXPECT_THAT(ReadFile(work() / "junit.xml"), HasSubstr("<testsuite"));
  EXPECT_THAT(ReadFile(work() / "table.csv"), StartsWith("id,scenario"));

  ASSERT_EQ(Run(QuickRun("runs/again", 1)).exit_code, 0);
  const CommandResult twice = Run({"check", "runs", "--against", reference});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.err, HasSubstr("is a run of nominal, and so is"));
}

TEST_F(CliTools, RoverIsDescribed) {
  const CommandResult result =
      Run({"rover", Scenario("nominal"), "--set", "rover.mass.wheel_kg=0.6"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("rover of nominal\n"));
  EXPECT_THAT(result.out, HasSubstr("0.65 x 0.48 x 0.3 m"));
  EXPECT_THAT(result.out, HasSubstr("wheels 6 x 0.6"));
  EXPECT_THAT(result.out, HasSubstr("9.81 m/s2"));
  EXPECT_TRUE(NothingWritten());
  const CommandResult help = Run({"rover", "--help"});
  EXPECT_THAT(help.out, HasSubstr("Examples:\n  rockyard rover"));
}

TEST_F(CliTools, RoverOfAFileOfItsOwn) {
  const std::string file = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/rovers/mfex.json";
  const CommandResult result = Run({"rover", file, "--set", "rover.mass.wheel_kg=0.25"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("rover of mfex\n"));
  EXPECT_THAT(result.out, HasSubstr("11.5 kg"));
  EXPECT_THAT(result.out, HasSubstr("wheels 6 x 0.25"));
  WriteFile(work() / "odd.json", "{\"geometry\": {\"legs\": 4}}");
  EXPECT_THAT(Run({"rover", "odd.json"}).err, HasSubstr("rover.geometry.legs"));
}

TEST_F(CliTools, RoverAsUrdf) {
  const CommandResult result = Run({"rover", Scenario("nominal"), "--out", "rocky.urdf"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "  URDF in rocky.urdf\n");
  EXPECT_THAT(ReadFile(work() / "rocky.urdf"), StartsWith("<?xml"));
  EXPECT_THAT(ReadFile(work() / "rocky.urdf"), HasSubstr("<robot name=\"rover\">"));
}

TEST_F(CliTools, OutputsThatCannotBeMeantAreRefusedBeforeTheWork) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused = {
      {{"rover", Scenario("nominal"), "--out", "rover.xml"}, "does not end in .urdf"},
      {{"rover", Scenario("nominal"), "--out", "no/rover.urdf"}, "in a folder that does not exist"},
      {{"terrain", Scenario("nominal"), "--out", "no/field.svg"},
       "in a folder that does not exist"},
      {{"terrain", Scenario("nominal"), "--out", "field.png"}, "no known extension"}};
  for (const auto& [words, reason] : refused) {
    const CommandResult result = Run(words);
    EXPECT_EQ(result.exit_code, 2) << words[0];
    EXPECT_THAT(result.err, HasSubstr("--out")) << words[0];
    EXPECT_THAT(result.err, HasSubstr(reason)) << words[0];
    EXPECT_TRUE(NothingWritten());
  }
}

TEST_F(CliTools, Terrain) {
  const CommandResult result = Run({"terrain", Scenario("nominal"), "--out", "field.svg"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "  terrain in field.svg\n");
  EXPECT_THAT(ReadFile(work() / "field.svg"), HasSubstr("<svg"));
}

}  // namespace
}  // namespace rockyard::app

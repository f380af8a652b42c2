// Scenarios, sweeps and runs named as people type them, and the first words of the command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/command.h"

namespace rockyard::app {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using CliFind = CommandTest;

TEST_F(CliFind, TheFirstWordsSayWhatToTry) {
  const CommandResult alone = Run({});
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_THAT(alone.out, HasSubstr("  rockyard run nominal --trials 40"));
  EXPECT_THAT(alone.out, HasSubstr("\n  replay "));
  EXPECT_EQ(Run({"help"}).out, alone.out);
  EXPECT_EQ(Run({"help", "run"}).out, Run({"run", "--help"}).out);
  EXPECT_EQ(Run({"help", "nothing"}).exit_code, 2);
}

TEST_F(CliFind, AScenarioByItsName) {
  const std::string file = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/pathfinder/nominal.json";
  const std::string fingerprint = Run({"validate", file}).out.substr(file.size());
  for (const char* name : {"nominal", "pathfinder/nominal", "nominal.json"}) {
    const CommandResult result = Run({"validate", name});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(result.out.ends_with(fingerprint)) << result.out;
  }
  EXPECT_THAT(Run({"run", "nominal", "--dry-run"}).out, StartsWith("nominal, seed 1: 300 trials"));
  EXPECT_THAT(Run({"trace", "nominal", "--trial", "0", "--set", "rover.fidelity=quasi_static"}).out,
              StartsWith("nominal, seed 1, trial 0"));
  EXPECT_EQ(Run({"terrain", "vl2", "--out", "field.svg"}).exit_code, 0);
}

// One name, a sweep and a scenario: the command knows which.
TEST_F(CliFind, ASweepByItsName) {
  EXPECT_THAT(Run({"run", "abundance", "--dry-run"}).out, StartsWith("gestalt_abundance"));
  EXPECT_THAT(Run({"sweep", "abundance", "--dry-run", "--pilots", "0"}).out,
              StartsWith("abundance: 6 cells"));
  EXPECT_THAT(Run({"sweep", "nominal"}).err, HasSubstr("no sweep of that name is known"));
}

TEST_F(CliFind, AFileComesFirst) {
  WriteFile(work() / "nominal", R"({"name": "mine"})");
  EXPECT_THAT(Run({"run", "nominal", "--dry-run"}).out, StartsWith("mine, seed 1"));
}

TEST_F(CliFind, MistypedNamesGetASuggestion) {
  for (const char* word : {"nominl", "scenarios/pathfinder/nominl.json", "Nominal"}) {
    const CommandResult result = Run({"run", word});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("did you mean \"nominal\"?")) << word;
  }
  EXPECT_THAT(Run({"run", "xyzxyz"}).err, Not(HasSubstr("did you mean")));
  const CommandResult both = Run({"run", "ditch"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("scenarios/courses/ditch.json"));
  EXPECT_THAT(both.err, HasSubstr("scenarios/gestalt/ditch.json"));
  EXPECT_THAT(Run({"run", "mfex"}).err, HasSubstr("no scenario of that name"));  // a rover
}

TEST_F(CliFind, ARoverByItsFileAlone) {
  const CommandResult rover = Run({"rover", "athena_sdm"});
  EXPECT_EQ(rover.exit_code, 0) << rover.err;
  EXPECT_THAT(rover.out, StartsWith("rover of athena_sdm\n"));
  EXPECT_THAT(rover.out, HasSubstr("61.8 kg"));
  EXPECT_THAT(Run({"rover", "athena_sdm", "--set", "rover.mass.total_kg=70"}).out,
              HasSubstr("70 kg"));
}

TEST_F(CliFind, AFolderThatHoldsRunsNamesThem) {
  ASSERT_EQ(Run(QuickRun("runs/one", 1)).exit_code, 0);
  ASSERT_EQ(Run(QuickRun("runs/two", 1)).exit_code, 0);
  const CommandResult result = Run({"trace", "runs", "--trial", "0"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("name one of the runs in it: runs/one, runs/two"));
  EXPECT_THAT(Run({"trace", ".", "--trial", "0"}).err, HasSubstr("as `rockyard run` prints it"));
}

TEST_F(CliFind, ParametersByAWord) {
  const CommandResult found = Run({"parameters", "--search", "ODOMETER"});
  EXPECT_EQ(found.exit_code, 0) << found.err;
  EXPECT_THAT(found.out, HasSubstr("`sensors.encoders.level_sand_gain`"));
  EXPECT_THAT(found.out, Not(HasSubstr("`rover.geometry.length_m`")));
  const CommandResult none = Run({"parameters", "--search", "xyzxyz"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("no parameter has \"xyzxyz\""));
}

TEST_F(CliFind, NamesOfOptionsAreExplainedLikeThoseOfScenarios) {
  const CommandResult result = Run({"run", "nominal", "--interval", "wilsn"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("error: --interval: is \"wilsn\", which is not a known name\n"
                                    "  try: did you mean \"wilson\"?"));
}

}  // namespace
}  // namespace rockyard::app

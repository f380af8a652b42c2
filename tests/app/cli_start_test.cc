// What somebody sees who does not know the program yet; the scenarios and rovers that come with it,
// by their names.
#include <gmock/gmock.h>

#include <string>

#include "app/command.h"

namespace rockyard::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

using CliStart = CommandTest;

TEST_F(CliStart, TheCommandAloneSaysWhatToDo) {
  const CommandResult alone = RunTo(0, {});
  EXPECT_EQ(alone.err, "");
  EXPECT_THAT(alone.out, AllOf(StartsWith("rockyard simulates"), HasSubstr("README.md"),
                               HasSubstr("  rockyard list "), HasSubstr("  rockyard run nominal "),
                               HasSubstr("\n  sweep       Runs scenarios")));
  EXPECT_EQ(Run({"help"}).out, alone.out);
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliStart, ItsFirstRunWorksAnywhere) {
  EXPECT_THAT(
      RunTo(0, {"run", "nominal", "--trials", "20", "--set", "rover.fidelity=quasi_static"}).out,
      HasSubstr("next: "));
}

TEST_F(CliStart, HelpOfACommandIsWhatItsOptionShows) {
  EXPECT_EQ(Run({"help", "run"}).out, Run({"run", "--help"}).out);
  EXPECT_EQ(Run({"help", "plan", "claim"}).out, Run({"plan", "claim", "--help"}).out);
  EXPECT_THAT(RunTo(2, {"help", "rnu"}).err,
              Says("error: help: \"rnu\" is no subcommand of rockyard", "did you mean \"run\"?"));
}

TEST_F(CliStart, PagesOfEveryCommandIntoAFolder) {
  RunTo(0, {"help", "--format", "man", "--out", "man"});
  EXPECT_EQ(ReadFile(work() / "man/rockyard-run.1"), Run({"help", "run", "--format", "man"}).out);
  EXPECT_EQ(ReadFile(work() / "man/rockyard.1"), Run({"help", "--format", "man"}).out);
  RunTo(0, {"help", "--format", "markdown", "--out", "md"});
  EXPECT_EQ(ReadFile(work() / "md/README.md"), Run({"help", "--format", "markdown"}).out);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"help", "--out", "x"},
                                                {"help", "run", "--format", "man", "--out", "x"}}) {
    EXPECT_THAT(RunTo(2, words).err, HasSubstr("error: --out: is for the pages of all commands"));
  }
}

using CliFind = CommandTest;

TEST_F(CliFind, AreTheFilesOfThatName) {
  const std::string file = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/pathfinder/nominal.json";
  const std::string fingerprint = Run({"validate", file}).out.substr(file.size());
  for (const char* name : {"nominal", "pathfinder/nominal", "nominal.json"}) {
    const CommandResult result = RunTo(0, {"validate", name});
    EXPECT_TRUE(result.out.ends_with(fingerprint)) << result.out;
  }
  EXPECT_THAT(Run({"run", "nominal", "--dry-run"}).out, StartsWith("nominal, seed 1: 300 trials"));
  EXPECT_THAT(Run({"trace", "nominal", "--trial", "0", "--set", "rover.fidelity=quasi_static"}).out,
              StartsWith("nominal, seed 1, trial 0"));
  RunTo(0, {"terrain", "vl2", "--out", "field.svg"});
}

TEST_F(CliFind, AMistypedPathSuggestsTheName) {
  for (const char* word : {"nominl", "scenarios/pathfinder/nominl.json", "Nominal"}) {
    EXPECT_THAT(RunTo(2, {"run", word}).err, HasSubstr("did you mean \"nominal\"?")) << word;
  }
}

TEST_F(CliFind, ErrorsNameTheKindThatIsMeant) {
  EXPECT_THAT(Run({"sweep", "nominal"}).err, HasSubstr("is no file, and no name of a sweep\n"));
  EXPECT_THAT(Run({"run", "mfex"}).err, HasSubstr("is no file, and no name of a scenario\n"));
  EXPECT_THAT(Run({"rover", "abc"}).err, HasSubstr("no name of a scenario or rover\n"));
  EXPECT_THAT(Run({"validate", "abc"}).err, HasSubstr("no name of a scenario or sweep\n"));
}

TEST_F(CliFind, ARoverByItsFileAlone) {
  const CommandResult rover = RunTo(0, {"rover", "athena_sdm"});
  EXPECT_THAT(rover.out, StartsWith("rover of athena_sdm\n"));
  EXPECT_THAT(rover.out, HasSubstr("61.8 kg"));
  EXPECT_THAT(Run({"rover", "athena_sdm", "--set", "rover.mass.total_kg=70"}).out,
              HasSubstr("70 kg"));
}

}  // namespace
}  // namespace rockyard::app

// What somebody sees who does not know the program yet.
#include <gmock/gmock.h>

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

}  // namespace
}  // namespace rockyard::app

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
  const CommandResult alone = Run({});
  EXPECT_EQ(alone.exit_code, 0);
  EXPECT_EQ(alone.err, "");
  EXPECT_THAT(alone.out, AllOf(StartsWith("rockyard simulates"), HasSubstr("README.md"),
                               HasSubstr("  rockyard list "), HasSubstr("  rockyard run nominal "),
                               HasSubstr("\n  sweep       Runs scenarios")));
  EXPECT_EQ(Run({"help"}).out, alone.out);
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliStart, ItsFirstRunWorksAnywhere) {
  const CommandResult run =
      Run({"run", "nominal", "--trials", "20", "--set", "rover.fidelity=quasi_static"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("next: "));
}

TEST_F(CliStart, HelpOfACommandIsWhatItsOptionShows) {
  EXPECT_EQ(Run({"help", "run"}).out, Run({"run", "--help"}).out);
  EXPECT_EQ(Run({"help", "plan", "claim"}).out, Run({"plan", "claim", "--help"}).out);
  const CommandResult unknown = Run({"help", "rnu"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("error: help: \"rnu\" is no subcommand of rockyard"),
                                 HasSubstr("did you mean \"run\"?")));
}

TEST_F(CliStart, PagesOfEveryCommandIntoAFolder) {
  EXPECT_EQ(Run({"help", "--format", "man", "--out", "man"}).exit_code, 0);
  EXPECT_EQ(ReadFile(work() / "man/rockyard-run.1"), Run({"help", "run", "--format", "man"}).out);
  EXPECT_EQ(ReadFile(work() / "man/rockyard.1"), Run({"help", "--format", "man"}).out);
  EXPECT_EQ(Run({"help", "--format", "markdown", "--out", "md"}).exit_code, 0);
  EXPECT_EQ(ReadFile(work() / "md/README.md"), Run({"help", "--format", "markdown"}).out);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"help", "--out", "x"},
                                                {"help", "run", "--format", "man", "--out", "x"}}) {
    const CommandResult refused = Run(words);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("error: --out: is for the pages of all commands"));
  }
}

}  // namespace
}  // namespace rockyard::app

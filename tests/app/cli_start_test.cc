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

}  // namespace
}  // namespace rockyard::app

// The last line of what a campaign says: the one next command.
#include <gmock/gmock.h>

#include <string>

#include "app/command.h"

namespace rockyard::app {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using CliNext = CommandTest;

std::string LastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  const std::size_t begin = text.rfind('\n', end);
  return text.substr(begin + 1, end - begin);
}

TEST_F(CliNext, IsTheLastLineOfARun) {
  const CommandResult run = RunTo(0, QuickRun("a", 2));
  EXPECT_THAT(LastLine(run.out), StartsWith("  next: rockyard "));
  EXPECT_THAT(LastLine(run.out), HasSubstr(" a"));
}

// Also where more is told after the report, on the other stream.
TEST_F(CliNext, IsTheLastLineAfterTraces) {
  std::string line = std::string("exec 2>&1; ") + ROCKYARD_COMMAND;
  for (const std::string& word : With(QuickRun("a", 2), {"--traces", "all"})) line += " " + word;
  const CommandResult run = Wait(StartProgram({"/bin/sh", "-c", line}));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("2 traces written"));
  EXPECT_THAT(LastLine(run.out), StartsWith("  next: rockyard "));
  EXPECT_EQ(run.out.find("next:"), run.out.rfind("next:"));
}

TEST_F(CliNext, IsForPeopleOnly) {
  EXPECT_THAT(Run(With(QuickRun("a", 1), {"--json"})).out, Not(HasSubstr("next:")));
  EXPECT_EQ(Run(With(QuickRun("b", 1), {"--quiet"})).out, "");
}

TEST_F(CliNext, ShardsAreMerged) {
  const CommandResult run = Run(With(QuickRun("a", 4), {"--shard", "1/2"}));
  EXPECT_EQ(LastLine(run.out), "  next: rockyard merge SHARD... --out FOLDER");
}

}  // namespace
}  // namespace rockyard::app

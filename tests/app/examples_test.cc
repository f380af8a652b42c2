#include "app/examples.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>
#include <string>

#include "app/commands.h"

namespace rockyard::app {
namespace {

// The parser of the command, whose subcommands do nothing.
class CommandExamples : public testing::Test {
 protected:
  CommandExamples() {
    AddCommands(app_, exit_code_);
    // Called when all is parsed, before the callbacks of subcommands, which own their options.
    app_.parse_complete_callback([] { throw CLI::Success(); });
  }

  // As a shell would hand it on: without what is around `rockyard ...`.
  static std::string Arguments(const CommandExample& example) {
    std::string line(example.line);
    line = line.substr(line.find("rockyard ") + 9);
    return line.substr(0, std::min(line.find(" > "), line.find(")\"")));
  }

  CLI::App app_{"test", "rockyard"};
  ExitCode exit_code_ = ExitCode::kDone;
};

TEST_F(CommandExamples, EachParses) {
  for (const CommandExample& example : Examples()) {
    SCOPED_TRACE(std::string(example.line));
    EXPECT_THROW(app_.parse(Arguments(example)), CLI::Success);
    EXPECT_EQ(app_.get_subcommands().front()->get_name(), example.command);
  }
  EXPECT_THROW(app_.parse("run a.json --no-such-option"), CLI::ExtrasError) << "the test can fail";
}

TEST_F(CommandExamples, EveryCommandHasOneToThreeThatItsHelpShows) {
  std::set<std::string> known;
  for (const CLI::App* command : app_.get_subcommands({})) {
    known.insert(command->get_name());
    const auto count = std::count_if(
        Examples().begin(), Examples().end(),
        [&](const CommandExample& example) { return example.command == command->get_name(); });
    EXPECT_GE(count, 1) << command->get_name();
    EXPECT_LE(count, 3) << command->get_name();
    EXPECT_NE(command->help().find("Examples:\n  "), std::string::npos) << command->get_name();
  }
  for (const CommandExample& example : Examples()) {
    EXPECT_TRUE(known.contains(std::string(example.command))) << example.command;
    EXPECT_LE(example.line.size(), 98u) << example.line;
    EXPECT_LE(example.what.size(), 94u) << example.what;
  }
}

}  // namespace
}  // namespace rockyard::app

// What people type: the examples that `rockyard COMMAND --help` shows.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace rockyard::app {

struct CommandExample {
  std::string_view command;  // of a subcommand
  std::string_view line;     // as typed in the folder of the project
  std::string_view what;     // it does, in a few words
};

// One to three for every subcommand. A test parses each.
std::span<const CommandExample> Examples();

// Those of a command as its help shows them, with the empty line that parts them from what follows;
// empty where there are none.
std::string ExampleText(std::string_view command);

// Shows them below the options of the subcommands, before what else stands there.
void AddExamples(CLI::App& app);

}  // namespace rockyard::app

// The examples of commands: `rockyard COMMAND --help` and the pages of commands (manual.h) show
// them.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace rockyard::app {

struct CommandExample {
  std::string_view command;  // its subcommand
  std::string_view line;     // as typed in the folder of the project
  std::string_view what;     // what it does, in a few words
};

// Returns one to three examples for every subcommand. A test parses each.
std::span<const CommandExample> Examples();

// Returns the examples of a command as its help shows them, with the empty line that parts them
// from what follows; empty where there are none.
std::string ExampleText(std::string_view command);

// Puts the ExampleText of every subcommand first in its footer. Must stay: the place, as ManualOf
// cuts the text off the beginning of the footer.
void AddExamples(CLI::App& app);

}  // namespace rockyard::app

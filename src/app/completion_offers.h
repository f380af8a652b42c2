// What a command line offers to the completion of a shell.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rockyard::app {

enum class Takes { kNothing, kNumber, kWord, kText };

struct Offer {
  std::vector<std::string> names;    // as typed: --trials, -h
  Takes takes = Takes::kNothing;     // after it
  std::vector<std::string> choices;  // where it takes a word of a few
  std::string about;
};

struct CommandOffer {
  std::string name;
  std::string about;
  std::vector<Offer> options;
  std::vector<std::string> words;  // that may stand in place of a file
  bool takes_files = false;
};

// One for each subcommand of the program, in the order of its help.
std::vector<CommandOffer> Offers(const CLI::App& app);

}  // namespace rockyard::app

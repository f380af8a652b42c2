// What a command line offers to the completion of a shell, and what its scripts ask the program
// for: words that only a look at files or settings can offer.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace rockyard::app {

enum class Takes { kNothing, kNumber, kWord, kSetting, kText };

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
  std::vector<std::string> words;    // that may stand in place of a file
  std::vector<std::string> lookups;  // kinds of names that may stand there too (LookUp)
  bool takes_files = false;
};

// The words that an option takes where it takes one of a few, as they begin ("worst:").
std::vector<std::string> ChoicesOf(const CLI::Option& option);

// The same as help writes them ("worst:N").
std::vector<std::string> WrittenChoicesOf(const CLI::Option& option);

// One for each subcommand of the program, in the order of its help.
std::vector<CommandOffer> Offers(const CLI::App& app);

// The words of a kind that begin with what has been typed, for "KIND:TYPED":
//   settings    paths of a scenario with "=" behind, and where one has been typed, "PATH=VALUE" for
//               each value of an enumeration or a boolean
//   scenarios, sweeps, rovers   names (scenario_names.h)
//   runs        folders in results/runs
// None of any other kind. Cost: 30 ms for the scenarios of the project.
std::vector<std::string> LookUp(std::string_view asked);

// Completion of the command line by the shell.

enum class Shell { kBash, kZsh, kFish };

// A script that completes the subcommands of the parser, their options, what options take where
// that is one of a few words, names and settings that the program looks up (LookUp),
// and files elsewhere. Made from the parser itself, so that it knows
// every option. Limits: the subcommands of subcommands (rockyard plan) are completed with the
// options of them all; names of cells are not known to it.
std::string CompletionScript(const CLI::App& app, Shell shell);

}  // namespace rockyard::app

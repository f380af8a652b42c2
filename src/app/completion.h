// Completion of the command line by a shell: the scripts that `rockyard completion` prints, and the
// words that these scripts ask the program for, as only a look at files or settings can offer them.
// Manual pages and messages about refused values take the words of an option from here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace rockyard::app {

// What follows an option on the command line. kSetting: PATH=VALUE; kText: also a file.
enum class Takes { kNothing, kNumber, kWord, kSetting, kText };

// An option.
struct Offer {
  std::vector<std::string> names;  // as typed: --trials, -h
  Takes takes = Takes::kNothing;
  std::vector<std::string> choices;  // for kWord, as ChoicesOf gives them
  std::string about;
};

// A subcommand.
struct CommandOffer {
  std::string name;
  std::string about;
  std::vector<Offer> options;
  std::vector<std::string> words;    // that may stand in place of a file
  std::vector<std::string> lookups;  // kinds of LookUp whose words may stand there too
  bool takes_files = false;
};

// Returns the words that may be typed for an option that takes one of a few, up to a colon:
// "worst:" of "worst:N". Returns nothing for other options.
std::vector<std::string> ChoicesOf(const CLI::Option& option);

// Returns the same words as help writes them: "worst:N".
std::vector<std::string> WrittenChoicesOf(const CLI::Option& option);

// Returns the offer of each subcommand, in the order of help.
std::vector<CommandOffer> Offers(const CLI::App& app);

// Answers "KIND:TYPED" with the words of that kind that begin with TYPED, and with nothing for a
// kind that is none of these:
//   settings: "PATH=" for each parameter of a scenario, and where TYPED has a "=", "PATH=VALUE" for
//   each value of an enumeration or a boolean. Those of navigators that the words of `line` bring,
//   too: all of a library's (--plugin), and those that a scenario file states.
//   scenarios, sweeps, rovers: names (scenario_names.h)
//   runs: folders in results/runs
// Must stay: the kinds, by which scripts of earlier programs ask, too.
// Cost: 30 ms for the scenarios of the project.
std::vector<std::string> LookUp(std::string_view asked, const std::vector<std::string>& line = {});

enum class Shell { kBash, kZsh, kFish };

// Returns a script that completes subcommands, their options, the words of options that take one of
// a few, what LookUp knows, and files elsewhere. It is made from the parser, and so knows every
// option. Limits: a subcommand of a subcommand (rockyard plan) is completed with the options of all
// its neighbours; names of cells are not completed.
std::string CompletionScript(const CLI::App& app, Shell shell);

}  // namespace rockyard::app

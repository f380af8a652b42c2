#include "app/completion_fish.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace rockyard::app {
namespace {

// Text in single quotes of fish, where only these two are special.
std::string FishQuoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

// Words that the program looks up for what has been typed of the current one.
std::string FishLookup(std::string_view kind, std::string_view before) {
  return fmt::format(
      "{} -a '(rockyard completion --offer {}:(commandline -ct | string collect --allow-empty) "
      "2>/dev/null)'",
      before, kind);
}

std::string FishOption(const CommandOffer& command, const Offer& option) {
  std::string line =
      fmt::format("complete -c rockyard -n '__fish_seen_subcommand_from {}'", command.name);
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (option.takes == Takes::kNumber) line += " -x";
  if (option.takes == Takes::kSetting) line += FishLookup("settings", " -x");
  if (option.takes == Takes::kText) line += " -r -F";
  if (option.takes == Takes::kWord) {
    line += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
  }
  return line + fmt::format(" -d {}\n", FishQuoted(option.about));
}

}  // namespace

std::string FishCompletion(const std::vector<CommandOffer>& commands) {
  std::string text =
      "# Completion of rockyard for fish:\n"
      "# rockyard completion fish > ~/.config/fish/completions/rockyard.fish\n"
      "complete -c rockyard -f -n __fish_use_subcommand -l help -d 'help'\n"
      "complete -c rockyard -f -n __fish_use_subcommand -l version -d 'version'\n";
  for (const CommandOffer& command : commands) {
    text += fmt::format("complete -c rockyard -f -n __fish_use_subcommand -a {} -d {}\n",
                        command.name, FishQuoted(command.about));
    const std::string seen =
        fmt::format("complete -c rockyard -n '__fish_seen_subcommand_from {}'", command.name);
    if (!command.words.empty()) {
      text += fmt::format("{} -f -a '{}'\n", seen, fmt::join(command.words, " "));
    }
    for (const std::string& kind : command.lookups) text += seen + FishLookup(kind, "") + "\n";
    if (command.takes_files) text += seen + " -F\n";
    for (const Offer& option : command.options) text += FishOption(command, option);
  }
  return text;
}

}  // namespace rockyard::app

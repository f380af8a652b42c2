#include "app/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/run_folders.h"
#include "campaign/plugin_settings.h"
#include "campaign/scenario_names.h"
#include "core/error.h"
#include "core/field_table.h"
#include "core/json_file.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

// Returns "wilson" and "clopper-pearson" of "TEXT:{wilson,clopper-pearson}", the parser's name of a
// type; the parser writes a word that stands for a number as "word->number".
std::vector<std::string> WrittenChoices(const std::string& type) {
  const std::size_t open = type.find('{');
  const std::size_t close = type.find('}', open);
  if (open == std::string::npos || close == std::string::npos) return {};
  auto words = CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
  for (std::string& word : words) word = word.substr(0, word.find("->"));
  return words;
}

// Returns the same words as they are offered: "worst:" of "worst:N".
std::vector<std::string> Choices(const std::string& type) {
  auto words = WrittenChoices(type);
  for (std::string& word : words) {
    if (word.find(':') != std::string::npos) word.resize(word.find(':') + 1);
  }
  return words;
}

Takes TakenBy(const CLI::Option& option) {
  if (option.get_expected_min() == 0 || option.get_items_expected_min() == 0) {
    return Takes::kNothing;
  }
  if (option.check_lname("set")) return Takes::kSetting;
  const std::string type = option.get_type_name();
  if (!Choices(type).empty()) return Takes::kWord;
  const bool number =
      type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("FLOAT");
  return number ? Takes::kNumber : Takes::kText;
}

std::string FirstLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// Returns the kinds of LookUp that fit a positional argument, by its name: scenarios and runs for
// "SCENARIO_OR_RUN". Must agree: the names of the arguments in the commands, and the kinds in
// WordsOf.
std::vector<std::string> LookupKinds(std::string_view positional) {
  std::vector<std::string> kinds;
  for (const auto& [part, kind] :
       {std::pair{"SCENARIO", "scenarios"}, std::pair{"SWEEP", "sweeps"},
        std::pair{"ROVER", "rovers"}, std::pair{"RUN", "runs"}, std::pair{"SHARD", "runs"}}) {
    if (positional.find(part) != std::string_view::npos) kinds.emplace_back(kind);
  }
  return kinds;
}

void AddOptions(const CLI::App& app, CommandOffer& offer) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // of scripts, not of people
    const Takes takes = TakenBy(*option);
    const std::vector<std::string> choices = Choices(option->get_type_name());
    if (option->get_positional()) {
      offer.words.insert(offer.words.end(), choices.begin(), choices.end());
      offer.takes_files = offer.takes_files || takes == Takes::kText;
      for (const std::string& kind : LookupKinds(option->get_name())) {
        offer.lookups.push_back(kind);
      }
      continue;
    }
    Offer each{{}, takes, choices, FirstLine(option->get_description())};
    for (const std::string& name : option->get_lnames()) each.names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) each.names.push_back("-" + name);
    const auto known = std::find_if(offer.options.begin(), offer.options.end(),
                                    [&](const Offer& other) { return other.names == each.names; });
    if (known == offer.options.end()) offer.options.push_back(std::move(each));
  }
}

CommandOffer OfferOf(const CLI::App& command) {
  CommandOffer offer{command.get_name(), FirstLine(command.get_description()), {}, {}, {}, false};
  AddOptions(command, offer);
  for (const CLI::App* inner : command.get_subcommands({})) {
    offer.words.push_back(inner->get_name());
    AddOptions(*inner, offer);
  }
  return offer;
}

std::vector<std::string> ValuesOf(const core::ParameterInfo& parameter) {
  if (parameter.kind == core::FieldKind::kBoolean) return {"true", "false"};
  return parameter.choices;
}

// Returns a scenario with the navigators of the line: of the libraries that it names by --plugin,
// or as far as a scenario file states their parameters. What is wrong with either is told when the
// command runs. Must stay: no file that is merely opened runs anybody's code.
scenario::Scenario ScenarioOf(const std::vector<std::string>& line) {
  campaign::GivenPlugins given;
  std::string file;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == "--plugin") {
      // The shell makes three words of --plugin=FILE.
      const std::size_t value = i + (i + 1 < line.size() && line[i + 1] == "=" ? 2 : 1);
      if (value < line.size()) given.libraries.push_back(line[value]);
    } else if (line[i].ends_with(".json") && file.empty()) {
      file = line[i];
    }
  }
  try {
    if (!given.libraries.empty()) {
      // The list alone: what it would choose need not go with the other defaults.
      return scenario::ParseScenario("{}", std::vector{campaign::SettingsOf(given).back()});
    }
    if (!file.empty()) return scenario::ReadScenarioSealed(core::LoadJsonFile(file));
  } catch (const core::UserError&) {
    return {};
  }
  return {};
}

std::vector<std::string> Settings(std::string_view typed, const std::vector<std::string>& line) {
  const bool has_path = typed.find('=') != std::string_view::npos;
  std::vector<std::string> words;
  for (const core::ParameterInfo& parameter : scenario::ListParameters(ScenarioOf(line))) {
    const std::string path = parameter.path + "=";
    if (!has_path) {
      words.push_back(path);
    } else if (typed.starts_with(path)) {
      for (const std::string& value : ValuesOf(parameter)) words.push_back(path + value);
    }
  }
  return words;
}

std::vector<std::string> Runs() {
  std::vector<std::string> words;
  for (const std::filesystem::path& run : RunFolders("results/runs")) {
    words.push_back(run.generic_string());
  }
  return words;
}

// Returns the shortest names, or paths where a path is being typed.
std::vector<std::string> Names(campaign::Wanted wanted, std::string_view typed) {
  return typed.find('/') == std::string_view::npos ? campaign::ScenarioNames(wanted)
                                                   : campaign::ScenarioPaths(wanted);
}

std::vector<std::string> WordsOf(std::string_view kind, std::string_view typed,
                                 const std::vector<std::string>& line) {
  if (kind == "settings") return Settings(typed, line);
  if (kind == "scenarios") return Names(campaign::Wanted::kScenario, typed);
  if (kind == "sweeps") return Names(campaign::Wanted::kSweep, typed);
  if (kind == "rovers") return Names(campaign::Wanted::kRover, typed);
  return kind == "runs" ? Runs() : std::vector<std::string>();
}

}  // namespace

std::vector<std::string> ChoicesOf(const CLI::Option& option) {
  return Choices(option.get_type_name());
}

std::vector<std::string> WrittenChoicesOf(const CLI::Option& option) {
  return WrittenChoices(option.get_type_name());
}

std::vector<CommandOffer> Offers(const CLI::App& app) {
  std::vector<CommandOffer> offers;
  for (const CLI::App* command : app.get_subcommands({})) offers.push_back(OfferOf(*command));
  return offers;
}

std::vector<std::string> LookUp(std::string_view asked, const std::vector<std::string>& line) {
  const std::size_t colon = asked.find(':');
  if (colon == std::string_view::npos) return {};
  const std::string_view typed = asked.substr(colon + 1);
  std::vector<std::string> words = WordsOf(asked.substr(0, colon), typed, line);
  std::erase_if(words, [&](const std::string& word) { return !word.starts_with(typed); });
  return words;
}

namespace {

// Returns text in single quotes of fish, inside which only ' and \ are special.
std::string FishQuoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

// Returns the part of a `complete` line that has the program look up words (LookUp) for what has
// been typed of the current one.
std::string FishLookup(std::string_view kind, std::string_view before) {
  return fmt::format(
      "{} -a '(rockyard completion --offer {}:(commandline -ct | string collect --allow-empty) "
      "--line (commandline -co | string collect --allow-empty) 2>/dev/null)'",
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

// Returns the CompletionScript for fish; Bash and Zsh return those for their shells.
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

std::string OptionNames(const CommandOffer& command) {
  std::vector<std::string> names;
  for (const Offer& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return fmt::format("{}", fmt::join(names, " "));
}

std::string CommandNames(const std::vector<CommandOffer>& commands, std::string_view between) {
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const CommandOffer& command : commands) names.push_back(command.name);
  return fmt::format("{}", fmt::join(names, between));
}

// Returns text in single quotes of a POSIX shell or zsh.
std::string Quoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// Returns the branch of bash's `case` that completes what an option takes; empty where it takes
// nothing, or a file.
std::string BashValue(const CommandOffer& command, const Offer& option) {
  if (option.takes == Takes::kNothing || option.takes == Takes::kText) return "";
  std::string patterns;
  for (const std::string& name : option.names) {
    patterns += fmt::format("{}'{} {}'", patterns.empty() ? "" : " | ", command.name, name);
  }
  if (option.takes == Takes::kSetting) {
    return fmt::format("    {}) _rockyard_settings \"$setting\" \"$cur\"; return ;;\n", patterns);
  }
  if (option.takes == Takes::kNumber) return fmt::format("    {}) return ;;\n", patterns);
  return fmt::format("    {})\n      COMPREPLY=($(compgen -W '{}' -- \"$cur\"))\n      return ;;\n",
                     patterns, fmt::join(option.choices, " "));
}

// Returns the branch of bash's `case` that completes what may stand where no option is being typed.
std::string BashWords(const CommandOffer& command) {
  std::string find;
  if (!command.words.empty()) {
    find = fmt::format("$(IFS=' '; compgen -W '{}' -- \"$cur\")", fmt::join(command.words, " "));
  }
  for (const std::string& kind : command.lookups) {
    find += fmt::format("{}$(_rockyard_offers '{}' \"$cur\")", find.empty() ? "" : " ", kind);
  }
  if (command.takes_files)
    find += fmt::format("{}$(compgen -f -- \"$cur\")", find.empty() ? "" : " ");
  return fmt::format("    {}) options='{}'; COMPREPLY=({}) ;;\n", command.name,
                     OptionNames(command), find);
}

std::string Bash(const std::vector<CommandOffer>& commands) {
  std::string values;
  std::string words;
  for (const CommandOffer& command : commands) {
    for (const Offer& option : command.options) values += BashValue(command, option);
    words += BashWords(command);
  }
  return fmt::format(R"sh(# Completion of rockyard for bash: eval "$(rockyard completion bash)"
_rockyard_offers() {{
  local line="$(printf '%s\n' "${{COMP_WORDS[@]/#\~\//$HOME/}}")"
  "${{COMP_WORDS[0]}}" completion --offer "$1:$2" --line "$line" 2>/dev/null
}}
_rockyard_settings() {{
  COMPREPLY=($(_rockyard_offers settings "$1$2"))
  COMPREPLY=("${{COMPREPLY[@]#"$1"}}")
  [[ -n $1 ]] || compopt -o nospace 2>/dev/null
}}
_rockyard() {{
  local IFS=$' \t\n'
  local cur="${{COMP_WORDS[COMP_CWORD]}}" prev="${{COMP_WORDS[COMP_CWORD-1]}}" command='' options=''
  local word setting='' before=$((COMP_CWORD-2))
  COMPREPLY=()
  if [[ $cur == = ]]; then
    cur=''
  elif [[ $prev == = ]]; then
    prev="${{COMP_WORDS[before]}}"
    before=$((before-1))
  else
    before=0
  fi
  if ((before > 0)) && [[ ${{COMP_WORDS[before]}} == = ]]; then
    before=$((before-1))
  fi
  if ((before > 0)) && [[ ${{COMP_WORDS[before]}} == --set ]]; then
    setting="$prev="
    prev=--set
  fi
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "$word" in {}) command="$word"; break ;; esac
  done
  case "$command $prev" in
{}    *) ;;
  esac
  IFS=$'\n'
  case "$command" in
{}    *) options='{} --help --version' ;;
  esac
  if [[ -z $command || $cur == -* ]]; then
    IFS=$' \t\n'
    COMPREPLY=($(compgen -W "$options" -- "$cur"))
  fi
}}
complete -o filenames -F _rockyard rockyard
)sh",
                     CommandNames(commands, " | "), values, words, CommandNames(commands, " "));
}

// Returns a description as zsh reads it inside [...] or before a colon.
std::string ZshText(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') safe += '\\';
    safe += c;
  }
  return safe;
}

// Returns the name of an option as zsh reads it, which takes a + at its end for something else.
std::string ZshName(const std::string& name) {
  std::string safe;
  for (const char c : name) safe += c == '+' ? std::string("\\+") : std::string(1, c);
  return safe;
}

std::string ZshOption(const Offer& option) {
  std::string text;
  for (const std::string& name : option.names) {
    std::string spec = fmt::format("*{}[{}]", ZshName(name), ZshText(option.about));
    if (option.takes == Takes::kNumber) spec += ":number:";
    if (option.takes == Takes::kWord) {
      spec += fmt::format(":word:({})", fmt::join(option.choices, " "));
    }
    if (option.takes == Takes::kSetting) spec += ":setting:{_rockyard_offers settings}";
    if (option.takes == Takes::kText) spec += ":value:_files";
    text += fmt::format("            {} \\\n", Quoted(spec));
  }
  return text;
}

// Returns the end of a command's branch: what may stand where no option does.
std::string ZshFiles(const CommandOffer& command) {
  if (!command.takes_files) return "            ;;\n";
  if (command.lookups.empty()) return "            '*:file:_files' ;;\n";
  return fmt::format("            '*:file:{{_rockyard_offers {}; _files}}' ;;\n",
                     fmt::join(command.lookups, " "));
}

std::string Zsh(const std::vector<CommandOffer>& commands) {
  std::string names;
  std::string cases;
  for (const CommandOffer& command : commands) {
    names += fmt::format("        {}\n", Quoted(command.name + ":" + ZshText(command.about)));
    cases += fmt::format("        {})\n          _arguments \\\n", command.name);
    for (const Offer& option : command.options) cases += ZshOption(option);
    if (!command.words.empty()) {
      cases += fmt::format("            '1:word:({})' \\\n", fmt::join(command.words, " "));
    }
    cases += ZshFiles(command);
  }
  return fmt::format(R"zsh(#compdef rockyard
# Completion of rockyard for zsh: rockyard completion zsh > "${{fpath[1]}}/_rockyard"
_rockyard_offers() {{
  local kind
  local -a offers
  for kind in "$@"; do
    offers=(${{(f)"$("$program" completion --offer "$kind:$PREFIX" --line "${{(F)words}}" 2>/dev/null)"}})
    compadd -Q -S '' -- $offers
  done
}}
_rockyard() {{
  local program=$words[1]
  local context state state_descr line
  typeset -A opt_args
  _arguments -C '--help[help]' '--version[version]' '1:command:->command' '*::argument:->argument'
  case $state in
    command)
      local -a commands=(
{}      )
      _describe command commands ;;
    argument)
      case $words[1] in
{}      esac ;;
  esac
}}
if [ "$funcstack[1]" = _rockyard ]; then
  _rockyard "$@"
else
  compdef _rockyard rockyard
fi
)zsh",
                     names, cases);
}

}  // namespace

std::string CompletionScript(const CLI::App& app, Shell shell) {
  const std::vector<CommandOffer> commands = Offers(app);
  switch (shell) {
    case Shell::kBash:
      return Bash(commands);
    case Shell::kZsh:
      return Zsh(commands);
    case Shell::kFish:
      return FishCompletion(commands);
  }
  return {};
}

// The command `rockyard completion`.

namespace {

void PrintOffers(const std::string& asked, const std::string& line) {
  std::string text;
  for (const std::string& word : LookUp(asked, CLI::detail::split(line, '\n'))) text += word + "\n";
  PrintExact(text);
}

}  // namespace

void AddCompletionCommand(CLI::App& app) {
  auto asked = std::make_shared<std::string>();
  auto line = std::make_shared<std::string>();
  auto shell = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("completion", "Prints what lets a shell complete rockyard's commands");
  CLI::Option* named = command->add_option("SHELL", *shell, "bash, zsh or fish")
                           ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  // What the scripts ask for while somebody types.
  CLI::Option* offer =
      command->add_option("--offer", *asked, "KIND:TYPED: words to offer")->group("");
  command->add_option("--line", *line, "the words of the command line, a line each")->group("");
  // The parser holds this callback, so it is there when the callback runs.
  command->callback([shell, asked, line, named, offer, &app] {
    if (*offer) return PrintOffers(*asked, *line);
    if (!*named) throw CLI::RequiredError("SHELL");
    const Shell known = *shell == "bash"  ? Shell::kBash
                        : *shell == "zsh" ? Shell::kZsh
                                          : Shell::kFish;
    PrintExact(CompletionScript(app, known));
  });
}

}  // namespace rockyard::app

#include "app/completion_script.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <string_view>
#include <vector>

#include "app/completion_offers.h"

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

// The script (CompletionScript) for these subcommands.
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

// Text in single quotes of a shell.
std::string Quoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// The line of a `case` of bash that completes what an option takes; empty where that is a file.
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

// What may stand where no option is being typed.
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
_rockyard_offers() {{ "${{COMP_WORDS[0]}}" completion --offer "$1:$2" 2>/dev/null; }}
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

// Of a description inside [...] or before a colon.
std::string ZshText(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') safe += '\\';
    safe += c;
  }
  return safe;
}

std::string ZshOption(const Offer& option) {
  std::string text;
  for (const std::string& name : option.names) {
    std::string spec = fmt::format("*{}[{}]", name, ZshText(option.about));
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

// The end of the case of a command: what stands where no option does.
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
    offers=(${{(f)"$("$program" completion --offer "$kind:$PREFIX" 2>/dev/null)"}})
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

}  // namespace rockyard::app

#include "app/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>
#include <utility>

#include "app/completion.h"
#include "app/examples.h"

namespace rockyard::app {
namespace {

// Returns "1 to 4096" of the parser's "INT in [1 - 4096]".
std::string RangeIn(const std::string& type) {
  const std::size_t open = type.find('[');
  const std::size_t close = type.find(']', open);
  if (open == std::string::npos || close == std::string::npos) return "";
  std::string range = type.substr(open + 1, close - open - 1);
  const std::size_t dash = range.find(" - ");
  if (dash != std::string::npos) range.replace(dash, 3, " to ");
  return range;
}

// Returns what an option takes: "INT", "INT, 1 to 4096", "uniform | adaptive", "FLOAT, 2 to 1e+06 |
// 0".
std::string ValueOf(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  const std::string type = option.get_type_name();
  const std::string range = RangeIn(type);
  std::string value = type.substr(0, type.find(':'));
  if (!range.empty()) value += ", " + range;
  const std::vector<std::string> choices = WrittenChoicesOf(option);
  if (choices.empty()) return value;
  const std::string words = fmt::format("{}", fmt::join(choices, " | "));
  return range.empty() ? words : fmt::format("{} | {}", value, words);
}

// Returns the names in alphabetical order. The parser keeps options in the order of their places in
// memory, which would change pages from run to run.
std::string NamesOf(const std::set<CLI::Option*>& options) {
  std::set<std::string> names;
  for (const CLI::Option* option : options) names.insert(option->get_name());
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string OneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string TextOf(const CLI::Option& option) {
  std::string text = OneLine(option.get_description());
  const auto add = [&](const std::string& sentence) {
    text += (text.empty() ? "" : "; ") + sentence;
  };
  if (!option.get_needs().empty()) add("only with " + NamesOf(option.get_needs()));
  if (!option.get_excludes().empty()) add("not with " + NamesOf(option.get_excludes()));
  if (option.get_positional() && !option.get_required()) add("may be left out");
  if (!option.get_positional() && option.get_required()) add("has to be given");
  return text;
}

std::string AllNames(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name();
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return fmt::format("{}", fmt::join(names, ", "));
}

ManualOption OptionOf(const CLI::Option& option) {
  return {AllNames(option), ValueOf(option), option.get_default_str(), TextOf(option)};
}

class OptionHelp final : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text = ValueOf(*option);
    if (!text.empty()) text.insert(0, " ");
    const std::string& preset = option->get_default_str();
    if (!preset.empty()) text += fmt::format(" [{}]", preset);
    return text + (option->get_items_expected_max() > 1 && !option->get_positional() ? " ..." : "");
  }
  std::string make_option_desc(const CLI::Option* option) const override { return TextOf(*option); }
};

// Returns the argument as a synopsis writes it: "[FILE]..." may be left out and repeated.
std::string Placeholder(const CLI::Option& option) {
  const std::string name =
      option.get_required() ? option.get_name() : "[" + option.get_name() + "]";
  return option.get_items_expected_max() > 1 ? name + "..." : name;
}

std::string UsageOf(const CLI::App& command, const std::string& name) {
  std::string usage = name + " [OPTIONS]";
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) usage += " " + Placeholder(*option);
  }
  return command.get_subcommands({}).empty() ? usage : usage + " COMMAND";
}

std::vector<std::string> Paragraphs(const std::string& text) {
  constexpr std::string_view kGap = "\n\n";
  std::vector<std::string> paragraphs;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(kGap, begin), text.size());
    paragraphs.push_back(OneLine(text.substr(begin, end - begin)));
    begin = end + kGap.size();
  }
  return paragraphs;
}

// Adds the examples, which AddExamples put first in the footer, and the rest of the footer as
// notes.
void AddFooter(const CLI::App& command, ManualPage& page) {
  std::string footer = command.get_footer();
  const std::string shown = ExampleText(command.get_name());
  if (!shown.empty() && footer.starts_with(shown)) {
    footer.erase(0, shown.size());
    for (const CommandExample& example : Examples()) {
      if (example.command != command.get_name()) continue;
      page.examples.push_back({std::string(example.line), std::string(example.what)});
    }
  }
  page.notes = Paragraphs(footer);
}

}  // namespace

std::shared_ptr<CLI::FormatterBase> HelpFormatter() { return std::make_shared<OptionHelp>(); }

ManualPage ManualOf(const CLI::App& command, std::string_view parent) {
  ManualPage page;
  page.name =
      parent.empty() ? command.get_name() : fmt::format("{} {}", parent, command.get_name());
  page.summary = OneLine(command.get_description());
  page.usage = UsageOf(command, page.name);
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;
    (option->get_positional() ? page.arguments : page.options).push_back(OptionOf(*option));
  }
  AddFooter(command, page);
  for (const CLI::App* inner : command.get_subcommands({})) {
    page.commands.push_back(ManualOf(*inner, page.name));
  }
  return page;
}

}  // namespace rockyard::app

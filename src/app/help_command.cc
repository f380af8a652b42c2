// rockyard help, and rockyard alone
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/start_text.h"
#include "core/error.h"
#include "core/spelling.h"

namespace rockyard::app {
namespace {

constexpr const char* kStart =
    "rockyard simulates planetary rovers among rocks, many trials at a time, and tells how often\n"
    "they arrive.\n"
    "\n"
    "Three commands to begin with:\n"
    "  rockyard list                       the scenarios that there are\n"
    "  rockyard run nominal --trials 20 --set rover.fidelity=quasi_static\n"
    "                                      twenty drives of one of them, in a few seconds\n"
    "  rockyard help run                   what else `run` can do\n"
    "\n"
    "README.md of the source tree is the way into the documentation; every folder has its own.\n"
    "\n"
    "Commands:\n";

std::string FirstSentence(const CLI::App& command) {
  std::string text = command.get_description();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.substr(0, text.find_first_of(";:"));
}

// The subcommand of that name, which stands below "rockyard" or below another: "plan claim".
const CLI::App* Below(const CLI::App& command, const std::string& name) {
  std::vector<std::string> names;
  for (const CLI::App* inner : command.get_subcommands({})) {
    if (inner->get_name() == name) return inner;
    names.push_back(inner->get_name());
  }
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  throw core::UserError("help",
                        fmt::format("\"{}\" is no subcommand of {}", name, command.get_name()),
                        core::Suggest(name, candidates));
}

void ShowHelp(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty()) return Print(Wrapped(StartText(app)));
  const CLI::App* command = &app;
  std::string before;
  for (const std::string& word : words) {
    before += (before.empty() ? "" : " ") + command->get_name();
    command = Below(*command, word);
  }
  Print(command->help(before));
}

}  // namespace

std::string StartText(const CLI::App& app) {
  std::string text = kStart;
  for (const CLI::App* command : app.get_subcommands({})) {
    text += fmt::format("  {:<12}{}\n", command->get_name(), FirstSentence(*command));
  }
  return text + "\n`rockyard help COMMAND` tells all of one of them, with examples.\n";
}

void AddHelpCommand(CLI::App& app) {
  auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand("help", "Says what to do first, or all of a command");
  command->add_option("COMMAND", *words, "subcommand, such as run or plan claim");
  // The parser holds this callback, so it is there when the callback runs.
  command->callback([words, &app] { ShowHelp(app, *words); });
}

}  // namespace rockyard::app

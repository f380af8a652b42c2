// The command `rockyard help`, what `rockyard` alone prints, and the files of docs/commands and
// man.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/manual.h"
#include "core/error.h"
#include "core/provenance.h"
#include "core/text.h"
#include "report/atomic_file.h"

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
    "docs/README.md of the source tree (share/doc/rockyard of an installation) is the way into "
    "the\n"
    "documentation: a tutorial of an hour, twelve questions with their answers, every command.\n"
    "\n"
    "Commands:\n";

std::string FirstSentence(const CLI::App& command) {
  std::string text = command.get_description();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.substr(0, text.find_first_of(";:"));
}

// Returns the subcommand of that name right below `command`. Throws core::UserError where there is
// none.
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

struct HelpOptions {
  std::vector<std::string> words;
  std::string format = "text";
  std::string folder;  // for a page of every command; empty: the page of one is printed
};

std::string PageOf(const CLI::App& command, const std::string& before, const std::string& format) {
  const ManualPage page = ManualOf(command, before);
  return format == "man" ? AsMan(page, "rockyard " + core::CurrentProvenance().version)
                         : AsMarkdown(page);
}

// Returns "run.md" or "rockyard-run.1"; for rockyard itself, whose `command` is empty, "README.md"
// or "rockyard.1".
std::string PageFile(const std::string& command, const std::string& format) {
  if (format == "man")
    return command.empty() ? "rockyard.1" : fmt::format("rockyard-{}.1", command);
  return command.empty() ? "README.md" : command + ".md";
}

void WritePages(const CLI::App& app, const HelpOptions& options) {
  if (options.format == "text" || !options.words.empty()) {
    throw core::UserError("--out", "is for the pages of all commands, in markdown or man",
                          "name a --format and no command");
  }
  const std::filesystem::path folder = options.folder;
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, const std::string& page) {
    report::WriteFileAtomically(folder / PageFile(name, options.format), page);
  };
  write("", PageOf(app, "", options.format));
  for (const CLI::App* command : app.get_subcommands({})) {
    write(command->get_name(), PageOf(*command, app.get_name(), options.format));
  }
  PrintNote(fmt::format("pages of every command in {}", options.folder));
}

void ShowHelp(const CLI::App& app, const HelpOptions& options) {
  if (!options.folder.empty()) return WritePages(app, options);
  const CLI::App* command = &app;
  std::string before;
  for (const std::string& word : options.words) {
    before += (before.empty() ? "" : " ") + command->get_name();
    command = Below(*command, word);
  }
  if (options.format != "text") return Print(PageOf(*command, before, options.format));
  Print(options.words.empty() ? Wrapped(StartText(app)) : command->help(before));
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
  auto options = std::make_shared<HelpOptions>();
  CLI::App* command = app.add_subcommand("help", "Says what to do first, or all of a command");
  command->add_option("COMMAND", options->words, "subcommand, such as run or plan claim");
  command
      ->add_option("--format", options->format,
                   "text for a terminal, a page of docs/commands, or a page for man")
      ->check(CLI::IsMember({"text", "markdown", "man"}))
      ->capture_default_str();
  command->add_option("--out", options->folder,
                      "folder for a page of every command, as markdown or for man");
  // The parser holds this callback, so it is there when the callback runs.
  command->callback([options, &app] { ShowHelp(app, *options); });
}

}  // namespace rockyard::app

#include "app/command_text.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "batch/communicator.h"
#include "campaign/output_folder.h"

namespace rockyard::app {
namespace {

constexpr std::string_view kResume = "--resume";
// Options that hold for one session of a campaign, and are left out of the command that goes on
// with it (which has its own --resume).
constexpr std::array<std::string_view, 3> kOnce = {kResume, "--force", "--retry-faults"};

bool IsFlag(const CLI::Option& option) { return option.get_items_expected_min() == 0; }

// Returns the command line, with --resume in place of kOnce where `resume`. Positional arguments
// come first, so that none is taken for the value of an option. Must hold: every positional
// argument of these commands is a file or folder, as ShellPath takes them.
std::string Text(const CLI::App& command, bool resume) {
  std::string words;
  std::string options;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || (resume && std::ranges::count(kOnce, name) > 0)) continue;
    if (option->get_positional()) {
      for (const std::string& word : option->results()) words += " " + campaign::ShellPath(word);
    } else if (IsFlag(*option)) {
      options += " " + name;
    } else {
      for (const std::string& word : option->results()) {
        options += " " + name + " " + campaign::ShellWord(word);
      }
    }
  }
  if (resume) options += " " + std::string(kResume);
  return "rockyard " + command.get_name() + words + options;
}

}  // namespace

std::string CommandText(const CLI::App& command) { return Text(command, false); }

std::string ResumeText(const CLI::App& command) { return Text(command, true); }

std::string NextCommand(const std::filesystem::path& folder, Finished what) {
  if (what == Finished::kShard) return "rockyard merge SHARD... --out FOLDER";
  return "rockyard report " + campaign::ShellPath(folder.string());
}

std::string NextLine(const std::filesystem::path& folder, Finished what,
                     const std::string& resume) {
  if (resume.empty()) return fmt::format("  next: {}\n", NextCommand(folder, what));
  const auto launch = batch::FindLaunch();
  return fmt::format("  next: {}{}\n", launch ? fmt::format("mpirun -n {} ", launch->ranks) : "",
                     resume);
}

}  // namespace rockyard::app

// The command `rockyard new`: a folder to begin with, with a subcommand for each thing of one's own
// that rockyard takes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/new_files.h"
#include "campaign/output_folder.h"
#include "campaign/scenario_names.h"
#include "core/error.h"
#include "core/files.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNominal = "pathfinder/nominal.json";

struct NewNavigatorOptions {
  std::string name;
  std::string out;   // empty: a folder of that name
  bool cpp = false;  // also where neither is given
  bool python = false;
};

// Returns the folder to be made. Throws core::UserError for what is there.
fs::path NewFolder(const NewNavigatorOptions& options) {
  fs::path folder = options.out.empty() ? options.name : options.out;
  if (!folder.has_filename()) folder = folder.parent_path();  // "a" of "a/"
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error))) {
    throw core::UserError(folder.string(), "exists, and nothing is written over",
                          "name a new folder with --out");
  }
  if (!core::HasRoomForTemporary(folder)) {
    throw core::UserError(folder.string(), "has too long a name", "name a shorter one with --out");
  }
  return folder;
}

// Returns the scenario of nominal terrain as a file of the new folder names it: by its path from
// there where it belongs to the working folder, so that both can be moved together, else by its
// whole path.
std::string NominalSeenFrom(const fs::path& folder) {
  fs::path file;
  try {
    file = campaign::ScenarioFile(kNominal);
  } catch (const core::UserError&) {
    throw core::UserError(kNominal,
                          fmt::format("is not in {}, and the new scenario extends it",
                                      campaign::ScenarioFolder().string()),
                          "set ROCKYARD_SCENARIOS to the folder of rockyard's own scenarios");
  }
  if (file.is_absolute()) return file.string();
  return fs::weakly_canonical(file)
      .lexically_relative(fs::weakly_canonical(fs::absolute(folder)))
      .string();
}

// Returns what was written and all that is to be typed next.
std::string NewFolderText(const fs::path& folder, const std::vector<NewFile>& files) {
  std::vector<std::string> names;
  names.reserve(files.size());
  for (const NewFile& file : files) names.push_back(file.name);
  std::string text = fmt::format("  {} in {}\n  next: cd {}\n", fmt::join(names, ", "),
                                 folder.string(), campaign::ShellPath(folder.string()));
  for (const std::string& command : CommandsOf(files)) text += "        " + command + "\n";
  return text;
}

void NewNavigator(const NewNavigatorOptions& options) {
  const NavigatorForm form = options.python ? NavigatorForm::kProcess : NavigatorForm::kPlugin;
  CheckNavigatorName(options.name, form);
  const fs::path folder = NewFolder(options);
  const std::vector<NewFile> files = NavigatorFiles(options.name, form, NominalSeenFrom(folder));
  WriteNewFolder(folder, files);
  Print(NewFolderText(folder, files));
}

}  // namespace

void AddNewCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("new", "Writes a folder to begin with: a navigator of your own");
  command->require_subcommand(1);
  auto options = std::make_shared<NewNavigatorOptions>();
  CLI::App* navigator = command->add_subcommand(
      "navigator", "A navigator that drives: source, scenario, README with the next commands");
  navigator
      ->add_option("NAME", options->name,
                   "of the navigator: lower-case letters, digits and underscores")
      ->required();
  CLI::Option* python = navigator->add_flag("--python", options->python,
                                            "in Python, as a process that rockyard starts");
  navigator->add_flag("--c++", options->cpp, "in C++, as a plugin; so it is without --python")
      ->excludes(python);
  navigator->add_option("--out", options->out, "new folder (default: NAME)");
  navigator->callback([options] { NewNavigator(*options); });
}

}  // namespace rockyard::app

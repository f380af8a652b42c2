// rockyard list
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "core/error.h"
#include "core/json_file.h"
#include "scenario/ablations.h"
#include "scenario/load.h"
#include "scenario/sweep.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kWidth = 100;

std::vector<fs::path> JsonFiles(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    if (at->is_regular_file(error) && at->path().extension() == ".json") {
      files.push_back(at->path());
    }
  }
  if (error || files.empty()) {
    throw core::UserError(folder.string(),
                          error ? "cannot be read: " + error.message() : "holds no scenario files",
                          "name a folder with scenarios");
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Whether the file is one that scenarios extend: in a group, such as a rover, none of whose keys is
// a scenario's, or as a whole, such as a sensor profile, which has no name.
bool IsPart(const core::JsonValue& document) {
  if (!document.Is(core::JsonValue::Type::kObject) || document.members().empty()) return false;
  if (document.Find("name") == nullptr) return true;
  const core::JsonValue scenario = scenario::WriteScenario({});
  return std::none_of(
      document.members().begin(), document.members().end(),
      [&](const core::JsonMember& member) { return scenario.Find(member.key) != nullptr; });
}

std::string AboutSweep(const fs::path& file) {
  const scenario::Sweep sweep = scenario::LoadSweep(file);
  return fmt::format("sweep of {} cells: {}", sweep.cells.size(),
                     sweep.description.empty() ? sweep.name : sweep.description);
}

std::string About(const fs::path& file) {
  try {
    const core::JsonValue document = core::LoadJsonFile(file);
    if (scenario::IsSweep(document)) return AboutSweep(file);
    if (IsPart(document)) return "part of a scenario, which can extend it";
    const scenario::Scenario scenario = scenario::ReadScenario(document);
    return scenario.description.empty() ? scenario.name : scenario.description;
  } catch (const core::UserError& error) {
    const core::Problem& problem = error.problems().front();
    return fmt::format("not valid: {}: {}", problem.path, problem.reason);
  }
}

// Names are relative to the folder, so that there is room for what they are.
void List(const std::string& folder) {
  const std::vector<fs::path> files = JsonFiles(folder);
  std::size_t widest = 0;
  for (const fs::path& file : files) {
    widest = std::max(widest, file.lexically_relative(folder).string().size());
  }
  Print(fmt::format("in {}:\n", folder));
  for (const fs::path& file : files) {
    std::string line =
        fmt::format("{:<{}}  {}", file.lexically_relative(folder).string(), widest, About(file));
    if (line.size() > kWidth) line = line.substr(0, kWidth - 3) + "...";
    Print(line + "\n");
  }
}

void ListAblations() {
  for (const scenario::Ablation& ablation : scenario::Ablations()) {
    Print(fmt::format("{}: {}\n", ablation.name, ablation.sentence));
    for (const std::string_view setting : ablation.settings) {
      Print(fmt::format("    {}\n", setting));
    }
  }
}

}  // namespace

void AddListCommand(CLI::App& app) {
  auto folder = std::make_shared<std::string>("scenarios");
  auto ablations = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("list", "Lists scenarios and sweeps with a line each");
  command->add_option("FOLDER", *folder, "where to look")->capture_default_str();
  command->add_flag("--ablations", *ablations,
                    "list what `rockyard run --ablate` and sweeps can take away, with settings");
  command->callback([folder, ablations] {
    if (*ablations) {
      ListAblations();
    } else {
      List(*folder);
    }
  });
}

}  // namespace rockyard::app

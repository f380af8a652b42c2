// The command `rockyard validate`: whether scenario and sweep files can be run, and their doubts.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/set_options.h"
#include "campaign/run_source.h"
#include "campaign/scenario_doubts.h"
#include "campaign/scenario_names.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/json_file.h"
#include "report/line_text.h"
#include "scenario/load.h"
#include "scenario/sweep.h"

namespace rockyard::app {
namespace {

struct ValidateOptions {
  std::vector<std::string> scenarios;
  std::vector<std::string> overrides;
};

bool IsSweepFile(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) &&
         scenario::IsSweep(core::LoadJsonFile(path));
}

scenario::Sweep LoadSweep(const std::string& path, const std::vector<std::string>& overrides) {
  return scenario::LoadSweep(path, {.overrides = overrides, .trials = {}, .seed = {}});
}

// Returns what is said of a valid file. Throws core::UserError for any other.
std::string Check(const std::string& path, const std::vector<std::string>& overrides) {
  if (IsSweepFile(path)) {
    return fmt::format("a sweep of {} cells", LoadSweep(path, overrides).cells.size());
  }
  return "fingerprint " +
         core::Hex(scenario::Fingerprint(campaign::LoadScenarioFrom(path, overrides)));
}

void PrintDoubts(const std::string& path, const std::vector<std::string>& overrides) {
  const std::vector<core::Problem> doubts = IsSweepFile(path)
                                                ? campaign::DoubtsOf(LoadSweep(path, overrides))
                                                : campaign::DoubtsOf(path, overrides);
  for (const core::Problem& doubt : doubts) {
    Print(fmt::format("  doubtful: {}\n", report::Printable(campaign::TextOf(doubt))));
  }
}

// Tells every problem of every file, not those of the first alone.
void Validate(const ValidateOptions& options) {
  std::vector<core::Problem> problems;
  for (const std::string& word : options.scenarios) {
    try {
      const std::string path = campaign::ScenarioFile(word, campaign::Wanted::kEither);
      Print(
          fmt::format("{}: valid, {}\n", report::Printable(path), Check(path, options.overrides)));
      PrintDoubts(path, options.overrides);
    } catch (const core::UserError& error) {
      for (core::Problem problem : error.problems()) {
        if (options.scenarios.size() > 1) problem.path = word + ": " + problem.path;
        problems.push_back(std::move(problem));
      }
    }
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
}

}  // namespace

void AddValidateCommand(CLI::App& app) {
  auto options = std::make_shared<ValidateOptions>();
  CLI::App* command = app.add_subcommand("validate", "Checks scenario and sweep files");
  command
      ->add_option("SCENARIO_OR_SWEEP", options->scenarios,
                   "scenario or sweep files, or their names")
      ->required();
  AddSetOptions(*command, options->overrides);
  command->callback([options] { Validate(*options); });
}

}  // namespace rockyard::app

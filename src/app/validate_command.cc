// rockyard validate
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/run_source.h"
#include "core/error.h"
#include "core/hash.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

struct ValidateOptions {
  std::vector<std::string> scenarios;
  std::vector<std::string> overrides;
};

// Every problem of every file, not of the first alone.
void Validate(const ValidateOptions& options) {
  std::vector<core::Problem> problems;
  for (const std::string& path : options.scenarios) {
    try {
      const scenario::Scenario scenario = LoadScenarioFrom(path, options.overrides);
      Print(fmt::format("{}: valid, fingerprint {}\n", path,
                        core::Hex(scenario::Fingerprint(scenario))));
    } catch (const core::UserError& error) {
      for (core::Problem problem : error.problems()) {
        if (options.scenarios.size() > 1) problem.path = path + ": " + problem.path;
        problems.push_back(std::move(problem));
      }
    }
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
}

}  // namespace

void AddValidateCommand(CLI::App& app) {
  auto options = std::make_shared<ValidateOptions>();
  CLI::App* command = app.add_subcommand("validate", "Checks scenario files");
  command->add_option("SCENARIO", options->scenarios, "scenario files")->required();
  command->add_option("--set", options->overrides, "PATH=VALUE: changes the scenario; repeat")
      ->allow_extra_args(false);
  command->callback([options] { Validate(*options); });
}

}  // namespace rockyard::app

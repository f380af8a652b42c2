// rockyard parameters
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "campaign/run_source.h"
#include "report/parameter_table.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

struct ParametersOptions {
  std::string scenario;
  std::vector<std::string> overrides;
  std::optional<core::Origin> origin;
  bool csv = false;
};

void ListParameters(const ParametersOptions& options) {
  const scenario::Scenario scenario =
      options.scenario.empty() ? scenario::Scenario{}
                               : campaign::LoadScenarioFrom(options.scenario, options.overrides);
  const auto parameters =
      report::SelectParameters(scenario::ListParameters(scenario), options.origin);
  if (options.csv) {
    PrintExact(report::ParametersCsv(parameters));
  } else {
    Print(report::ParametersMarkdown(parameters));
  }
}

}  // namespace

void AddParametersCommand(CLI::App& app) {
  auto options = std::make_shared<ParametersOptions>();
  CLI::App* command = app.add_subcommand(
      "parameters", "Lists every parameter with value, range, origin and source");
  command->add_option("SCENARIO", options->scenario, "scenario file (default: the defaults)");
  command->add_option("--set", options->overrides, "PATH=VALUE: changes the scenario; repeat")
      ->allow_extra_args(false);
  const std::vector<std::pair<std::string, core::Origin>> origins = {
      {"published", core::Origin::kPublished},
      {"calibrated", core::Origin::kCalibrated},
      {"assumed", core::Origin::kAssumed},
      {"setting", core::Origin::kSetting}};
  command->add_option("--origin", options->origin, "only those of one origin")
      ->transform(CLI::CheckedTransformer(origins));
  command->add_flag("--csv", options->csv, "CSV instead of Markdown");
  command->callback([options] { ListParameters(*options); });
}

}  // namespace rockyard::app

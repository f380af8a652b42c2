// rockyard parameters
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/find_scenario.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "report/line_text.h"
#include "report/parameter_table.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

struct ParametersOptions {
  std::string scenario;
  std::vector<std::string> overrides;
  std::optional<core::Origin> origin;
  std::string word;
  bool csv = false;
};

void ListParameters(const ParametersOptions& options) {
  const scenario::Scenario scenario =
      options.scenario.empty()
          ? scenario::ParseScenario("{}", options.overrides)
          : campaign::LoadScenarioFrom(FindScenario(options.scenario, WantedFile::kScenario),
                                       options.overrides);
  const auto parameters = report::SearchParameters(
      report::SelectParameters(scenario::ListParameters(scenario), options.origin), options.word);
  if (parameters.empty()) {
    throw core::UserError("--search",
                          fmt::format("no parameter has \"{}\" in path, meaning or source",
                                      report::Printable(options.word)),
                          "search for a part of the word, or list all");
  }
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
  command->add_option("SCENARIO", options->scenario,
                      "scenario: its file, or its name (default: the defaults)");
  command->add_option("--set", options->overrides, "PATH=VALUE: changes the scenario; repeat")
      ->allow_extra_args(false);
  const std::vector<std::pair<std::string, core::Origin>> origins = {
      {"published", core::Origin::kPublished},
      {"calibrated", core::Origin::kCalibrated},
      {"assumed", core::Origin::kAssumed},
      {"setting", core::Origin::kSetting}};
  command->add_option("--origin", options->origin, "only those of one origin")
      ->transform(CLI::CheckedTransformer(origins));
  command->add_option("--search", options->word,
                      "only those with this word in path, meaning or source");
  command->add_flag("--csv", options->csv, "CSV instead of Markdown");
  command->callback([options] { ListParameters(*options); });
}

}  // namespace rockyard::app

// The commands that print what a scenario may hold and what is measured: `rockyard defaults`,
// `schema`, `metrics` and `parameters`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/set_options.h"
#include "campaign/run_source.h"
#include "campaign/scenario_names.h"
#include "core/error.h"
#include "report/parameter_table.h"
#include "scenario/load.h"

namespace rockyard::app {

namespace {

// Returns the default scenario with what plugins add. What they choose for want of better
// (campaign/plugin_settings.h) is left out where it does not go with the other defaults.
scenario::Scenario Defaults(const std::vector<std::string>& overrides) {
  try {
    return scenario::ParseScenario("{}", overrides);
  } catch (const core::UserError&) {
    const auto list = std::ranges::find_if(
        overrides, [](const std::string& each) { return each.starts_with("plugins="); });
    if (list == overrides.begin() || list == overrides.end()) throw;
    return scenario::ParseScenario("{}", std::vector<std::string>(list, overrides.end()));
  }
}

// Adds a command that prints something of the default scenario, changed by the options of a
// scenario: with a plugin, its parameters are there too.
void AddPrinting(CLI::App& app, const char* name, const char* description,
                 std::string (*text)(const scenario::Scenario& scenario)) {
  auto overrides = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand(name, description);
  AddSetOptions(*command, *overrides);
  command->callback([overrides, text] { PrintJson(text(Defaults(*overrides))); });
}

}  // namespace

void AddDefaultsCommand(CLI::App& app) {
  AddPrinting(app, "defaults", "Prints a scenario with every parameter at its default",
              scenario::ResolvedJson);
}

void AddSchemaCommand(CLI::App& app) {
  AddPrinting(app, "schema", "Prints the JSON Schema of scenario files", scenario::SchemaJson);
}

namespace {

struct MetricsOptions {
  std::string scenario;
  std::vector<std::string> overrides;
  bool markdown = false;
};

void ListMetrics(const MetricsOptions& options) {
  const auto columns = options.scenario.empty()
                           ? truth::RecordSchema()
                           : campaign::ColumnsOf(campaign::LoadScenarioFrom(
                                 campaign::ScenarioFile(options.scenario), options.overrides));
  Print(options.markdown ? report::MetricTableMarkdown(columns)
                         : Wrapped(report::MetricTableText(columns)));
}

}  // namespace

void AddMetricsCommand(CLI::App& app) {
  auto options = std::make_shared<MetricsOptions>();
  CLI::App* command =
      app.add_subcommand("metrics", "Lists what is computed of drives, each with its definition");
  CLI::Option* scenario = command->add_option(
      "SCENARIO", options->scenario,
      "scenario file or its name: what its navigators count for themselves, too");
  command->add_option("--set", options->overrides, "PATH=VALUE: changes the scenario; repeat")
      ->allow_extra_args(false)
      ->needs(scenario);
  command->add_flag("--markdown", options->markdown, "as the table of src/statistics/README.md");
  command->callback([options] { ListMetrics(*options); });
}

namespace {

struct ParametersOptions {
  std::string scenario;
  std::vector<std::string> overrides;
  std::optional<core::Origin> origin;
  std::string word;  // of --search; empty: all
  bool csv = false;
};

bool Contains(const std::string& text, const std::string& word) {
  const auto same = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

// Returns the parameters with the word in their path, meaning or source.
std::vector<core::ParameterInfo> Containing(const std::string& word,
                                            std::vector<core::ParameterInfo> parameters) {
  std::erase_if(parameters, [&](const core::ParameterInfo& each) {
    return !Contains(each.path, word) && !Contains(each.doc, word) && !Contains(each.source, word);
  });
  return parameters;
}

void ListParameters(const ParametersOptions& options) {
  const scenario::Scenario scenario =
      options.scenario.empty()
          ? Defaults(options.overrides)
          : campaign::LoadScenarioFrom(campaign::ScenarioFile(options.scenario), options.overrides);
  const auto parameters = Containing(
      options.word, report::SelectParameters(scenario::ListParameters(scenario), options.origin));
  if (parameters.empty()) {
    throw core::UserError("--search", fmt::format("no parameter has \"{}\"", options.word),
                          "search for a part of a word, such as slope; `rockyard parameters` "
                          "lists all");
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
                      "scenario file or its name (default: the defaults)");
  AddSetOptions(*command, options->overrides);
  const std::vector<std::pair<std::string, core::Origin>> origins = {
      {"published", core::Origin::kPublished},
      {"calibrated", core::Origin::kCalibrated},
      {"assumed", core::Origin::kAssumed},
      {"setting", core::Origin::kSetting}};
  command->add_option("--origin", options->origin, "only those of one origin")
      ->transform(CLI::CheckedTransformer(origins));
  command->add_option("--search", options->word,
                      "only those with this in path, meaning or source, in upper or lower case");
  command->add_flag("--csv", options->csv, "CSV instead of Markdown");
  command->callback([options] { ListParameters(*options); });
}

}  // namespace rockyard::app

// rockyard run
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/campaign_options.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/run_campaign.h"
#include "app/run_source.h"
#include "report/measurement_text.h"
#include "report/run_files.h"
#include "report/summary_json.h"
#include "report/summary_text.h"
#include "scenario/ablations.h"
#include "scenario/load.h"
#include "truth/measurement_record.h"

namespace rockyard::app {
namespace {

struct RunOptions {
  CampaignOptions campaign;
  std::string scenario;
  std::string interval = "wilson";
  std::vector<std::string> ablations;
};

statistics::IntervalMethod MethodOf(const RunOptions& options) {
  return options.interval == "wilson" ? statistics::IntervalMethod::kWilson
                                      : statistics::IntervalMethod::kClopperPearson;
}

CampaignPlan PlanOf(const RunOptions& options) {
  std::vector<std::string> overrides = options.campaign.overrides;
  if (options.campaign.trials) {
    overrides.push_back(fmt::format("trials={}", *options.campaign.trials));
  }
  if (options.campaign.seed) overrides.push_back(fmt::format("seed={}", *options.campaign.seed));
  const scenario::Scenario scenario =
      scenario::WithAblations(LoadScenarioFrom(options.scenario, overrides), options.ablations)
          .scenario;
  std::string folder = scenario.name;
  for (const std::string& ablation : options.ablations) folder += fmt::format("-{}", ablation);
  return {.name = scenario.name,
          .design = "",
          .folder = DefaultFolder(folder, scenario.seed),
          .cells = {{.name = "", .scenario = scenario}}};
}

// An ablation that changes nothing may be a mistake: nothing of that kind is in the scenario.
void TellIdleAblations(const RunOptions& options) {
  if (options.ablations.empty() || options.campaign.quiet) return;
  const scenario::Scenario base = LoadScenarioFrom(options.scenario, options.campaign.overrides);
  for (const std::string& name : scenario::WithAblations(base, options.ablations).idle) {
    PrintNote(fmt::format("--ablate {} changes nothing in this scenario", name));
  }
}

void Show(const RunOptions& options, const std::string& text, const std::string& json,
          const std::filesystem::path& folder) {
  switch (options.campaign.output()) {
    case Output::kText:
      Print(text);
      Print(fmt::format("  results in {}\n", folder.string()));
      break;
    case Output::kJson:
      Print(json);
      break;
    case Output::kQuiet:
      break;
  }
}

// Derives the files from what is stored, and shows the summary.
void Report(const OpenedRun& run, const RunOptions& options) {
  const StoredRun stored = ReadRun(run.folder);
  report::RunDescription description =
      Describe(stored, batch::ThreadCount({.threads = options.campaign.threads}));
  description.resolved = scenario::ResolvedJson(
      LoadScenarioFrom(run.folder, std::vector{fmt::format("trials={}", stored.planned)}));
  const statistics::IntervalMethod method = MethodOf(options);
  const truth::RecordSchema& schema = stored.schema;
  if (truth::IsMeasurement(schema)) {
    const statistics::MeasurementSummary summary = report::WriteMeasurementFiles(
        run.folder, description, schema, stored.records, stored.prefix(), method);
    Show(options, report::MeasurementText(description, summary, StyleFor(stdout)),
         report::MeasurementJson(description, summary, method), run.folder);
    return;
  }
  const statistics::DriveSummary summary = report::WriteRunFiles(
      run.folder, description, schema, stored.records, stored.prefix(), method);
  Show(options, report::SummaryText(description, summary, StyleFor(stdout)),
       report::SummaryJson(description, summary, method), run.folder);
}

ExitCode Run(const RunOptions& options) {
  TellIdleAblations(options);
  return RunCampaign(
      options.campaign, [&] { return PlanOf(options); },
      [&](const OpenedRun& run, const batch::BatchResult&) { Report(run, options); });
}

std::string AblationNames() {
  std::string names;
  for (const scenario::Ablation& ablation : scenario::Ablations()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", ablation.name);
  }
  return names;
}

void AddOptions(CLI::App& command, RunOptions& options) {
  command
      .add_option("SCENARIO", options.scenario,
                  "scenario file, scenario.resolved.json, or the folder of a run")
      ->required();
  AddCampaignOptions(command, options.campaign);
  command
      .add_option("--ablate", options.ablations,
                  fmt::format("take one cause of failure away; repeat: {}", AblationNames()))
      ->allow_extra_args(false);
  command.add_option("--interval", options.interval, "of rates: wilson or clopper-pearson")
      ->check(CLI::IsMember({"wilson", "clopper-pearson"}))
      ->capture_default_str();
}

}  // namespace

void AddRunCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "Runs the trials of a scenario");
  AddOptions(*command, *options);
  command->callback([options, &exit_code] { exit_code = Run(*options); });
}

}  // namespace rockyard::app

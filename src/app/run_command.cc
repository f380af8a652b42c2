// rockyard run
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/campaign_options.h"
#include "app/command_text.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/dry_run.h"
#include "app/run_campaign.h"
#include "app/run_report.h"
#include "campaign/run_source.h"
#include "scenario/ablations.h"

namespace rockyard::app {
namespace {

struct RunOptions {
  CampaignOptions campaign;
  std::string scenario;
  std::string interval = "wilson";
  std::vector<std::string> ablations;
};

void AddSettings(const RunOptions& options, std::vector<std::string>& settings) {
  for (const std::string& setting : options.campaign.overrides) settings.push_back(setting);
  for (const std::string& name : options.ablations) settings.push_back("--ablate " + name);
}

campaign::CampaignPlan PlanOf(const RunOptions& options) {
  std::vector<std::string> overrides = options.campaign.overrides;
  if (options.campaign.trials) {
    overrides.push_back(fmt::format("trials={}", *options.campaign.trials));
  }
  if (options.campaign.seed) overrides.push_back(fmt::format("seed={}", *options.campaign.seed));
  const scenario::Scenario scenario =
      scenario::WithAblations(campaign::LoadScenarioFrom(options.scenario, overrides),
                              options.ablations)
          .scenario;
  std::string folder = scenario.name;
  for (const std::string& ablation : options.ablations) folder += fmt::format("-{}", ablation);
  std::optional<std::vector<std::string>> settings = campaign::SettingsOf(options.scenario);
  if (settings) AddSettings(options, *settings);
  return {.name = scenario.name,
          .design = "",
          .folder = campaign::DefaultFolder(folder, scenario.seed),
          .cells = {{.name = "", .scenario = scenario}},
          .settings = std::move(settings)};
}

// An ablation that changes nothing may be a mistake: nothing of that kind is in the scenario.
void TellIdleAblations(const RunOptions& options) {
  if (options.ablations.empty() || options.campaign.quiet) return;
  const scenario::Scenario base =
      campaign::LoadScenarioFrom(options.scenario, options.campaign.overrides);
  for (const std::string& name : scenario::WithAblations(base, options.ablations).idle) {
    PrintNote(fmt::format("--ablate {} changes nothing in this scenario", name));
  }
}

ReportOptions ReportOptionsOf(const RunOptions& options, const batch::BatchResult& result) {
  return {.output = options.campaign.output(),
          .method = options.interval == "wilson" ? statistics::IntervalMethod::kWilson
                                                 : statistics::IntervalMethod::kClopperPearson,
          .threads = options.campaign.threads,
          .resume = result.end == batch::BatchEnd::kStopped ? options.campaign.resume_command : "",
          .next = result.end == batch::BatchEnd::kStopped || options.campaign.traces.rules.empty()};
}

ExitCode Run(const RunOptions& options) {
  if (IsFirstRank()) TellIdleAblations(options);
  if (options.campaign.dry_run && !IsFirstRank()) return ExitCode::kDone;
  if (options.campaign.dry_run) return DryRun(options.campaign, PlanOf(options));
  return RunCampaign(
      options.campaign, [&] { return PlanOf(options); },
      [&](const campaign::OpenedRun& run, const batch::BatchResult& result) {
        ReportRun(run.folder, ReportOptionsOf(options, result));
      });
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
  command->callback([options, command, &exit_code] {
    options->campaign.resume_command = ResumeText(*command);
    exit_code = Run(*options);
  });
}

}  // namespace rockyard::app

// The command `rockyard run`: the trials of one scenario.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/campaign_options.h"
#include "app/command_text.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/run_display.h"
#include "app/run_folders.h"
#include "app/show_report.h"
#include "campaign/run.h"
#include "campaign/scenario_names.h"
#include "scenario/ablations.h"

namespace rockyard::app {
namespace {

struct RunOptions {
  CampaignOptions campaign;
  std::string scenario;
  std::vector<std::string> ablations;
};

ExitCode Run(const RunOptions& options) {
  const std::string source = campaign::ScenarioFile(options.scenario);
  RequireRuns(std::span(&source, 1));
  const campaign::RunRequest request{
      .source = source, .ablations = options.ablations, .campaign = options.campaign.Request()};
  if (options.campaign.dry_run) {
    if (!campaign::IsFirstRank()) return ExitCode::kDone;
    const campaign::Observer messages = MessagesToConsole(options.campaign.output());
    Print(RehearsalText(campaign::Rehearse(request, messages).OrThrow()));
    return ExitCode::kDone;
  }
  SharedFlag output_failed;
  const campaign::RunObserver shown = ShowRun(options.campaign, output_failed);
  return ShownOutcome(campaign::Run(request, shown, StopBySignal()).outcome, output_failed);
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
                  "scenario file or its name, scenario.resolved.json, or the folder of a run")
      ->required();
  AddCampaignOptions(command, options.campaign);
  command
      .add_option("--ablate", options.ablations,
                  fmt::format("take one cause of failure away; repeat: {}", AblationNames()))
      ->allow_extra_args(false);
  AddIntervalOption(command, options.campaign);
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

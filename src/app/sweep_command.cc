// The command `rockyard sweep`: the cells of a sweep file as one campaign.
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "app/campaign_options.h"
#include "app/command_text.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/run_display.h"
#include "app/show_report.h"
#include "campaign/run.h"
#include "campaign/scenario_names.h"

namespace rockyard::app {
namespace {

struct SweepOptions {
  CampaignOptions campaign;
  std::string file;
  std::optional<int> pilots;
};

// Serves --dry-run, on rank 0 alone.
ExitCode RehearseSweep(const campaign::SweepRequest& request, const SweepOptions& options) {
  if (!campaign::IsFirstRank()) return ExitCode::kDone;
  const campaign::Observer messages = MessagesToConsole(options.campaign.output());
  const campaign::SweepRehearsal told =
      campaign::RehearseSweep(request, options.pilots, messages).OrThrow();
  for (const std::string& note : told.plan.notes) PrintNote(note);
  if (options.campaign.output() == Output::kJson) PrintJson(told.plan.json);
  if (options.campaign.output() == Output::kText) Print(RehearsalText(told));
  return ExitCode::kDone;
}

ExitCode RunSweep(const SweepOptions& options) {
  const campaign::SweepRequest request{
      .file = campaign::ScenarioFile(options.file, campaign::Wanted::kSweep),
      .campaign = options.campaign.Request()};
  if (options.campaign.dry_run) return RehearseSweep(request, options);
  SharedFlag output_failed;
  const campaign::RunObserver shown = ShowRun(options.campaign, output_failed);
  return ShownOutcome(campaign::RunSweep(request, shown, StopBySignal()).outcome, output_failed);
}

}  // namespace

void AddSweepCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command = app.add_subcommand(
      "sweep", "Runs scenarios that differ along axes, such as rock abundance, as one campaign");
  command->add_option("SWEEP", options->file, "sweep file or its name (see scenarios/sweeps)")
      ->required();
  AddCampaignOptions(*command, options->campaign);
  AddIntervalOption(*command, options->campaign);
  command
      ->add_option("--pilots", options->pilots,
                   "trials of each cell from which --dry-run measures the cost; 0: none; without "
                   "it three, and more until the cost is known to a tenth or 20 s are gone")
      ->check(CLI::Range(0, 1000));
  command->callback([options, command, &exit_code] {
    options->campaign.resume_command = ResumeText(*command);
    exit_code = RunSweep(*options);
  });
}

}  // namespace rockyard::app

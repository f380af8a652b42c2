// rockyard sweep
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/campaign_options.h"
#include "app/command_text.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/run_campaign.h"
#include "app/sweep_plan.h"
#include "app/sweep_report.h"
#include "campaign/planned_trials.h"
#include "core/error.h"
#include "scenario/sweep.h"

namespace rockyard::app {
namespace {

struct SweepOptions {
  CampaignOptions campaign;
  std::string file;
  std::string interval = "wilson";
  int pilots = 3;
};

// Problems name the file, of which a cluster job may have many.
scenario::Sweep SweepOf(const SweepOptions& options) {
  try {
    return scenario::LoadSweep(options.file, {.overrides = options.campaign.overrides,
                                              .trials = options.campaign.trials,
                                              .seed = options.campaign.seed});
  } catch (const core::UserError& error) {
    std::vector<core::Problem> problems = error.problems();
    for (core::Problem& problem : problems) {
      if (problem.path.starts_with(options.file)) continue;
      problem.path = fmt::format("{}: {}", options.file, problem.path);
    }
    throw core::UserError(std::move(problems));
  }
}

campaign::CampaignPlan PlanOf(const SweepOptions& options, const scenario::Sweep& sweep) {
  campaign::CampaignPlan plan{
      .name = sweep.name,
      .design = sweep.document,
      .folder = campaign::DefaultFolder(sweep.name, static_cast<std::int64_t>(sweep.seed)),
      .cells = {},
      .settings = options.campaign.overrides};
  for (const scenario::SweepCell& cell : sweep.cells) {
    plan.cells.push_back({.name = cell.name, .scenario = cell.scenario});
  }
  return plan;
}

ReportOptions ReportOptionsOf(const SweepOptions& options, const batch::BatchResult& result) {
  return {.output = options.campaign.output(),
          .method = options.interval == "wilson" ? statistics::IntervalMethod::kWilson
                                                 : statistics::IntervalMethod::kClopperPearson,
          .threads = options.campaign.threads,
          .resume = result.end == batch::BatchEnd::kStopped ? options.campaign.resume_command : "",
          .next = result.end == batch::BatchEnd::kStopped || options.campaign.traces.rules.empty()};
}

// On rank 0 alone.
ExitCode DryRun(const SweepOptions& options) {
  if (!IsFirstRank()) return ExitCode::kDone;
  const scenario::Sweep sweep = SweepOf(options);
  const campaign::CampaignPlan plan = PlanOf(options, sweep);
  CheckPlan(options.campaign, plan);
  WriteSweepPlan(sweep, {.folder = options.campaign.out,
                         .trials = campaign::TrialsOf(RequestOf(options.campaign, plan), plan),
                         .pilots = options.pilots,
                         .output = options.campaign.output()});
  return ExitCode::kDone;
}

ExitCode RunSweep(const SweepOptions& options) {
  if (options.campaign.dry_run) return DryRun(options);
  // Read where trials are planned: on rank 0 alone, so that a mistake is told once.
  scenario::Sweep sweep;
  return RunCampaign(
      options.campaign,
      [&] {
        sweep = SweepOf(options);
        return PlanOf(options, sweep);
      },
      [&](const campaign::OpenedRun& run, const batch::BatchResult& result) {
        ReportSweep(run.store, sweep, ReportOptionsOf(options, result));
      });
}

}  // namespace

void AddSweepCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command = app.add_subcommand(
      "sweep", "Runs scenarios that differ along axes, such as rock abundance, as one campaign");
  command->add_option("FILE", options->file, "sweep file (see scenarios/sweeps)")->required();
  AddCampaignOptions(*command, options->campaign);
  command->add_option("--interval", options->interval, "of rates: wilson or clopper-pearson")
      ->check(CLI::IsMember({"wilson", "clopper-pearson"}))
      ->capture_default_str();
  command
      ->add_option("--pilots", options->pilots,
                   "trials of each cell from which --dry-run measures the cost; 0: none")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->callback([options, command, &exit_code] {
    options->campaign.resume_command = ResumeText(*command);
    exit_code = RunSweep(*options);
  });
}

}  // namespace rockyard::app

#include "app/dry_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "app/console.h"
#include "app/run_campaign.h"
#include "batch/executor.h"
#include "batch/pilot.h"
#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "campaign/planned_trials.h"
#include "experiments/experiment.h"

namespace rockyard::app {
namespace {

constexpr int kPilots = 3;

// Stored trials of the run in the folder that would go on; none where it would not.
std::int64_t StoredTrials(const campaign::OpenRequest& request) {
  const bool goes_on = request.existing == campaign::ExistingRun::kResume ||
                       request.existing == campaign::ExistingRun::kResumeOrSetAside;
  if (!goes_on || !batch::HoldsStore(request.folder)) return 0;
  return static_cast<std::int64_t>(batch::ResultStore::Read(request.folder).Finished().size());
}

std::string CostText(const batch::PilotCost& pilot, std::int64_t pending, std::string_view at_most,
                     int threads) {
  const double count = static_cast<double>(pending);
  const double total_s = count * pilot.mean_s;
  // What three pilots leave open of the mean, and the scatter of the trials to come.
  const double error_s =
      std::sqrt(pilot.variance_s2 * count * (1.0 + count / static_cast<double>(pilot.trials)));
  return fmt::format(
      "  cost {}{:.3g} CPU seconds, give or take {:.2g}: {:.3g} s a trial in {} pilot trials; "
      "about "
      "{:.3g} s on {} threads\n",
      at_most, total_s, error_s, pilot.mean_s, pilot.trials, total_s / threads, threads);
}

// Empty where none are asked for. Which trials fail is not known before.
std::string TracesText(const CampaignOptions& options, std::int64_t trials) {
  const campaign::TraceRetention retention = options.traces.retention();
  if (!retention.any()) return "";
  return fmt::format("  traces of {} (of at most {} trials), which are driven twice\n",
                     campaign::RetentionText(retention), trials);
}

}  // namespace

ExitCode DryRun(const CampaignOptions& options, const campaign::CampaignPlan& plan) {
  CheckPlan(options, plan);
  const campaign::OpenRequest request = RequestOf(options, plan);
  const scenario::Scenario& scenario = plan.cells.front().scenario;
  const auto experiment = experiments::MakeExperiment(scenario);
  campaign::CheckFolder(request, campaign::IdentityOf(plan, experiment->schema(), request.shard));
  const std::int64_t stored = StoredTrials(request);
  const campaign::PlannedTrials planned = campaign::TrialsOf(request, plan);
  const std::int64_t pending = std::max<std::int64_t>(planned.total - stored, 0);
  const batch::PilotCost pilot =
      batch::RunPilots(*experiment, static_cast<std::uint64_t>(scenario.seed), kPilots);
  Print(Wrapped(fmt::format("{}, seed {}: {} planned, {} stored, {}{} to run\n", plan.name,
                            scenario.seed, planned.text(), stored,
                            planned.at_most ? "at most " : "", pending)));
  Print(Wrapped(CostText(pilot, pending, planned.at_most ? "at most " : "",
                         batch::ThreadCount({.threads = options.threads}))));
  Print(Wrapped(TracesText(options, planned.total)));
  Print(fmt::format("  into {}; nothing was written\n", request.folder.string()));
  return ExitCode::kDone;
}

}  // namespace rockyard::app

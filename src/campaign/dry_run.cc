#include "campaign/dry_run.h"

#include <algorithm>
#include <cstdint>

#include "batch/executor.h"
#include "batch/pilot.h"
#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "campaign/run_campaign.h"
#include "experiments/make_experiment.h"

namespace rockyard::campaign {
namespace {

constexpr int kPilots = 3;

// Stored trials of the run in the folder that would go on; none where it would not.
std::int64_t StoredTrials(const OpenRequest& request) {
  const bool goes_on = request.existing == ExistingRun::kResume ||
                       request.existing == ExistingRun::kResumeOrSetAside;
  if (!goes_on || !batch::ResultStore::HasBegun(request.folder)) return 0;
  return static_cast<std::int64_t>(batch::ResultStore::Read(request.folder).Finished().size());
}

}  // namespace

DryRun Rehearse(const CampaignRequest& request, const CampaignPlan& plan) {
  CheckPlan(request, plan);
  const OpenRequest opening = OpeningOf(request, plan);
  const scenario::Scenario& scenario = plan.cells.front().scenario;
  const auto experiment = experiments::MakeExperiment(scenario.experiment, scenario.drive);
  CheckFolder(opening, IdentityOf(plan, experiment->schema(), opening.shard));
  DryRun told{.name = plan.name,
              .seed = scenario.seed,
              .folder = opening.folder,
              .planned = TrialsOf(opening, plan),
              .stored = StoredTrials(opening),
              .pending = 0,
              .pilot = {},
              .threads = batch::ThreadCount({.threads = request.containment.threads}),
              .traces = request.traces.retention()};
  told.pending = std::max<std::int64_t>(told.planned.total - told.stored, 0);
  told.pilot = batch::RunPilots(*experiment, static_cast<std::uint64_t>(scenario.seed), kPilots);
  return told;
}

}  // namespace rockyard::campaign

// What a run or a sweep would do and cost, for --dry-run of the commands `run` and `sweep`. Costs
// are known from a few trials, the pilots. No record or store depends on it: pilots are forgotten.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "batch/batch_session.h"
#include "campaign/campaign_traces.h"
#include "campaign/open_run.h"
#include "campaign/run_campaign.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {

struct DryRun {
  std::string name;
  std::int64_t seed = 0;
  std::filesystem::path folder;
  PlannedTrials planned;
  std::int64_t stored = 0;   // of a run in the folder that would go on
  std::int64_t pending = 0;  // at most, where a rule may end it before
  batch::PilotCost pilot;    // of the first cell
  int threads = 1;
  std::int64_t memory_B = 0;  // of the run, resident
  TraceRetention traces;      // which trials are driven twice
};

// Returns what a run would do; writes nothing. Throws core::UserError where the request or the
// folder forbids the run, as RunCampaign would tell it. Cost: three trials, and more (RunPilots).
DryRun Rehearse(const CampaignRequest& request, const CampaignPlan& plan);

// Runs first trials of every cell, or, where there are more than a hundred cells, of 50 to 100 of
// them, evenly spread; with the seed of the campaign, on this thread. `trials` of each; without it
// three, and then more of the cells that leave most open, until twelve tell that the standard error
// of the whole cost is below a tenth of it, or the pilots have taken 20 s of CPU time. `planned` is
// by cell.
std::vector<batch::PilotCost> RunPilots(const scenario::Sweep& sweep,
                                        const std::vector<std::int64_t>& planned,
                                        std::optional<int> trials);

struct CampaignCost {
  std::int64_t pilots = 0;
  double total_s = 0.0;  // CPU time of every trial of every cell
  // The standard error of total_s: what the pilots leave open of the mean of each cell, and the
  // scatter of the trials. It is computed from the cells with pilots; the other cells are taken to
  // cost as much as the mean of these. Absent where each cell had one pilot, which tells of no
  // scatter.
  std::optional<double> standard_error_s = {};
  double slowest_s = 0.0;     // pilot
  std::int64_t memory_B = 0;  // of the campaign on one thread, resident
  std::int64_t thread_B = 0;  // of each further thread
};

struct SweepPlanOptions {
  std::filesystem::path folder;  // empty: results/runs/<name>-seed<seed>-plan
  PlannedTrials trials;          // of the cells of the sweep
  std::optional<int> pilots;     // trials of each cell that are run for their cost; 0: none
};

// What WriteSweepPlan wrote.
struct SweepPlan {
  std::filesystem::path folder;
  std::string json;  // plan.json
  CampaignCost cost;
  std::vector<std::string> notes;  // about pilots that are equal
};

// Writes plan.json, plan.csv and cells/<number>-<name>.json (each resolved scenario) into the
// folder. The folder must not exist, be empty, or hold nothing but a plan or what an interrupted
// dry run left of one. The pilots (RunPilots) run before anything is written; only their CPU time
// is kept, as they are no results. Cells whose pilots come out equal to the last bit are named,
// since a setting that changes no trial has no effect. Throws core::UserError where the folder
// cannot be used. Cost: the pilots, on one thread.
SweepPlan WriteSweepPlan(const scenario::Sweep& sweep, const SweepPlanOptions& options);

}  // namespace rockyard::campaign

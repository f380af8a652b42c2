// What a run would do.
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
  batch::PilotCost pilot;    // of three trials of the first cell
  int threads = 1;
  TraceRetention traces;  // which trials are driven twice
};

// Writes nothing. Throws core::UserError as RunCampaign would tell it, where the request or the
// folder forbids the run. Cost: three trials.
DryRun Rehearse(const CampaignRequest& request, const CampaignPlan& plan);

// What a sweep would run, and what it would cost: known from a few trials of each cell.

// Runs the first `trials` trials of every cell, of about a hundred evenly spread cells where there
// are more, with the seed of the campaign. On this thread.
std::vector<batch::PilotCost> RunPilots(const scenario::Sweep& sweep, int trials);

struct CampaignCost {
  std::int64_t pilots = 0;
  double total_s = 0.0;  // CPU time of every trial of every cell
  // Of that: what the pilots leave open of each cell's mean, and the scatter of the trials. Of the
  // cells with pilots; the others are taken to cost as much as the mean of these.
  // Absent where each of them had one pilot, which tells of no scatter.
  std::optional<double> standard_error_s = {};
  double slowest_s = 0.0;  // pilot
};

struct SweepPlanOptions {
  std::filesystem::path folder;  // empty: results/runs/<name>-seed<seed>-plan
  PlannedTrials trials;          // of the cells of the sweep
  int pilots = 3;                // trials of each cell that are run for their cost; 0: none
};

// What was written.
struct SweepPlan {
  std::filesystem::path folder;
  std::string json;  // plan.json
  CampaignCost cost;
  std::vector<std::string> notes;  // about pilots that are equal
};

// Writes plan.json, plan.csv and cells/<number>-<name>.json (each resolved scenario) into the
// folder, which must not exist, be empty, or hold nothing but a plan or what an interrupted dry run
// left of one; the pilots run before anything is written. Nothing that is measured of the pilots
// but their CPU time is kept: they are no results. With a hundred cells or more only a hundred of
// them, evenly spread, have pilots, which all use the seed of the campaign: cells whose pilots come
// out equal to the last bit are named, since a setting that changes no trial has no effect. Throws
// core::UserError where the folder cannot be used. Cost: the pilots, on one thread.
SweepPlan WriteSweepPlan(const scenario::Sweep& sweep, const SweepPlanOptions& options);

}  // namespace rockyard::campaign

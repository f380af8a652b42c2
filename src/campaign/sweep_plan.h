// What a sweep would run, and what it would cost.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "campaign/planned_trials.h"
#include "campaign/sweep_pilot.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {

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

// A few trials of each cell of a sweep, to know what the campaign will cost.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "batch/pilot.h"
#include "campaign/planned_trials.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {

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

// Of the trials that are planned, by cell as the pilots are.
CampaignCost ExpectedCost(const PlannedTrials& planned,
                          const std::vector<batch::PilotCost>& pilots);

}  // namespace rockyard::campaign

// What a run would do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "batch/pilot.h"
#include "campaign/campaign_request.h"
#include "campaign/open_run.h"
#include "campaign/trace_retention.h"

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

}  // namespace rockyard::campaign

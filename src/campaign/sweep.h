// Runs scenarios that differ along axes as one campaign.
#pragma once

#include <filesystem>

#include "campaign/campaign_request.h"
#include "campaign/open_run.h"
#include "campaign/run_campaign.h"
#include "campaign/sweep_plan.h"
#include "core/result.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {

struct SweepRequest {
  std::filesystem::path file;  // as scenario/sweep.h reads it
  CampaignRequest campaign = {};
};

// As Run does of one scenario. Never throws.
WorkResult RunSweep(const SweepRequest& request, const RunObserver& observer = {},
                    const Stop& stop = {});

struct SweepRehearsal {
  scenario::Sweep sweep;
  PlannedTrials trials;
  SweepPlan plan;
};

// What RunSweep would do, and cost by that many trials of each cell: written into the folder of the
// request (sweep_plan.h), which is no folder of a campaign.
core::Result<SweepRehearsal> RehearseSweep(const SweepRequest& request, int pilots,
                                           const Observer& observer = {});

}  // namespace rockyard::campaign

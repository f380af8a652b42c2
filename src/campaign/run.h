// Runs the trials of a scenario.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "campaign/campaign_request.h"
#include "campaign/dry_run.h"
#include "campaign/run_campaign.h"
#include "core/result.h"

namespace rockyard::campaign {

struct RunRequest {
  std::filesystem::path source;  // scenario file, scenario.resolved.json, or a run's folder
  std::vector<std::string> ablations = {};  // names as in scenario/ablations.h
  CampaignRequest campaign = {};
};

// Runs what the folder lacks of the trials, writes what follows from them, then the traces that are
// asked for. Never throws; with a supervisor see RunContained. The trials do not depend on threads,
// ranks, or where earlier calls stopped.
WorkResult Run(const RunRequest& request, const RunObserver& observer = {}, const Stop& stop = {});

// What Run would do; writes nothing. The observer is told what Run would say before it begins.
core::Result<DryRun> Rehearse(const RunRequest& request, const Observer& observer = {});

}  // namespace rockyard::campaign

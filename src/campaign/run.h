// Runs the trials of a scenario or of a sweep, and puts shards together; says what a run would do.
// The commands `run`, `sweep` and `merge` call it, and programs by way of api/campaign.h.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "batch/campaign_differences.h"
#include "campaign/dry_run.h"
#include "campaign/folder_report.h"
#include "campaign/journal.h"
#include "campaign/open_run.h"
#include "campaign/run_campaign.h"
#include "campaign/work.h"
#include "core/result.h"
#include "scenario/sweep.h"

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

// Returns what Run would do; writes nothing. The observer is told what Run would say before it
// begins.
core::Result<DryRun> Rehearse(const RunRequest& request, const Observer& observer = {});

struct SweepRequest {
  std::filesystem::path file;  // as scenario/sweep.h reads it
  CampaignRequest campaign = {};
};

// Runs scenarios that differ along axes as one campaign, as Run does one scenario. Never throws.
WorkResult RunSweep(const SweepRequest& request, const RunObserver& observer = {},
                    const Stop& stop = {});

struct SweepRehearsal {
  scenario::Sweep sweep;
  PlannedTrials trials;
  SweepPlan plan;
};

// Returns what RunSweep would do and cost, by that many pilots of each cell (RunPilots), and writes
// it into the folder of the request (WriteSweepPlan), which is no folder of a campaign.
core::Result<SweepRehearsal> RehearseSweep(const SweepRequest& request, std::optional<int> pilots,
                                           const Observer& observer = {});

struct MergeRequest {
  std::vector<std::filesystem::path> shards;
  std::filesystem::path folder;  // a new one
  batch::BuildPolicy build = batch::BuildPolicy::kSame;
  bool partial = false;  // shards or trials may be missing: they are pending then
};

struct MergeObserver : Observer {
  // Called once the files of the merged folder have been written.
  std::function<void(const FolderReport& report)> reported = {};
};

// Puts the shards of a campaign together. The folder appears when it is whole. Never throws. What
// is merged stays, whatever becomes of the files that follow from it: the outcome is kFailed where
// one cannot be written.
WorkResult Merge(const MergeRequest& request, const MergeObserver& observer = {});

}  // namespace rockyard::campaign

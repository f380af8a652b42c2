// What running one scenario and running a sweep have in common: open, run, report, judge, trace.
#pragma once

#include <filesystem>
#include <functional>

#include "batch/executor.h"
#include "campaign/campaign_process.h"
#include "campaign/campaign_request.h"
#include "campaign/campaign_traces.h"
#include "campaign/folder_report.h"
#include "campaign/journal.h"
#include "campaign/observer.h"
#include "campaign/open_run.h"
#include "campaign/outcome.h"
#include "campaign/stop.h"

namespace rockyard::campaign {

// What a caller is told of a campaign while it goes on.
struct RunObserver : Observer {
  // About twice a second while trials run, by one thread at a time, and once when they have ended.
  std::function<void(const batch::Progress& progress, Moment moment)> trials = {};
  // The files of the folder are written; also after an early end.
  std::function<void(const FolderReport& report, batch::BatchEnd end)> reported = {};
  // As traces are written, by one thread at a time.
  std::function<void(const TraceProgress& progress, Moment moment)> traces = {};
  // No more traces will be written.
  std::function<void(const std::filesystem::path& folder, Outcome outcome)> traced = {};
};

// Makes the plan from the request; may be called more than once, in several processes. Throws
// core::UserError.
using CampaignPlanner = std::function<CampaignPlan()>;

// Derives files from the store. Called in the process that ran the trials, when no more will run;
// also after an early end. What it throws ends in Outcome::kFailed.
using CampaignReporter = std::function<FolderReport(const OpenedRun& run)>;

// What opening its folder is asked for.
OpenRequest OpeningOf(const CampaignRequest& request, const CampaignPlan& plan);

// Runs a campaign in processes as the request asks (campaign_process.h).
Outcome RunCampaign(const CampaignRequest& request, const CampaignPlanner& planner,
                    const CampaignReporter& reporter, const RunObserver& observer,
                    const Contact& contact);

}  // namespace rockyard::campaign

// What `rockyard run` and `rockyard sweep` have in common: open, run, report, judge.
#pragma once

#include <functional>

#include "app/campaign_options.h"
#include "app/exit_code.h"
#include "batch/executor.h"
#include "campaign/open_run.h"

namespace rockyard::app {

// Makes the plan from the command line; may be called more than once, in several processes. Throws
// core::UserError.
using CampaignPlanner = std::function<campaign::CampaignPlan()>;

// Derives files from the store and shows what they say. Called in the process that ran the trials,
// when no more will run; also after an interruption. What it throws ends in ExitCode::kFailed.
using CampaignReporter =
    std::function<void(const campaign::OpenedRun& run, const batch::BatchResult& result)>;

// Throws core::UserError with everything that the options ask of this plan and that cannot be: a
// stopping rule of a shard, where nothing drives, or where trials share layouts and are not
// independent; traces that are asked for with a rule that is none, or where nothing drives; cells
// whose records have different columns.
void CheckPlan(const CampaignOptions& options, const campaign::CampaignPlan& plan);

// The request that the options make of a plan.
campaign::OpenRequest RequestOf(const CampaignOptions& options, const campaign::CampaignPlan& plan);

// Runs what the options ask for in processes as they ask (campaign_process.h), shows the progress
// on standard error, reports, and returns the exit code. Not for --dry-run.
ExitCode RunCampaign(const CampaignOptions& options, const CampaignPlanner& planner,
                     const CampaignReporter& reporter);

}  // namespace rockyard::app

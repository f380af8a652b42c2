// What running one scenario and running a sweep have in common: open, run, report, judge, trace.
// run.h and the dry runs are made of it; the command line fills the request.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "batch/campaign.h"
#include "batch/campaign_differences.h"
#include "batch/executor.h"
#include "batch/work_plan.h"
#include "campaign/campaign_process.h"
#include "campaign/campaign_traces.h"
#include "campaign/folder_report.h"
#include "campaign/journal.h"
#include "campaign/open_run.h"
#include "campaign/stop.h"
#include "campaign/work.h"
#include "statistics/proportions.h"

namespace rockyard::campaign {

// What can be asked for alike of running one scenario and of running a sweep.
struct CampaignRequest {
  std::optional<std::int64_t> trials = {};  // absent: the scenario's, or those planned before
  std::optional<std::int64_t> seed = {};    // absent: the scenario's
  std::vector<std::string> overrides = {};  // "PATH=VALUE"
  std::filesystem::path folder = {};        // empty: DefaultFolder
  ExistingRun existing = ExistingRun::kRefuse;
  batch::BuildPolicy build = batch::BuildPolicy::kSame;
  bool retry_faults = false;                     // OpenRequest::retry_faults
  std::string shard = {};                        // "I/N"; empty: the whole campaign
  std::optional<batch::StoppingRule> rule = {};  // none: every planned trial
  double max_fault_fraction = 0.01;              // of all trials and of those of each cell
  statistics::IntervalMethod method = statistics::IntervalMethod::kWilson;  // of rates
  // The default is for a plain caller: trials run in this process, however long one takes.
  ContainmentOptions containment = {.supervisor = false, .trial_cpu_limit_s = 0.0, .threads = 0};
  TraceOptions traces = {};  // written once all trials are stored
  // The values that files leave out, and the navigators and estimators that they may name.
  scenario::Scenario defaults = {};
  // Is given each cell before its trials run, with its number, in every process that runs some.
  // Must change no record: benchmarks record what navigators do.
  std::function<void(std::size_t index, CampaignCell& cell)> prepare = {};
  // Called once the store is open, by the process that makes it, before trials run. `anew`: it
  // holds none.
  std::function<void(const std::filesystem::path& folder, bool anew)> opened = {};
  // What a program that links rockyard is known by, beside rockyard's own build; "" of the command.
  std::string program = {};

  // Returns the shard. Throws core::UserError where the text is none of 1/N ... N/N.
  batch::Shard ParseShard() const;
};

// Throws core::UserError with everything that the request asks of this plan and that cannot be: a
// stopping rule for a shard, where nothing drives, or where trials share layouts and are not
// independent; traces by a text that is no rule, the worst of a shard, or traces where nothing
// drives.
void CheckPlan(const CampaignRequest& request, const CampaignPlan& plan);

// What a caller is told of a campaign while it goes on.
struct RunObserver : Observer {
  // Called about twice a second while trials run, by one thread at a time, and once when they have
  // ended.
  std::function<void(const batch::Progress& progress, Moment moment)> trials = {};
  // Called when the files of the folder are written; also after an early end.
  std::function<void(const FolderReport& report, batch::BatchEnd end)> reported = {};
  // Called as traces are written, by one thread at a time.
  std::function<void(const TraceProgress& progress, Moment moment)> traces = {};
  // Called when no more traces will be written.
  std::function<void(const std::filesystem::path& folder, Outcome outcome)> traced = {};
};

// Makes the plan from the request; may be called more than once, in several processes. Throws
// core::UserError.
using CampaignPlanner = std::function<CampaignPlan()>;

// Derives files from the store. It is called in the process that ran the trials, when no more will
// run; also after an early end. What it throws ends in Outcome::kFailed.
using CampaignReporter = std::function<FolderReport(const OpenedRun& run)>;

// Returns what opening the folder of the plan is asked for.
OpenRequest OpeningOf(const CampaignRequest& request, const CampaignPlan& plan);

// Runs a campaign in processes as the request asks (campaign_process.h).
Outcome RunCampaign(const CampaignRequest& request, const CampaignPlanner& planner,
                    const CampaignReporter& reporter, const RunObserver& observer,
                    const Contact& contact);

}  // namespace rockyard::campaign

// What running one scenario and running a sweep can be asked for alike, and whether a plan can be
// run like that.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "batch/campaign.h"
#include "batch/campaign_differences.h"
#include "batch/stopping_rule.h"
#include "campaign/campaign_process.h"
#include "campaign/open_run.h"
#include "campaign/trace_retention.h"
#include "statistics/proportions.h"

namespace rockyard::campaign {

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
  // As a plain caller has it: in this process, however long a trial takes.
  ContainmentOptions containment = {.supervisor = false, .trial_cpu_limit_s = 0.0, .threads = 0};
  TraceOptions traces = {};  // written once all trials are stored

  // Throws core::UserError where the text is none of 1/N ... N/N.
  batch::Shard ParseShard() const;
};

// Throws core::UserError with everything that is asked of this plan and that cannot be: a stopping
// rule of a shard, where nothing drives, or where trials share layouts and are not independent;
// traces that are asked for with a rule that is none, or where nothing drives.
void CheckPlan(const CampaignRequest& request, const CampaignPlan& plan);

}  // namespace rockyard::campaign

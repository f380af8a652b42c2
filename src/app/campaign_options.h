// The options that `rockyard run` and `rockyard sweep` share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "batch/campaign.h"
#include "batch/stopping_rule.h"
#include "campaign/open_run.h"
#include "campaign/trace_retention.h"

namespace CLI {
class App;
}

namespace rockyard::app {

enum class Output { kText, kJson, kQuiet };

struct CampaignOptions {
  std::optional<std::int64_t> trials;  // absent: the scenario's, or those planned before
  std::optional<std::int64_t> seed;    // absent: the scenario's
  std::vector<std::string> overrides;  // "PATH=VALUE"
  std::string out;                     // empty: the command chooses
  int threads = 0;                     // 0: as many as the machine runs at once
  double max_fault_fraction = 0.01;
  bool resume = false;
  bool force = false;
  bool any_build = false;
  bool json = false;
  bool quiet = false;
  bool dry_run = false;
  bool no_supervisor = false;
  double trial_cpu_limit_s = 600.0;  // 0: none
  std::string shard_text;            // "I/N"; empty: the whole campaign
  double until_half_width = 0.0;     // 0: no stopping rule
  std::string allocate = "uniform";
  campaign::TraceOptions traces;
  std::string resume_command;  // as ResumeText gives it
  batch::StoppingRule rule;    // where until_half_width is given; its half-width is that one

  Output output() const;
  campaign::ExistingRun existing() const;
  std::optional<batch::StoppingRule> stopping_rule() const;
  // Throws core::UserError where the text is none of 1/N ... N/N, or does not go with the rule.
  batch::Shard shard() const;
};

// Adds them to a command, --dry-run included, which the command itself must obey. `options` must
// outlive it.
void AddCampaignOptions(CLI::App& command, CampaignOptions& options);

}  // namespace rockyard::app

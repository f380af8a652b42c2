// The options that `rockyard run` and `rockyard sweep` share.
#pragma once

#include <string>

#include "batch/work_plan.h"
#include "campaign/run_campaign.h"

namespace CLI {
class App;
}

namespace rockyard::app {

enum class Output { kText, kJson, kQuiet };

struct CampaignOptions {
  campaign::CampaignRequest request = {
      .containment = {.supervisor = true, .trial_cpu_limit_s = 600.0, .threads = 0}};
  bool resume = false;
  bool force = false;
  bool any_build = false;
  bool json = false;
  bool quiet = false;
  bool dry_run = false;
  bool no_supervisor = false;
  std::string out;
  double until_half_width = 0.0;  // 0: no stopping rule
  std::string allocate = "uniform";
  std::string interval = "wilson";
  batch::StoppingRule rule;    // where until_half_width is given; its half-width is that one
  std::string resume_command;  // as ResumeText gives it

  Output output() const;
  // What all of them ask for.
  campaign::CampaignRequest Request() const;
};

// Adds them to a command, --dry-run included, which the command itself must obey. `options` must
// outlive it.
void AddCampaignOptions(CLI::App& command, CampaignOptions& options);

// Adds --interval, which comes after the command's own options.
void AddIntervalOption(CLI::App& command, CampaignOptions& options);

}  // namespace rockyard::app

// The options that the commands `run` and `sweep` share, and the request of a campaign that they
// make.
#pragma once

#include <string>

#include "batch/work_plan.h"
#include "campaign/run_campaign.h"

namespace CLI {
class App;
}

namespace rockyard::app {

// What standard output gets of a campaign: text for people, summary.json, or nothing.
enum class Output { kText, kJson, kQuiet };

// What the parser fills. `request` holds the options that a request takes as they are; Request()
// adds the others.
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
  batch::StoppingRule rule;    // where until_half_width is above 0; Request() sets its half-width
  bool names_next = true;      // false: the command itself says what comes next
  std::string resume_command;  // ResumeText of the command that was parsed

  Output output() const;
  // Returns the request that all options together make.
  campaign::CampaignRequest Request() const;
};

// Adds the options to a command, all but --interval. The command itself must obey --dry-run.
// `options` must outlive the command.
void AddCampaignOptions(CLI::App& command, CampaignOptions& options);

// Adds --interval. It is apart, so that help shows it after the command's own options.
void AddIntervalOption(CLI::App& command, CampaignOptions& options);

}  // namespace rockyard::app

// What people read of a campaign: its results, which the commands `run`, `sweep` and `merge` print,
// and the preview of --dry-run.
#pragma once

#include <string>

#include "app/campaign_options.h"
#include "campaign/dry_run.h"
#include "campaign/folder_report.h"
#include "campaign/run.h"

namespace rockyard::app {

struct ShowOptions {
  Output output = Output::kText;
  std::string resume;  // the command that goes on with a campaign that stopped; empty: none did
  bool next = true;    // false: traces follow, and ShowRun prints the next command after them
};

// Prints to standard output: the table and the next command, or summary.json, or nothing, as
// `options.output` says.
void ShowReport(const campaign::FolderReport& report, const ShowOptions& options);

// Returns what a run would do and cost.
std::string RehearsalText(const campaign::DryRun& told);

// Returns what a sweep would run and cost, and where its plan is.
std::string RehearsalText(const campaign::SweepRehearsal& told);

}  // namespace rockyard::app

// Prints the results in the folder of a campaign to standard output, and the preview that
// `--dry-run` gives.
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
  bool next = true;    // false: more is told after the report, and then the next command
};

// A table and the next command, or summary.json, or nothing.
void ShowReport(const campaign::FolderReport& report, const ShowOptions& options);

// What a run would do and cost.
std::string RehearsalText(const campaign::DryRun& told);

// What a sweep would run and cost, and where its plan is.
std::string RehearsalText(const campaign::SweepRehearsal& told);

}  // namespace rockyard::app

// What a folder says once its trials have been run: files and a summary on the terminal.
#pragma once

#include <filesystem>
#include <string>

#include "app/campaign_options.h"
#include "statistics/proportions.h"

namespace rockyard::app {

struct ReportOptions {
  Output output = Output::kText;
  statistics::IntervalMethod method = statistics::IntervalMethod::kWilson;
  int threads = 0;     // as the summary names them; 0: as many as the machine runs at once
  std::string resume;  // the command that goes on with a campaign that stopped; empty: none did
  bool next = true;    // false: more is told after the report, and then the next command
};

// Of a run of one scenario. A shard gets trials.csv and a summary.json without rates.
void ReportRun(const std::filesystem::path& folder, const ReportOptions& options);

}  // namespace rockyard::app

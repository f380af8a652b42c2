// Of a run of one scenario: the files that follow from its store, and what they say.
#pragma once

#include <filesystem>

#include "campaign/folder_report.h"
#include "statistics/proportions.h"

namespace rockyard::campaign {

struct ReportSettings {
  statistics::IntervalMethod method = statistics::IntervalMethod::kWilson;
  int threads = 0;  // as the summary names them; 0: as many as the machine runs at once
};

// Writes them into the folder. A shard gets trials.csv and a summary.json without rates. Throws
// core::UserError where a file cannot be written.
RunReport ReportRun(const std::filesystem::path& folder, const ReportSettings& settings);

}  // namespace rockyard::campaign

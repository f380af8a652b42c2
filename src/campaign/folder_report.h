// What the folder of a campaign says once its trials have been run, and the files that say it.
#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "batch/campaign.h"
#include "batch/result_store.h"
#include "report/run_description.h"
#include "report/sweep_files.h"
#include "report/sweep_summary.h"
#include "scenario/sweep.h"
#include "statistics/cell_summary.h"
#include "statistics/drive_summary.h"
#include "statistics/proportions.h"

namespace rockyard::campaign {

// Of one scenario.
struct RunReport {
  std::filesystem::path folder;
  report::RunDescription description;
  // Nothing of a shard, of which no rate can be told.
  std::variant<std::monostate, statistics::DriveSummary, statistics::MeasurementSummary> summary;
  statistics::IntervalMethod method = statistics::IntervalMethod::kWilson;
};

struct SweepReport {
  std::filesystem::path folder;
  scenario::Sweep sweep;
  report::SweepSummary summary;
  report::SweepDescription description;
};

// Of a part of a sweep, of which no rate can be told.
struct SweepShardReport {
  std::filesystem::path folder;
  std::string name;
  batch::Shard shard;
  report::Accounting total;
  std::string json;  // summary.json
};

using FolderReport = std::variant<RunReport, SweepReport, SweepShardReport>;

struct ReportSettings {
  statistics::IntervalMethod method = statistics::IntervalMethod::kWilson;
  int threads = 0;  // as the summary names them; 0: as many as the machine runs at once
};

// Writes them into the folder. A shard gets trials.csv and a summary.json without rates. Throws
// core::UserError where a file cannot be written.
RunReport ReportRun(const std::filesystem::path& folder, const ReportSettings& settings);

// `store`: of a campaign with the cells of the sweep. Writes the files into its folder. Of a shard
// no rate can be told, and so it gets a summary.json without any. Memory: the records of one cell.
// Throws core::UserError where a file cannot be written.
FolderReport ReportSweep(const batch::ResultStore& store, const scenario::Sweep& sweep,
                         const ReportSettings& settings);

}  // namespace rockyard::campaign

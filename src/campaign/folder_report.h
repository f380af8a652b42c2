// What the folder of a campaign says once its trials have been run, and the files that say it.
// Runs, sweeps and merges write it; their commands show it. No record depends on it: all follows
// from the store, and is written anew by every session.
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

// The report of one scenario.
struct RunReport {
  std::filesystem::path folder;
  report::RunDescription description;
  // Absent for a shard, of which no rate can be told.
  std::variant<std::monostate, statistics::DriveSummary, statistics::MeasurementSummary> summary;
  statistics::IntervalMethod method = statistics::IntervalMethod::kWilson;
};

struct SweepReport {
  std::filesystem::path folder;
  scenario::Sweep sweep;
  report::SweepSummary summary;
  report::SweepDescription description;
};

// The report of a shard of a sweep, of which no rate can be told.
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

// Writes the files that a run derives from its store into its folder. A shard gets trials.csv,
// scenario.resolved.json and a summary.json without rates. Throws core::UserError where a file
// cannot be written. The names of all files must stand in kDerivedFiles (open_run.cc).
RunReport ReportRun(const std::filesystem::path& folder, const ReportSettings& settings);

// Writes the files that a sweep derives from `store` into its folder. The store must be of a
// campaign with the cells of the sweep. A shard gets a summary.json without rates. Memory: the
// records of one cell. Throws core::UserError where a file cannot be written.
FolderReport ReportSweep(const batch::ResultStore& store, const scenario::Sweep& sweep,
                         const ReportSettings& settings);

}  // namespace rockyard::campaign

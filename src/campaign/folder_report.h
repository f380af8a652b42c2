// What the folder of a campaign says once its trials have been run.
#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "batch/campaign.h"
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

}  // namespace rockyard::campaign

// Two runs, compared, for the command `compare` and for programs. No record depends on it; the
// outcome is an exit code.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "batch/campaign_differences.h"
#include "campaign/run_source.h"
#include "campaign/work.h"
#include "core/result.h"
#include "report/paired_comparison.h"
#include "statistics/cell_summary.h"

namespace rockyard::campaign {

struct CompareRequest {
  std::filesystem::path first;
  std::filesystem::path second;
  std::string cell = {};         // of a campaign: its name or number
  std::string second_cell = {};  // where it is another one
};

// What came of a comparison. Drives are compared trial by trial where their seeds are the same,
// measurements cell by cell.
struct Comparison {
  StoredRun first;  // both without the values of their records
  StoredRun second;
  std::variant<report::RunComparison, statistics::CellComparison> found;
  std::vector<batch::ScenarioDifference> settings;  // in which they differ
  Outcome outcome = Outcome::kDone;  // kDiffers where a rate of a cell does; drives describe
};

// Compares two runs. Memory: for drives 200 bytes a trial of each and some columns (CompareDrives
// in run_source.h); for measurements the records of both runs.
core::Result<Comparison> Compare(const CompareRequest& request);

// Returns one JSON object, as report/README.md describes it.
std::string ComparisonJson(const Comparison& comparison);

}  // namespace rockyard::campaign

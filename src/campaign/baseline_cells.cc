#include "campaign/baseline_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "batch/run_folder.h"

namespace rockyard::campaign {
namespace {

bool IsSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

std::vector<StoredRun> ReadCells(const std::vector<std::string>& paths, const std::string& cell) {
  std::vector<StoredRun> cells;
  for (const std::string& path : paths) {
    for (const auto& folder : batch::FindRuns(path)) {
      std::vector<StoredRun> found;
      if (cell.empty()) {
        found = ReadCampaign(folder);
      } else {
        found.push_back(ReadRun(folder, cell));
      }
      for (StoredRun& each : found) {
        RequireWhole(each);
        cells.push_back(std::move(each));
      }
    }
  }
  return cells;
}

void KeepCellsOf(const std::vector<StoredRun>& runs, report::Baseline& baseline) {
  std::vector<report::BaselineCell> kept;
  for (const report::BaselineCell& cell : baseline.cells) {
    const bool named = std::any_of(
        runs.begin(), runs.end(), [&](const StoredRun& run) { return CellName(run) == cell.name; });
    if (named) kept.push_back(cell);
  }
  if (!kept.empty()) baseline.cells = std::move(kept);
}

std::int64_t SamePairs(const report::BaselineCell& cell, std::span<const truth::Record> records,
                       const std::vector<std::vector<double>>& values) {
  std::int64_t same_pairs = 0;
  for (std::size_t trial = 0; trial < std::min(records.size(), cell.outcomes.size()); ++trial) {
    bool same = records[trial].outcome == cell.outcomes[trial];
    for (std::size_t i = 0; same && i < cell.metrics.size(); ++i) {
      same = !values[i].empty() && IsSame(cell.metrics[i].values.at(trial), values[i].at(trial));
    }
    same_pairs += same ? 1 : 0;
  }
  return same_pairs;
}

}  // namespace rockyard::campaign

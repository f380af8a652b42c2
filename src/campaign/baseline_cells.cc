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

report::RecordChanges CompareRecords(const report::BaselineCell& cell,
                                     std::span<const truth::Record> records,
                                     const std::vector<std::vector<double>>& values) {
  report::RecordChanges changes;
  changes.columns = {{"outcome"}};
  for (const statistics::BaselineMetric& metric : cell.metrics) {
    changes.columns.push_back({metric.name});
  }
  const std::size_t pairs = std::min(records.size(), cell.outcomes.size());
  changes.pairs = static_cast<std::int64_t>(pairs);
  for (std::size_t trial = 0; trial < pairs; ++trial) {
    bool same = true;
    const auto compare = [&](std::size_t column, bool is_same) {
      if (is_same) return;
      same = false;
      ++changes.columns[column].trials;
    };
    compare(0, records[trial].outcome == cell.outcomes[trial]);
    for (std::size_t i = 0; i < cell.metrics.size(); ++i) {
      compare(i + 1,
              !values[i].empty() && IsSame(cell.metrics[i].values.at(trial), values[i].at(trial)));
    }
    changes.trials += same ? 0 : 1;
  }
  std::erase_if(changes.columns, [](const auto& column) { return column.trials == 0; });
  std::stable_sort(changes.columns.begin(), changes.columns.end(),
                   [](const auto& a, const auto& b) { return a.trials > b.trials; });
  return changes;
}

}  // namespace rockyard::campaign

// Cells of runs beside those of a baseline.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "campaign/run_source.h"
#include "report/baseline.h"
#include "report/regression_report.h"
#include "truth/record.h"

namespace rockyard::campaign {

// Of each campaign the cell of that name or number; all of them where `cell` is empty. `paths`:
// folders of runs, or of such folders. Throws core::UserError: no run, no such cell, a shard.
std::vector<StoredRun> ReadCells(const std::vector<std::string>& paths, const std::string& cell);

// Leaves those cells in the baseline that one of the runs is; all of them where none is.
void KeepCellsOf(const std::vector<StoredRun>& runs, report::Baseline& baseline);

// Compares trial by trial outcomes and values of metrics, rounded as the baseline keeps them;
// `values` are the run's, by metric of the baseline, and empty where it has none. A metric without
// a value in both is the same. Leaves `only_hash` as it is.
report::RecordChanges CompareRecords(const report::BaselineCell& cell,
                                     std::span<const truth::Record> records,
                                     const std::vector<std::vector<double>>& values);

}  // namespace rockyard::campaign

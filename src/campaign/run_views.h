// A stored run in the shapes that comparing takes; two runs of drives against each other.
#pragma once

#include <cstddef>

#include "campaign/run_source.h"
#include "report/paired_comparison.h"
#include "report/sweep_summary.h"
#include "statistics/published_comparison.h"

namespace rockyard::campaign {

// For report::CompareRuns. `run` must outlive it. Throws core::UserError where no trial is
// finished.
report::ComparedRun ComparedView(const StoredRun& run);

// For statistics::Compare. `run` must outlive it.
statistics::ScenarioRun ScenarioView(const StoredRun& run);

// For report::SummarizeSweep.
report::SweepCellTrials SweepCellView(StoredRun run);

// report::CompareRuns of the two, whose records need no values here (StoredValues::kNone): they are
// read again from the stores, some columns of both at a time. Memory: so many values, 130 MB, or
// one column of each where that is more; and 200 bytes a trial of each. Throws core::UserError
// where no trial of a run is finished.
report::RunComparison CompareDrives(const StoredRun& first, const StoredRun& second,
                                    std::size_t values_at_once = std::size_t{1} << 24);

}  // namespace rockyard::campaign

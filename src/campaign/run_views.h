// A stored run in the shapes that comparing takes.
#pragma once

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

}  // namespace rockyard::campaign

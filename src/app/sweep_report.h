// What a sweep says once its trials have been run: files and a table on the terminal.
#pragma once

#include "app/run_report.h"
#include "batch/result_store.h"
#include "scenario/sweep.h"

namespace rockyard::app {

// `store`: of a campaign with the cells of the sweep. Files go into its folder. Of a shard no rate
// can be told: there is a note instead. Memory: the records of one cell.
void ReportSweep(const batch::ResultStore& store, const scenario::Sweep& sweep,
                 const ReportOptions& options);

}  // namespace rockyard::app

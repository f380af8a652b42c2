// Of a sweep: the files that follow from its store, and what they say.
#pragma once

#include "batch/result_store.h"
#include "campaign/folder_report.h"
#include "campaign/run_report.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {

// `store`: of a campaign with the cells of the sweep. Writes the files into its folder. Of a shard
// no rate can be told, and so it gets a summary.json without any. Memory: the records of one cell.
// Throws core::UserError where a file cannot be written.
FolderReport ReportSweep(const batch::ResultStore& store, const scenario::Sweep& sweep,
                         const ReportSettings& settings);

}  // namespace rockyard::campaign

// The files of a run folder that are derived from its store.
#pragma once

#include <filesystem>
#include <span>

#include "report/run_description.h"
#include "statistics/cell_summary.h"
#include "statistics/drive_summary.h"
#include "truth/record.h"

namespace rockyard::report {

// Writes trials.csv, whole or not at all. Throws core::UserError.
void WriteTrialsCsv(const std::filesystem::path& folder, const truth::RecordSchema& schema,
                    std::span<const truth::Record> records);

// Writes summary.json, trials.csv, distance_cdf.csv and scenario.resolved.json, each whole or not
// at all. `records`: every stored record by trial index; `prefix`: those that rates may be computed
// from. Returns the summary. Throws core::UserError where a file cannot be written.
statistics::DriveSummary WriteRunFiles(const std::filesystem::path& folder,
                                       const RunDescription& run, const truth::RecordSchema& schema,
                                       std::span<const truth::Record> records,
                                       std::span<const truth::Record> prefix,
                                       statistics::IntervalMethod method);

// The same for an experiment that measures: summary.json, trials.csv, cells.csv, cells.svg (where
// there is a curve to draw) and scenario.resolved.json.
statistics::MeasurementSummary WriteMeasurementFiles(const std::filesystem::path& folder,
                                                     const RunDescription& run,
                                                     const truth::RecordSchema& schema,
                                                     std::span<const truth::Record> records,
                                                     std::span<const truth::Record> prefix,
                                                     statistics::IntervalMethod method);

}  // namespace rockyard::report

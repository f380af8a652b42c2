// The files of a run folder that are derived from its store, which campaigns write when they end;
// the records of a run as tables, for the report page too. Must agree: every file written here
// stands in kDerivedFiles of campaign/open_run.cc, by which --force sets the files of a run aside.
// No store depends on them; scripts of studies read columns of trials.csv by name.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "report/atomic_file.h"
#include "report/run_description.h"
#include "statistics/cell_summary.h"
#include "statistics/cumulative_incidence.h"
#include "statistics/drive_summary.h"
#include "statistics/sample_statistics.h"
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

// Writes the files of an experiment that measures: summary.json, trials.csv, cells.csv, cells.svg
// (where there is a curve to draw) and scenario.resolved.json, as WriteRunFiles does.
statistics::MeasurementSummary WriteMeasurementFiles(const std::filesystem::path& folder,
                                                     const RunDescription& run,
                                                     const truth::RecordSchema& schema,
                                                     std::span<const truth::Record> records,
                                                     std::span<const truth::Record> prefix,
                                                     statistics::IntervalMethod method);

// trials.csv: one line per record, trial, outcome, every value (the names carry the units; empty
// where undefined), the cause, and the sentence that says why it ended. Memory: a line.
void TrialsCsv(const truth::RecordSchema& schema, std::span<const truth::Record> records,
               const TextSink& out);

// What distance_cdf.csv says at one distinct true distance.
struct DistanceStep {
  statistics::EcdfPoint all;       // of the distance of all runs, however they ended
  statistics::IncidenceStep goal;  // declared arrival, failures competing
  double limit = 0.0;              // share of all that a limit of the run ended so far
  std::size_t at_risk = 0;         // just before
};

// Returns the steps over all trials without a simulator fault, ascending; none where the records
// have no true_distance_m. Cost: n log n.
std::vector<DistanceStep> DistanceSteps(const truth::RecordSchema& schema,
                                        std::span<const truth::Record> records);

// The columns of distance_cdf.csv, and the numbers of a step in their order.
inline constexpr std::array<std::string_view, 10> kDistanceColumns{
    "distance_m", "ecdf",      "ecdf_low", "ecdf_high", "goal",
    "goal_low",   "goal_high", "failure",  "at_risk",   "limit"};
std::array<double, kDistanceColumns.size()> DistanceNumbers(const DistanceStep& step);

// distance_cdf.csv: one line per distinct true distance, over all trials without a simulator fault.
//   distance_m
//   ecdf, ecdf_low, ecdf_high    plain empirical distribution function of the distance of all runs,
//                                however they ended, with a simultaneous 95 % band
//   goal, goal_low, goal_high    cumulative incidence of declared arrival, all other ends
//   competing,
//                                with a pointwise 95 % band; its end is the success rate
//   failure                      cumulative incidence of every other end, `limit` among them
//   at_risk                      runs still under way just before this distance
//   limit                        share that patience or time had ended: neither arrived nor failed,
//                                so that at most goal + limit could have arrived so far
// Of a drive that was never measured (truth::IsNavigatorCrash) no distance is known: it is in no
// number of ecdf and at_risk, and stays among those that `goal`, `failure` and `limit` are shares
// of, so that goal and failure end below 1 together.
// `records` must be a contiguous prefix. Only the header where there is no column true_distance_m.
// Memory: 250 bytes a record.
void DistanceCdfCsv(const truth::RecordSchema& schema, std::span<const truth::Record> records,
                    const TextSink& out);

}  // namespace rockyard::report

#include "report/run_files.h"

#include <algorithm>

#include "core/numbers.h"
#include "report/result_table.h"
#include "report/summary_json.h"
#include "report/summary_text.h"
#include "statistics/clustered_rate.h"
#include "truth/end_cause.h"

namespace rockyard::report {

void WriteTrialsCsv(const std::filesystem::path& folder, const truth::RecordSchema& schema,
                    std::span<const truth::Record> records) {
  WriteFileAtomically(folder / "trials.csv",
                      [&](const TextSink& out) { TrialsCsv(schema, records, out); });
}

statistics::DriveSummary WriteRunFiles(const std::filesystem::path& folder,
                                       const RunDescription& run, const truth::RecordSchema& schema,
                                       std::span<const truth::Record> records,
                                       std::span<const truth::Record> prefix,
                                       statistics::IntervalMethod method) {
  statistics::DriveSummary summary = statistics::Summarize(schema, prefix, run.planned, method);
  WriteFileAtomically(folder / "scenario.resolved.json", ResolvedScenarioJson(run));
  WriteTrialsCsv(folder, schema, records);
  WriteFileAtomically(folder / "distance_cdf.csv",
                      [&](const TextSink& out) { DistanceCdfCsv(schema, prefix, out); });
  WriteFileAtomically(folder / "summary.json", SummaryJson(run, summary));
  return summary;
}

statistics::MeasurementSummary WriteMeasurementFiles(const std::filesystem::path& folder,
                                                     const RunDescription& run,
                                                     const truth::RecordSchema& schema,
                                                     std::span<const truth::Record> records,
                                                     std::span<const truth::Record> prefix,
                                                     statistics::IntervalMethod method) {
  statistics::MeasurementSummary summary =
      statistics::SummarizeCells(schema, prefix, run.planned, method);
  WriteFileAtomically(folder / "scenario.resolved.json", ResolvedScenarioJson(run));
  WriteTrialsCsv(folder, schema, records);
  WriteFileAtomically(folder / "cells.csv", CellsCsv(summary));
  const std::string drawing = CellsSvg(summary, run.scenario);
  if (!drawing.empty()) WriteFileAtomically(folder / "cells.svg", drawing);
  WriteFileAtomically(folder / "summary.json", MeasurementJson(run, summary));
  return summary;
}

void TrialsCsv(const truth::RecordSchema& schema, std::span<const truth::Record> records,
               const TextSink& out) {
  CsvRow head("trial", "outcome");
  for (const truth::ValueInfo& value : schema) head.Add(value.name);
  out(head.Add("cause", "detail").Line());
  for (const truth::Record& record : records) {
    CsvRow row(record.trial, truth::Name(record.outcome));
    for (std::size_t i = 0; i < schema.size(); ++i) {
      row.Add(i < record.values.size() ? record.values[i] : core::kNaN);
    }
    out(row.Add(truth::CauseName(record), record.detail).Line());
  }
}

std::vector<DistanceStep> DistanceSteps(const truth::RecordSchema& schema,
                                        std::span<const truth::Record> records) {
  std::vector<DistanceStep> distances;
  const auto column = statistics::ColumnIndex(schema, "true_distance_m");
  if (!column) return distances;
  const std::vector<double> values = statistics::ColumnValues(records, *column);
  const auto durations = statistics::GoalDurations(records, *column);
  const auto drives = static_cast<double>(durations.size());
  // Where trials share layouts each layout says as much as one trial, whatever their dependence.
  const std::vector<std::size_t> groups = statistics::DependentGroups(schema, records);
  const auto layouts =
      groups.empty() ? static_cast<double>(records.size())
                     : 1.0 + static_cast<double>(*std::max_element(groups.begin(), groups.end()));
  const double share = records.empty() ? 1.0 : layouts / static_cast<double>(records.size());
  const auto steps = statistics::CumulativeIncidence(durations, statistics::kConfidence, share);

  std::vector<double> limits;
  for (const truth::Record& record : records) {
    if (*column < record.values.size() && truth::EndedByLimit(record)) {
      limits.push_back(record.values[*column]);
    }
  }
  limits = statistics::SortedFinite(limits);

  // Before the first step nothing has happened.
  statistics::IncidenceStep now;
  std::size_t next = 0;
  std::size_t passed = 0;
  const std::vector<double> sorted = statistics::SortedFinite(values);
  for (const statistics::EcdfPoint& point :
       statistics::Ecdf(values, statistics::kConfidence, statistics::BandMethod::kSimultaneous,
                        share * static_cast<double>(sorted.size()))) {
    while (next < steps.size() && steps[next].at <= point.value) now = steps[next++];
    const auto ended = std::upper_bound(limits.begin(), limits.end(), point.value);
    distances.push_back({.all = point,
                         .goal = now,
                         .limit = static_cast<double>(ended - limits.begin()) / drives,
                         .at_risk = sorted.size() - passed});
    while (passed < sorted.size() && sorted[passed] <= point.value) ++passed;
  }
  return distances;
}

std::array<double, kDistanceColumns.size()> DistanceNumbers(const DistanceStep& step) {
  const auto& [all, goal, limit, at_risk] = step;
  return {all.value,      all.fraction,   all.band.low,
          all.band.high,  goal.event,     goal.band.low,
          goal.band.high, goal.competing, static_cast<double>(at_risk),
          limit};
}

void DistanceCdfCsv(const truth::RecordSchema& schema, std::span<const truth::Record> records,
                    const TextSink& out) {
  out(CsvLine(kDistanceColumns));
  for (const DistanceStep& step : DistanceSteps(schema, records)) {
    out(CsvLine(DistanceNumbers(step)));
  }
}

}  // namespace rockyard::report

#include "report/run_files.h"

#include "core/numbers.h"
#include "report/csv.h"
#include "report/distance_steps.h"
#include "report/measurement_drawing.h"
#include "report/measurement_text.h"
#include "report/summary_json.h"
#include "truth/end_cause.h"

namespace rockyard::report {
namespace {

constexpr const char* kCdfHeader =
    "distance_m,ecdf,ecdf_low,ecdf_high,goal,goal_low,goal_high,failure,at_risk,limit\n";

}  // namespace

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

void DistanceCdfCsv(const truth::RecordSchema& schema, std::span<const truth::Record> records,
                    const TextSink& out) {
  out(kCdfHeader);
  for (const DistanceStep& step : DistanceSteps(schema, records)) {
    out(CsvLine(step.all.value, step.all.fraction, step.all.band, step.goal.event, step.goal.band,
                step.goal.competing, step.at_risk, step.limit));
  }
}

}  // namespace rockyard::report

#include "report/run_files.h"

#include "report/atomic_file.h"
#include "report/measurement_csv.h"
#include "report/measurement_drawing.h"
#include "report/run_csv.h"
#include "report/summary_json.h"

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

}  // namespace rockyard::report

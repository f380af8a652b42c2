#include "report/run_files.h"

#include <string>
#include <vector>

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
  std::vector<std::string> fields = {"trial", "outcome"};
  for (const truth::ValueInfo& value : schema) fields.push_back(CsvField(value.name));
  fields.emplace_back("cause");
  fields.emplace_back("detail");
  out(CsvLine(fields));
  for (const truth::Record& record : records) {
    fields = {std::to_string(record.trial), std::string(truth::Name(record.outcome))};
    for (std::size_t i = 0; i < schema.size(); ++i) {
      fields.push_back(i < record.values.size() ? CsvNumber(record.values[i]) : std::string());
    }
    fields.emplace_back(truth::CauseName(record));
    fields.push_back(CsvField(record.detail));
    out(CsvLine(fields));
  }
}

void DistanceCdfCsv(const truth::RecordSchema& schema, std::span<const truth::Record> records,
                    const TextSink& out) {
  out(kCdfHeader);
  for (const DistanceStep& step : DistanceSteps(schema, records)) {
    out(CsvLine(std::vector<std::string>{
        CsvNumber(step.all.value), CsvNumber(step.all.fraction), CsvNumber(step.all.band.low),
        CsvNumber(step.all.band.high), CsvNumber(step.goal.event), CsvNumber(step.goal.band.low),
        CsvNumber(step.goal.band.high), CsvNumber(step.goal.competing),
        std::to_string(step.at_risk), CsvNumber(step.limit)}));
  }
}

}  // namespace rockyard::report

#include "report/run_csv.h"

#include <vector>

#include "report/csv.h"
#include "statistics/cumulative_incidence.h"
#include "statistics/drive_summary.h"
#include "statistics/quantiles.h"

namespace rockyard::report {
namespace {

constexpr const char* kCdfHeader =
    "distance_m,ecdf,ecdf_low,ecdf_high,goal,goal_low,goal_high,failure,at_risk\n";

}  // namespace

std::string TrialsCsv(const truth::RecordSchema& schema, std::span<const truth::Record> records) {
  std::vector<std::string> fields = {"trial", "outcome"};
  for (const truth::ValueInfo& value : schema) fields.push_back(CsvField(value.name));
  fields.emplace_back("detail");
  std::string csv = CsvLine(fields);
  for (const truth::Record& record : records) {
    fields = {std::to_string(record.trial), std::string(truth::Name(record.outcome))};
    for (std::size_t i = 0; i < schema.size(); ++i) {
      fields.push_back(i < record.values.size() ? CsvNumber(record.values[i]) : std::string());
    }
    fields.push_back(CsvField(record.detail));
    csv += CsvLine(fields);
  }
  return csv;
}

std::string DistanceCdfCsv(const truth::RecordSchema& schema,
                           std::span<const truth::Record> records) {
  std::string csv = kCdfHeader;
  const auto column = statistics::ColumnIndex(schema, "true_distance_m");
  if (!column) return csv;
  const std::vector<double> distances = statistics::ColumnValues(records, *column);
  const auto durations = statistics::GoalDurations(records, *column);
  const auto steps = statistics::CumulativeIncidence(durations);

  // Before the first step nothing has happened.
  statistics::IncidenceStep now;
  std::size_t next = 0;
  std::size_t passed = 0;
  const std::vector<double> sorted = statistics::SortedFinite(distances);
  for (const statistics::EcdfPoint& point : statistics::Ecdf(distances)) {
    while (next < steps.size() && steps[next].at <= point.value) now = steps[next++];
    const std::size_t at_risk = sorted.size() - passed;
    while (passed < sorted.size() && sorted[passed] <= point.value) ++passed;
    csv += CsvLine(std::vector<std::string>{
        CsvNumber(point.value), CsvNumber(point.fraction), CsvNumber(point.band.low),
        CsvNumber(point.band.high), CsvNumber(now.event), CsvNumber(now.band.low),
        CsvNumber(now.band.high), CsvNumber(now.competing), std::to_string(at_risk)});
  }
  return csv;
}

}  // namespace rockyard::report

#include "report/measurement_csv.h"

#include <vector>

#include "report/csv.h"

namespace rockyard::report {

std::string CellsCsv(const statistics::MeasurementSummary& summary) {
  std::vector<std::string> fields{"cell", "runs"};
  for (const truth::ValueInfo& factor : summary.factors) fields.push_back(factor.name);
  for (const truth::ValueInfo& base : summary.bases) fields.push_back(base.name);
  for (const truth::ValueInfo& rate : summary.rates) {
    for (const char* suffix : {"", "_low", "_high", "_all_low", "_all_high"}) {
      fields.push_back(rate.name + suffix);
    }
  }
  for (const truth::ValueInfo& mean : summary.means) {
    const bool squares = mean.role == truth::ColumnRole::kSquares;
    fields.push_back((squares ? "rms_" : "mean_") + mean.name);
  }
  std::string csv = CsvLine(fields);
  for (const statistics::Cell& cell : summary.cells) {
    fields = {std::to_string(cell.number), std::to_string(cell.runs)};
    for (const double factor : cell.factors) fields.push_back(CsvNumber(factor));
    for (const double base : cell.bases) fields.push_back(CsvNumber(base));
    for (const statistics::CellRate& rate : cell.rates) {
      for (const double value : {rate.rate.rate, rate.rate.interval.low, rate.rate.interval.high,
                                 rate.simultaneous.low, rate.simultaneous.high}) {
        fields.push_back(CsvNumber(value));
      }
    }
    for (const double mean : cell.means) fields.push_back(CsvNumber(mean));
    csv += CsvLine(fields);
  }
  return csv;
}

}  // namespace rockyard::report

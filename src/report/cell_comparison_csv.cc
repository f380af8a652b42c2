#include <vector>

#include "report/cell_comparison_text.h"
#include "report/csv.h"

namespace rockyard::report {

std::string CellComparisonCsv(const statistics::CellComparison& comparison) {
  std::vector<std::string> fields{"rate"};
  for (const truth::ValueInfo& factor : comparison.factors) fields.push_back(factor.name);
  for (const char* name :
       {"a_count", "a_trials", "a_rate", "b_count", "b_trials", "b_rate", "difference", "low",
        "high", "all_low", "all_high", "p_value", "p_holm", "differs"}) {
    fields.emplace_back(name);
  }
  std::string csv = CsvLine(fields);
  for (std::size_t i = 0; i < comparison.rates.size(); ++i) {
    for (const statistics::ComparedCell& cell : comparison.cells) {
      fields = {comparison.rates[i].name};
      for (const double factor : cell.factors) fields.push_back(CsvNumber(factor));
      const statistics::RateDifference& rate = cell.rates[i];
      for (const statistics::Proportion* run : {&rate.first, &rate.second}) {
        fields.push_back(std::to_string(run->count));
        fields.push_back(std::to_string(run->trials));
        fields.push_back(CsvNumber(run->rate));
      }
      for (const double value :
           {rate.difference, rate.interval.low, rate.interval.high, rate.simultaneous.low,
            rate.simultaneous.high, rate.p_value, rate.adjusted}) {
        fields.push_back(CsvNumber(value));
      }
      fields.emplace_back(comparison.Differs(rate) ? "1" : "0");
      csv += CsvLine(fields);
    }
  }
  return csv;
}

}  // namespace rockyard::report

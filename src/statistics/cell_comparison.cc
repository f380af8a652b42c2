#include "statistics/cell_comparison.h"

#include <algorithm>
#include <map>
#include <utility>

#include "statistics/multiple_testing.h"
#include "statistics/proportions.h"

namespace rockyard::statistics {
namespace {

// Positions of a rate in both summaries.
using ColumnPair = std::pair<std::size_t, std::size_t>;

std::vector<ColumnPair> SharedRates(const MeasurementSummary& first,
                                    const MeasurementSummary& second) {
  std::vector<ColumnPair> shared;
  for (std::size_t i = 0; i < first.rates.size(); ++i) {
    const std::size_t other = second.FindRate(first.rates[i].name);
    if (other < second.rates.size()) shared.emplace_back(i, other);
  }
  return shared;
}

bool SameNames(const truth::RecordSchema& first, const truth::RecordSchema& second) {
  return std::equal(
      first.begin(), first.end(), second.begin(), second.end(),
      [](const truth::ValueInfo& a, const truth::ValueInfo& b) { return a.name == b.name; });
}

RateDifference Compare(const Proportion& first, const Proportion& second) {
  RateDifference result;
  result.first = first;
  result.second = second;
  result.tested = first.trials > 0 && second.trials > 0;
  result.difference = second.rate - first.rate;
  result.interval = DifferenceInterval(first, second, kConfidence);
  result.simultaneous = result.interval;
  if (result.tested) {
    result.p_value = FisherExactPValue(
        {first.count, first.trials - first.count, second.count, second.trials - second.count});
  }
  return result;
}

// What depends on the whole family.
void Adjust(CellComparison& comparison) {
  std::vector<RateDifference*> tests;
  std::vector<double> p_values;
  for (ComparedCell& cell : comparison.cells) {
    for (RateDifference& rate : cell.rates) {
      if (!rate.tested) continue;
      tests.push_back(&rate);
      p_values.push_back(rate.p_value);
    }
  }
  comparison.tests = tests.size();
  const std::vector<double> adjusted = HolmAdjust(p_values);
  for (std::size_t i = 0; i < tests.size(); ++i) {
    RateDifference& test = *tests[i];
    test.adjusted = adjusted[i];
    const double level = 1.0 - (1.0 - kConfidence) / static_cast<double>(tests.size());
    test.simultaneous = DifferenceInterval(test.first, test.second, level);
  }
}

}  // namespace

std::size_t CellComparison::Differing(std::size_t rate) const {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(),
                    [&](const ComparedCell& cell) { return Differs(cell.rates[rate]); }));
}

std::size_t CellComparison::Differing() const {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [&](const ComparedCell& cell) {
        return std::any_of(cell.rates.begin(), cell.rates.end(),
                           [&](const RateDifference& rate) { return Differs(rate); });
      }));
}

CellComparison CompareCells(const MeasurementSummary& first, const MeasurementSummary& second,
                            double alpha) {
  CellComparison result;
  result.alpha = alpha;
  result.factors = first.factors;
  const std::vector<ColumnPair> rates = SharedRates(first, second);
  for (const ColumnPair& pair : rates) result.rates.push_back(first.rates[pair.first]);
  std::map<std::vector<double>, const Cell*> others;
  if (SameNames(first.factors, second.factors)) {
    for (const Cell& cell : second.cells) others.emplace(cell.factors, &cell);
  }
  for (const Cell& cell : first.cells) {
    const auto other = others.find(cell.factors);
    if (other == others.end()) continue;
    ComparedCell& compared = result.cells.emplace_back();
    compared.factors = cell.factors;
    for (const auto& [a, b] : rates) {
      compared.rates.push_back(Compare(cell.rates[a].rate, other->second->rates[b].rate));
    }
    others.erase(other);  // where a list repeats a value, each cell still counts once
  }
  result.only_first = first.cells.size() - result.cells.size();
  result.only_second = second.cells.size() - result.cells.size();
  Adjust(result);
  return result;
}

}  // namespace rockyard::statistics

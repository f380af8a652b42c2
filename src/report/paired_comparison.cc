#include "report/paired_comparison.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "statistics/drive_summary.h"
#include "statistics/equivalence.h"
#include "statistics/mean_interval.h"
#include "statistics/metrics.h"
#include "statistics/moments.h"
#include "statistics/quantiles.h"
#include "truth/measurement_record.h"

namespace rockyard::report {
namespace {

using statistics::Proportion;
using truth::Record;
using truth::TrialOutcome;

using Pair = std::pair<const Record*, const Record*>;
using Succeeded = std::function<bool(TrialOutcome)>;

bool TrulyThere(TrialOutcome outcome) { return outcome == TrialOutcome::kGoalReached; }

std::vector<Pair> Pairs(const ComparedRun& first, const ComparedRun& second) {
  std::vector<Pair> pairs;
  const std::size_t common = std::min(first.records.size(), second.records.size());
  for (std::size_t i = 0; i < common; ++i) {
    const Record& a = first.records[i];
    const Record& b = second.records[i];
    if (!IsFault(a) && !IsFault(b)) pairs.emplace_back(&a, &b);
  }
  return pairs;
}

SuccessComparison ComparePaired(const std::vector<Pair>& pairs, std::string what,
                                const Succeeded& succeeded) {
  SuccessComparison result;
  result.what = std::move(what);
  for (const auto& [a, b] : pairs) {
    result.counts.Add(succeeded(a->outcome), succeeded(b->outcome));
  }
  const auto n = static_cast<std::int64_t>(pairs.size());
  result.first = statistics::MakeProportion(result.counts.both + result.counts.only_first, n);
  result.second = statistics::MakeProportion(result.counts.both + result.counts.only_second, n);
  result.difference = result.second.rate - result.first.rate;
  result.interval = statistics::DifferenceInterval(result.counts);
  result.p_value =
      statistics::McNemarExactPValue(result.counts.only_first, result.counts.only_second);
  return result;
}

Proportion RateOf(std::span<const Record> records, const Succeeded& succeeded) {
  std::int64_t count = 0;
  std::int64_t trials = 0;
  for (const Record& record : records) {
    if (IsFault(record)) continue;
    ++trials;
    if (succeeded(record.outcome)) ++count;
  }
  return statistics::MakeProportion(count, trials);
}

SuccessComparison CompareUnpaired(const ComparedRun& first, const ComparedRun& second,
                                  std::string what, const Succeeded& succeeded) {
  SuccessComparison result;
  result.what = std::move(what);
  result.first = RateOf(first.records, succeeded);
  result.second = RateOf(second.records, succeeded);
  result.difference = result.second.rate - result.first.rate;
  result.interval = statistics::DifferenceInterval(result.first, result.second);
  result.p_value = statistics::FisherExactPValue(
      {result.first.count, result.first.trials - result.first.count, result.second.count,
       result.second.trials - result.second.count});
  return result;
}

double Mean(std::span<const double> values) { return statistics::MomentsOf(values).mean(); }

// The interval is that of the mean of the differences; unknown where it has none.
void ComparePairedColumn(const std::vector<Pair>& pairs, std::size_t in_first,
                         std::size_t in_second, ColumnComparison& result) {
  std::vector<double> first;
  std::vector<double> second;
  std::vector<double> differences;
  for (const auto& [a, b] : pairs) {
    const double before = a->values[in_first];
    const double after = b->values[in_second];
    if (!std::isfinite(before) || !std::isfinite(after)) continue;
    first.push_back(before);
    second.push_back(after);
    differences.push_back(after - before);
  }
  result.count = static_cast<std::int64_t>(differences.size());
  result.second_count = result.count;
  result.first_mean = Mean(first);
  result.second_mean = Mean(second);
  result.difference = Mean(differences);
  result.interval = statistics::EstimateMean(statistics::SortedFinite(differences),
                                             statistics::FewestForMean(result.name))
                        .interval;
}

// Unknown where the mean of either side has no interval.
void CompareUnpairedColumn(const std::vector<double>& first, const std::vector<double>& second,
                           ColumnComparison& result) {
  const std::vector<double> a = statistics::SortedFinite(first);
  const std::vector<double> b = statistics::SortedFinite(second);
  const std::int64_t fewest = statistics::FewestForMean(result.name);
  result.count = static_cast<std::int64_t>(a.size());
  result.second_count = static_cast<std::int64_t>(b.size());
  result.first_mean = Mean(a);
  result.second_mean = Mean(b);
  result.difference = result.second_mean - result.first_mean;
  result.interval = statistics::MeanDifferenceInterval(
      result.first_mean, statistics::EstimateMean(a, fewest).interval, result.second_mean,
      statistics::EstimateMean(b, fewest).interval);
}

// Every column that both schemas have; `compare` gets its index in each and fills the rest.
template <typename Compare>
std::vector<ColumnComparison> CommonColumns(const ComparedRun& first, const ComparedRun& second,
                                            const Compare& compare) {
  std::vector<ColumnComparison> columns;
  for (std::size_t i = 0; i < first.schema.size(); ++i) {
    const auto other = statistics::ColumnIndex(second.schema, first.schema[i].name);
    if (!other) continue;
    ColumnComparison column{.name = first.schema[i].name, .unit = first.schema[i].unit};
    compare(i, *other, column);
    columns.push_back(std::move(column));
  }
  return columns;
}

std::vector<ColumnComparison> PairedColumns(const ComparedRun& first, const ComparedRun& second,
                                            const std::vector<Pair>& pairs) {
  return CommonColumns(first, second, [&](std::size_t a, std::size_t b, ColumnComparison& column) {
    ComparePairedColumn(pairs, a, b, column);
  });
}

std::vector<ColumnComparison> UnpairedColumns(const ComparedRun& first, const ComparedRun& second) {
  return CommonColumns(first, second, [&](std::size_t a, std::size_t b, ColumnComparison& column) {
    CompareUnpairedColumn(statistics::ColumnValues(first.records, a),
                          statistics::ColumnValues(second.records, b), column);
  });
}

std::vector<Pair> BothArrived(std::vector<Pair> pairs) {
  std::erase_if(pairs, [](const Pair& pair) {
    return !truth::DeclaredSuccess(pair.first->outcome) ||
           !truth::DeclaredSuccess(pair.second->outcome);
  });
  return pairs;
}

std::vector<Record> Arrived(std::span<const Record> records) {
  std::vector<Record> arrived(records.begin(), records.end());
  std::erase_if(arrived,
                [](const Record& record) { return !truth::DeclaredSuccess(record.outcome); });
  return arrived;
}

void CompareInPairs(const ComparedRun& first, const ComparedRun& second, bool drives,
                    RunComparison& result) {
  const std::vector<Pair> pairs = Pairs(first, second);
  result.pairs = static_cast<std::int64_t>(pairs.size());
  result.columns = PairedColumns(first, second, pairs);
  if (!drives) return;
  result.successes = {ComparePaired(pairs, "declared success", truth::DeclaredSuccess),
                      ComparePaired(pairs, "true success", TrulyThere)};
  result.arrived_columns = PairedColumns(first, second, BothArrived(pairs));
}

void CompareAsSamples(const ComparedRun& first, const ComparedRun& second, bool drives,
                      RunComparison& result) {
  result.columns = UnpairedColumns(first, second);
  if (!drives) return;
  result.successes = {CompareUnpaired(first, second, "declared success", truth::DeclaredSuccess),
                      CompareUnpaired(first, second, "true success", TrulyThere)};
  const std::vector<Record> a = Arrived(first.records);
  const std::vector<Record> b = Arrived(second.records);
  ComparedRun first_arrived = first;
  ComparedRun second_arrived = second;
  first_arrived.records = a;
  second_arrived.records = b;
  result.arrived_columns = UnpairedColumns(first_arrived, second_arrived);
}

}  // namespace

bool SharesLayouts(const truth::RecordSchema& schema, std::span<const Record> records) {
  const auto column = statistics::ColumnIndex(schema, "layout");
  if (!column) return false;
  const std::vector<double> layouts =
      statistics::SortedFinite(statistics::ColumnValues(records, *column));
  return std::adjacent_find(layouts.begin(), layouts.end()) != layouts.end();
}

RunComparison CompareRuns(const ComparedRun& first, const ComparedRun& second) {
  const bool drives = !truth::IsMeasurement(first.schema) && !truth::IsMeasurement(second.schema);
  RunComparison result;
  result.paired = first.seed == second.seed;
  result.same_terrain = first.fields == second.fields;
  result.shared_layouts =
      SharesLayouts(first.schema, first.records) || SharesLayouts(second.schema, second.records);
  if (result.paired) {
    CompareInPairs(first, second, drives, result);
  } else {
    CompareAsSamples(first, second, drives, result);
  }
  return result;
}

}  // namespace rockyard::report

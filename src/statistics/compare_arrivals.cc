// Published sets of which a known number of runs arrived, beside rows that are judged over all
// runs: no verdict depends on them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "statistics/compare_rows.h"
#include "statistics/drive_summary.h"
#include "statistics/predictive.h"

namespace rockyard::statistics {
namespace {

// Finite values of the simulated runs that arrived, or of those that did not.
std::vector<double> ValuesOf(const ScenarioRun& run, std::size_t column, bool arrived) {
  std::vector<truth::Record> records;
  std::copy_if(
      run.records.begin(), run.records.end(), std::back_inserter(records),
      [&](const truth::Record& r) { return truth::DeclaredSuccess(r.outcome) == arrived; });
  return ColumnValues(records, column);
}

// Whether a sampler can be made for that many runs of the published set.
bool Enough(const std::vector<double>& pool, std::int64_t runs) {
  return runs == 0 || pool.size() >= 2;
}

std::int64_t NegativesOf(const std::vector<double>& values) {
  return std::count_if(values.begin(), values.end(), [](double x) { return x < 0.0; });
}

CountLaw NegativesLaw(const std::vector<double>& pool, std::int64_t runs) {
  return PredictiveCountLaw(runs, NegativesOf(pool), static_cast<std::int64_t>(pool.size()));
}

// Law of the sum of two independent counts.
CountLaw SumLaw(const CountLaw& first, const CountLaw& second) {
  CountLaw sum(first.size() + second.size() - 1, 0.0);
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t j = 0; j < second.size(); ++j) sum[i + j] += first[i] * second[j];
  }
  return sum;
}

}  // namespace

std::string ArrivalsName(const PublishedValue& published) {
  return fmt::format("{} arrivals of {}", published.arrived, published.sample_size);
}

std::vector<double> StatisticsByArrival(const PublishedValue& published, const ScenarioRun& run,
                                        const SampleStatistic& statistic, std::size_t replicates,
                                        core::TrialKey key) {
  const auto column = ColumnIndex(run.schema, published.column);
  if (published.arrived == 0 || !column) return {};
  const std::int64_t failed = published.sample_size - published.arrived;
  const std::vector<double> arrivals = ValuesOf(run, *column, true);
  const std::vector<double> others = ValuesOf(run, *column, false);
  if (!Enough(arrivals, published.arrived) || !Enough(others, failed)) return {};
  const PredictiveSampler first(arrivals, published.lower_limit);
  const PredictiveSampler second(failed > 0 ? others : arrivals, published.lower_limit);
  const std::array<SamplePart, 2> parts{{{&first, static_cast<std::size_t>(published.arrived)},
                                         {&second, static_cast<std::size_t>(failed)}}};
  return PredictiveStatistics(parts, statistic, replicates, key);
}

std::optional<CountLaw> NegativesByArrival(const PublishedValue& published,
                                           const ScenarioRun& run) {
  const auto column = ColumnIndex(run.schema, published.column);
  if (published.arrived == 0 || !column) return std::nullopt;
  const std::int64_t failed = published.sample_size - published.arrived;
  const std::vector<double> arrivals = ValuesOf(run, *column, true);
  const std::vector<double> others = ValuesOf(run, *column, false);
  if (!Enough(arrivals, published.arrived) || !Enough(others, failed)) return std::nullopt;
  return SumLaw(NegativesLaw(arrivals, published.arrived), NegativesLaw(others, failed));
}

}  // namespace rockyard::statistics

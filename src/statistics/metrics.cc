#include "statistics/metrics.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/numbers.h"
#include "statistics/clustered_rate.h"
#include "statistics/drive_summary.h"
#include "statistics/sample_statistics.h"
#include "truth/end_cause.h"

namespace rockyard::statistics {
namespace {

using core::kNaN;

bool Counts(const Metric& metric, const truth::Record& record) {
  if (IsFault(record)) return false;
  return metric.trials == MetricTrials::kAll || truth::DeclaredSuccess(record.outcome);
}

bool HasOutcome(const Metric& metric, truth::TrialOutcome outcome) {
  return (metric.outcomes >> static_cast<unsigned>(outcome) & 1u) != 0;
}

bool HasCause(const Metric& metric, const truth::Record& record) {
  const auto cause = truth::CauseOf(record);
  return cause && (metric.causes >> static_cast<unsigned>(*cause) & 1u) != 0;
}

double ValueOf(const Metric& metric, const truth::Record& record, std::size_t first,
               std::size_t second) {
  if (metric.source == MetricSource::kOutcome)
    return HasOutcome(metric, record.outcome) ? 1.0 : 0.0;
  if (metric.source == MetricSource::kCause) return HasCause(metric, record) ? 1.0 : 0.0;
  if (std::max(first, second) >= record.values.size()) return kNaN;
  const double value = record.values[first];
  if (!std::isfinite(value)) return kNaN;
  if (metric.source == MetricSource::kPositive) return value > 0.0 ? 1.0 : 0.0;
  if (metric.source == MetricSource::kColumn) return value;
  const double quotient = value / record.values[second];
  return std::isfinite(quotient) ? quotient : kNaN;
}

}  // namespace

double DefaultMargin(const Metric& metric, double mean) {
  constexpr double kAnyDifference = 1e-9;  // where a mean of 0 gives no scale
  const double relative = std::isfinite(mean) ? metric.relative_margin * std::abs(mean) : 0.0;
  return std::max({metric.margin, relative, kAnyDifference});
}

std::int64_t FewestForMean(std::string_view column) {
  std::int64_t fewest = kFewestForMean;
  for (const Metric& metric : Metrics()) {
    if (metric.kind != MetricKind::kMean) continue;
    const bool same = metric.source == MetricSource::kColumn && metric.columns[0] == column;
    if (!same && metric.name != column) continue;
    if (metric.fewest_for_mean == kNeverForMean) return kNeverForMean;
    fewest = std::max(fewest, metric.fewest_for_mean);
  }
  return fewest;
}

std::optional<std::vector<double>> MetricValues(const Metric& metric,
                                                const truth::RecordSchema& schema,
                                                std::span<const truth::Record> records) {
  std::array<std::size_t, 2> at{};
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (metric.columns[i].empty()) continue;
    const auto found = ColumnIndex(schema, metric.columns[i]);
    if (!found) return std::nullopt;
    at[i] = *found;
  }
  std::vector<double> values;
  values.reserve(records.size());
  for (const truth::Record& record : records) {
    values.push_back(Counts(metric, record) ? ValueOf(metric, record, at[0], at[1]) : kNaN);
  }
  return values;
}

MetricSummary SummarizeMetric(const Metric& metric, std::span<const double> values,
                              double confidence, IntervalMethod method,
                              std::span<const std::size_t> groups) {
  const std::vector<double> sorted = SortedFinite(values);
  const Moments moments = MomentsOf(sorted);
  MetricSummary summary{.metric = metric,
                        .count = moments.count(),
                        .mean = moments.mean(),
                        .deviation = moments.standard_deviation(),
                        .interval = {},
                        .method = method,
                        .estimate = {},
                        .median = kNaN,
                        .median_interval = {kNaN, kNaN},
                        .min = moments.min(),
                        .max = moments.max()};
  if (metric.kind == MetricKind::kRate) {
    const Proportion rate = RateOfTrials(values, groups, confidence, method);
    summary.method = rate.method;
    summary.interval = rate.interval;
    return summary;
  }
  summary.estimate = MeanOfTrials(values, groups, metric.fewest_for_mean, confidence);
  summary.interval = summary.estimate.interval;
  summary.median = Quantile(sorted, 0.5);
  if (groups.empty()) summary.median_interval = MedianInterval(sorted, confidence);
  return summary;
}

std::vector<MetricSummary> SummarizeMetrics(const truth::RecordSchema& schema,
                                            std::span<const truth::Record> records,
                                            IntervalMethod method,
                                            std::optional<truth::TrialOutcome> outcome) {
  std::vector<MetricSummary> summaries;
  const std::vector<std::size_t> groups = DependentGroups(schema, records);
  for (const Metric& metric : MetricsOf(schema)) {
    if (outcome &&
        (metric.source == MetricSource::kOutcome || metric.source == MetricSource::kCause)) {
      continue;
    }
    auto values = MetricValues(metric, schema, records);
    if (!values) continue;
    for (std::size_t i = 0; outcome && i < records.size(); ++i) {
      if (records[i].outcome != *outcome) (*values)[i] = kNaN;
    }
    summaries.push_back(SummarizeMetric(metric, *values, kConfidence, method, groups));
  }
  return summaries;
}

}  // namespace rockyard::statistics

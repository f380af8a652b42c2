#include "statistics/drive_summary.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "statistics/clustered_rate.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

constexpr std::string_view kPathRatio = "path_ratio";

void AddMetrics(const truth::RecordSchema& schema, std::span<const truth::Record> records,
                IntervalMethod method, DriveSummary& summary) {
  summary.metrics = SummarizeMetrics(schema, records, method);
  for (std::size_t i = 0; i < summary.outcomes.size(); ++i) {
    const auto outcome = static_cast<truth::TrialOutcome>(i);
    if (summary.outcomes[i] == 0 || outcome == truth::TrialOutcome::kSimulatorFault) continue;
    summary.metrics_by_outcome[i] = SummarizeMetrics(schema, records, method, outcome);
  }
}

}  // namespace

ColumnSummary SummarizeColumn(std::string name, std::string unit, std::span<const double> values) {
  const std::vector<double> sorted = SortedFinite(values);
  const Moments moments = MomentsOf(sorted);
  return {.name = std::move(name),
          .unit = std::move(unit),
          .count = moments.count(),
          .min = moments.min(),
          .p05 = Quantile(sorted, 0.05),
          .median = Quantile(sorted, 0.5),
          .mean = moments.mean(),
          .mode = HalfSampleMode(sorted),
          .mode_range = HalfSampleModeRange(values),
          .p95 = Quantile(sorted, 0.95),
          .max = moments.max(),
          .std = moments.standard_deviation()};
}

const ColumnSummary* DriveSummary::Find(std::string_view name) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const ColumnSummary& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

std::optional<std::size_t> ColumnIndex(const truth::RecordSchema& schema, std::string_view name) {
  for (std::size_t i = 0; i < schema.size(); ++i) {
    if (schema[i].name == name) return i;
  }
  return std::nullopt;
}

std::vector<double> ColumnValues(std::span<const truth::Record> records, std::size_t column) {
  std::vector<double> values;
  for (const truth::Record& record : records) {
    if (IsFault(record) || column >= record.values.size()) continue;
    if (std::isfinite(record.values[column])) values.push_back(record.values[column]);
  }
  return values;
}

Interval DriveSummary::SuccessWithoutLimits() const {
  std::int64_t untold = outcome(truth::TrialOutcome::kNoPath);
  for (std::size_t i = 0; i < truth::kEndCauses.size(); ++i) {
    if (truth::kEndCauses[i].outcome == truth::TrialOutcome::kNoPath) untold -= causes[i];
  }
  const auto rate = [&](std::int64_t count) {
    return static_cast<double>(count) / static_cast<double>(declared_success.trials);
  };
  return {rate(declared_success.count),
          rate(declared_success.count + ended_by_limit.count + untold)};
}

DriveSummary Summarize(const truth::RecordSchema& schema, std::span<const truth::Record> records,
                       std::int64_t planned, IntervalMethod method) {
  DriveSummary summary;
  summary.completed = static_cast<std::int64_t>(records.size());
  summary.planned = planned > 0 ? planned : summary.completed;
  for (const truth::Record& record : records) {
    ++summary.outcomes[static_cast<std::size_t>(record.outcome)];
    if (const auto cause = truth::CauseOf(record)) {
      ++summary.causes[static_cast<std::size_t>(*cause)];
    }
    const bool fault = record.outcome == truth::TrialOutcome::kNavigatorFault;
    if (fault && !summary.first_navigator_fault) {
      summary.first_navigator_fault = {record.trial, record.detail};
    }
  }
  summary.faults = summary.outcome(truth::TrialOutcome::kSimulatorFault);
  const std::vector<std::size_t> groups = DependentGroups(schema, records);
  summary.shared_layouts = !groups.empty();
  const auto rate = [&](const std::vector<double>& ones) {
    return RateOfTrials(ones, groups, kConfidence, method);
  };
  summary.declared_success = rate(OnesWhere(records, truth::DeclaredSuccess));
  summary.true_success = rate(OnesWhere(records, truth::TrueSuccess));
  summary.ended_by_limit = rate(OnesWhere(records, truth::EndedByLimit));
  for (std::size_t i = 0; i < schema.size(); ++i) {
    if (schema[i].name == kPathRatio) continue;
    summary.columns.push_back(
        SummarizeColumn(schema[i].name, schema[i].unit, ColumnValues(records, i)));
  }
  const auto ratios = MetricValues(*FindMetric(kPathRatio), schema, records);
  summary.columns.push_back(
      SummarizeColumn(std::string(kPathRatio), "1", ratios.value_or(std::vector<double>())));
  AddMetrics(schema, records, method, summary);
  return summary;
}

}  // namespace rockyard::statistics

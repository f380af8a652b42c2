#include "report/baseline.h"

#include <cmath>
#include <string>
#include <utility>

#include "core/json_text.h"
#include "report/json_members.h"
#include "statistics/metrics.h"
#include "statistics/sample_statistics.h"

namespace rockyard::report {
namespace {

using core::JsonValue;
using core::NumberOrNull;
using statistics::Metric;
using statistics::MetricSource;

// The document, its cells, each cell, and its margins, metrics and resolved scenario: one member of
// these on a line, so that a version control system shows what changed.
constexpr int kSpreadLevels = 4;

bool HasValue(const std::vector<double>& values) {
  for (const double value : values) {
    if (std::isfinite(value)) return true;
  }
  return false;
}

// Counts are most of the numbers: "3" rather than "3.0".
JsonValue ShortNumber(double value) {
  const bool whole = std::abs(value) < 1e9 && value == std::trunc(value);
  return whole ? JsonValue(std::llround(value)) : NumberOrNull(value);
}

std::string Letters(const std::vector<truth::TrialOutcome>& outcomes) {
  std::string letters;
  for (const truth::TrialOutcome outcome : outcomes) {
    letters += kOutcomeLetters[static_cast<std::size_t>(outcome)];
  }
  return letters;
}

JsonValue CellJson(const BaselineCell& cell) {
  JsonValue margins = JsonValue::Object();
  JsonValue metrics = JsonValue::Object();
  for (const statistics::BaselineMetric& each : cell.metrics) {
    margins.Set(each.name, ShortNumber(each.margin));
    const Metric* metric = statistics::FindMetric(each.name);
    if (metric == nullptr || metric->source != MetricSource::kOutcome) {
      metrics.Set(each.name, core::ListOf(each.values, ShortNumber));
    }
  }
  return ObjectTree("name", cell.name, "scenario", cell.scenario, "fingerprint", cell.fingerprint,
                    "seed", std::to_string(cell.seed), "trial_hash", cell.trial_hash, "outcomes",
                    Letters(cell.outcomes), "margins", std::move(margins), "metrics",
                    std::move(metrics), "resolved",
                    core::ParseJson(cell.resolved, "resolved scenario"));
}

}  // namespace

void FillBaselineCell(const truth::RecordSchema& schema, std::span<const truth::Record> records,
                      BaselineCell& cell) {
  for (const truth::Record& record : records) cell.outcomes.push_back(record.outcome);
  for (const Metric& metric : statistics::Metrics()) {
    auto values = statistics::MetricValues(metric, schema, records);
    if (!values || !HasValue(*values)) continue;
    for (double& value : *values) value = statistics::RoundForBaseline(value);
    const double mean = statistics::MomentsOf(*values).mean();
    const double margin = statistics::RoundForBaseline(statistics::DefaultMargin(metric, mean));
    cell.metrics.push_back({std::string(metric.name), margin, std::move(*values)});
  }
}

std::string BaselineJson(const Baseline& baseline) {
  const JsonValue json = ObjectTree(
      "kind", kBaselineKind, "schema_version", 1, "name", baseline.name, "reason", baseline.reason,
      "build", baseline.build, "cells", core::ListOf(baseline.cells, CellJson));
  return core::SpreadJson(json, kSpreadLevels) + "\n";
}

}  // namespace rockyard::report

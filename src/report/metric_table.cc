#include "report/metric_table.h"

#include <fmt/format.h>

#include "statistics/metrics.h"

namespace rockyard::report {
namespace {

using statistics::Metric;
using statistics::MetricSource;
using statistics::MetricTrials;

std::string_view TrialsOf(const Metric& metric) {
  return metric.trials == MetricTrials::kAll ? "all" : "arrived";
}

std::string ColumnsOf(const Metric& metric) {
  if (metric.source == MetricSource::kOutcome) return "outcome";
  if (metric.source == MetricSource::kCause) return "cause";
  std::string text(metric.columns[0]);
  if (metric.source == MetricSource::kPositive) text += " > 0";
  if (metric.source == MetricSource::kQuotient) text += fmt::format(" / {}", metric.columns[1]);
  return text;
}

std::string MarginOf(const Metric& metric) {
  if (metric.relative_margin == 0.0) return fmt::format("{:g}", metric.margin);
  const std::string relative = fmt::format("{:g} %", 100.0 * metric.relative_margin);
  return metric.margin == 0.0 ? relative : fmt::format("{:g} or {}", metric.margin, relative);
}

}  // namespace

std::string MetricTableText() {
  std::string text;
  for (const Metric& metric : statistics::Metrics()) {
    text +=
        fmt::format("{:<25} {:<4} {:<8} margin {:<12} from {}\n    {}\n", metric.name, metric.unit,
                    TrialsOf(metric), MarginOf(metric), ColumnsOf(metric), metric.definition);
  }
  return text;
}

std::string MetricTableMarkdown() {
  std::string text =
      "| metric | unit | trials | definition | from | margin |\n|---|---|---|---|---|---|\n";
  for (const Metric& metric : statistics::Metrics()) {
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", metric.name, metric.unit,
                        TrialsOf(metric), metric.definition, ColumnsOf(metric), MarginOf(metric));
  }
  return text;
}

}  // namespace rockyard::report

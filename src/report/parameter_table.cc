#include "report/parameter_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "report/line_text.h"
#include "statistics/metrics.h"

namespace rockyard::report {
namespace {

using core::FieldKind;
using core::ParameterInfo;
using statistics::Metric;
using statistics::MetricSource;
using statistics::MetricTrials;

// Must stay in the order of FieldKind.
constexpr std::array<std::string_view, 8> kKindNames{"real", "angle", "integer",  "boolean",
                                                     "text", "reals", "integers", "choice"};

// Six digits tell what a person chose; conversions between units leave more behind.
std::string SixDigits(double value) { return fmt::format("{:.6g}", value); }

std::string ValueText(const core::JsonValue& value) {
  switch (value.type()) {
    case core::JsonValue::Type::kBoolean:
      return value.boolean() ? "true" : "false";
    case core::JsonValue::Type::kInteger:
      return std::to_string(value.integer());
    case core::JsonValue::Type::kReal:
      return SixDigits(value.number());
    case core::JsonValue::Type::kText:
      return value.text();
    case core::JsonValue::Type::kList: {
      std::vector<std::string> parts;
      for (const core::JsonValue& part : value.list()) parts.push_back(ValueText(part));
      return fmt::format("[{}]", fmt::join(parts, ", "));
    }
    case core::JsonValue::Type::kNull:
    case core::JsonValue::Type::kObject:
      break;
  }
  return "";
}

std::string Bound(double value) { return std::isfinite(value) ? SixDigits(value) : ""; }

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

std::string ParameterValue(const ParameterInfo& parameter) { return ValueText(parameter.value); }

std::string ParameterRange(const ParameterInfo& parameter) {
  if (parameter.kind == FieldKind::kChoice) {
    return fmt::format("{}", fmt::join(parameter.choices, ", "));
  }
  if (parameter.HasStudyRange()) {
    return fmt::format("{} to {}", SixDigits(parameter.study_low), SixDigits(parameter.study_high));
  }
  return "held";
}

std::vector<ParameterInfo> SelectParameters(std::span<const ParameterInfo> parameters,
                                            std::optional<core::Origin> origin) {
  std::vector<ParameterInfo> selected;
  std::copy_if(parameters.begin(), parameters.end(), std::back_inserter(selected),
               [&](const ParameterInfo& p) { return !origin || p.origin == *origin; });
  return selected;
}

ResultTable ParameterColumns(std::span<const ParameterInfo> parameters) {
  ResultTable table(
      "path,kind,value,unit,origin,study_low,study_high,min,max,choices,source,doc,range");
  for (const ParameterInfo& p : parameters) {
    const bool studied = p.HasStudyRange();
    table.Add(p.path, kKindNames[static_cast<std::size_t>(p.kind)], ParameterValue(p), p.unit,
              core::Name(p.origin), studied ? SixDigits(p.study_low) : "",
              studied ? SixDigits(p.study_high) : "", Bound(p.min), Bound(p.max),
              fmt::format("{}", fmt::join(p.choices, "|")), p.source, p.doc, ParameterRange(p));
  }
  return table;
}

std::string ParametersMarkdown(std::span<const ParameterInfo> parameters) {
  return ParameterColumns(parameters)
      .Markdown("path as parameter,value,unit,range,source as reason or source,doc as meaning");
}

std::string ParametersCsv(std::span<const ParameterInfo> parameters) {
  return ParameterColumns(parameters)
      .Csv("path,kind,value,unit,origin,study_low,study_high,min,max,choices,source,doc");
}

std::string MetricTableText(const truth::RecordSchema& schema) {
  std::string text;
  for (const Metric& metric : statistics::MetricsOf(schema)) {
    text +=
        fmt::format("{:<25} {:<4} {:<8} margin {:<12} from {}\n    {}\n", Printable(metric.name),
                    Printable(metric.unit), TrialsOf(metric), MarginOf(metric),
                    Printable(ColumnsOf(metric)), Printable(metric.definition));
  }
  return text;
}

std::string MetricTableMarkdown(const truth::RecordSchema& schema) {
  ResultTable table("metric,unit,trials,definition,from,margin");
  for (const Metric& metric : statistics::MetricsOf(schema)) {
    table.Add(metric.name, metric.unit, TrialsOf(metric), metric.definition, ColumnsOf(metric),
              MarginOf(metric));
  }
  return table.Markdown();
}

}  // namespace rockyard::report

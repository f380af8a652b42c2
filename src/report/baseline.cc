#include "report/baseline.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "report/baseline_letters.h"
#include "statistics/metrics.h"
#include "statistics/moments.h"

namespace rockyard::report {
namespace {

using Json = nlohmann::ordered_json;
using statistics::Metric;
using statistics::MetricSource;

bool HasValue(const std::vector<double>& values) {
  for (const double value : values) {
    if (std::isfinite(value)) return true;
  }
  return false;
}

// Counts are most of the numbers: "3" rather than "3.0".
Json NumberOrNull(double value) {
  if (!std::isfinite(value)) return nullptr;
  const bool whole = std::abs(value) < 1e9 && value == std::trunc(value);
  return whole ? Json(std::llround(value)) : Json(value);
}

std::string Letters(const std::vector<truth::TrialOutcome>& outcomes) {
  std::string letters;
  for (const truth::TrialOutcome outcome : outcomes) {
    letters += kOutcomeLetters[static_cast<std::size_t>(outcome)];
  }
  return letters;
}

Json Values(const statistics::BaselineMetric& metric) {
  Json values = Json::array();
  for (const double value : metric.values) values.push_back(NumberOrNull(value));
  return values;
}

std::string Quoted(std::string_view text) { return Json(text).dump(); }

// One member per line, so that a version control system shows what changed.
std::string Lines(const Json& object, std::string_view indent) {
  std::string text = "{";
  std::string_view separator = "\n";
  for (const auto& [key, value] : object.items()) {
    text += fmt::format("{}{}  {}: {}", separator, indent, Quoted(key), value.dump());
    separator = ",\n";
  }
  return text + fmt::format("\n{}}}", indent);
}

std::string CellJson(const BaselineCell& cell) {
  Json margins = Json::object();
  Json metrics = Json::object();
  for (const statistics::BaselineMetric& each : cell.metrics) {
    margins[each.name] = NumberOrNull(each.margin);
    const Metric* metric = statistics::FindMetric(each.name);
    if (metric == nullptr || metric->source != MetricSource::kOutcome) {
      metrics[each.name] = Values(each);
    }
  }
  std::string text = "    {\n";
  const auto add = [&](std::string_view key, std::string_view value) {
    text += fmt::format("      {}: {},\n", Quoted(key), value);
  };
  add("name", Quoted(cell.name));
  add("scenario", Quoted(cell.scenario));
  add("fingerprint", Quoted(cell.fingerprint));
  add("seed", Quoted(std::to_string(cell.seed)));
  add("trial_hash", Quoted(cell.trial_hash));
  add("outcomes", Quoted(Letters(cell.outcomes)));
  add("margins", Lines(margins, "      "));
  add("metrics", Lines(metrics, "      "));
  text +=
      fmt::format("      \"resolved\": {}\n    }}", Lines(Json::parse(cell.resolved), "      "));
  return text;
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
  std::string text = fmt::format(
      "{{\n  \"kind\": \"{}\",\n  \"schema_version\": 1,\n  \"name\": {},\n  \"reason\": {},\n"
      "  \"build\": {},\n  \"cells\": [",
      kBaselineKind, Quoted(baseline.name), Quoted(baseline.reason), Quoted(baseline.build));
  std::string_view separator = "\n";
  for (const BaselineCell& cell : baseline.cells) {
    text += separator;
    text += CellJson(cell);
    separator = ",\n";
  }
  return text + "\n  ]\n}\n";
}

}  // namespace rockyard::report

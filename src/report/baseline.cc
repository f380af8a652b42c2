#include "report/baseline.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/json_text.h"
#include "report/result_table.h"
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
    const std::optional<Metric> metric = statistics::FindMetric(each.name);
    if (!metric || metric->source != MetricSource::kOutcome) {
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
  for (const Metric& metric : statistics::MetricsOf(schema)) {
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

namespace {

using Type = JsonValue::Type;

constexpr const char* kRepair = "write it anew with rockyard baseline";

class Reader {
 public:
  explicit Reader(std::vector<std::string>* unknown) : unknown_(unknown) {}

  Baseline Read(const JsonValue& json) {
    Baseline baseline;
    const JsonValue* version = json.Find("schema_version");
    if (version == nullptr || !version->Is(Type::kInteger) || version->integer() != 1) {
      Blame("schema_version", "is not 1, the only version that is known");
    }
    baseline.name = Text(json, "", "name");
    baseline.reason = Text(json, "", "reason");
    baseline.build = Text(json, "", "build");
    const JsonValue* cells = json.Find("cells");
    if (cells == nullptr || !cells->Is(Type::kList) || cells->list().empty()) {
      Blame("cells", "is no list with at least one cell");
    } else {
      for (std::size_t i = 0; i < cells->list().size(); ++i) {
        baseline.cells.push_back(ReadCell(cells->list()[i], fmt::format("cells[{}].", i)));
      }
    }
    if (!problems_.empty()) throw core::UserError(std::move(problems_));
    return baseline;
  }

 private:
  void Blame(std::string path, std::string reason) {
    problems_.push_back({std::move(path), std::move(reason), kRepair});
  }

  std::string Text(const JsonValue& json, const std::string& path, const char* key) {
    const JsonValue* value = json.Find(key);
    if (value != nullptr && value->Is(Type::kText)) return value->text();
    Blame(path + key, "is no text");
    return "";
  }

  const JsonValue* Object(const JsonValue& json, const std::string& path, const char* key) {
    const JsonValue* value = json.Find(key);
    if (value != nullptr && value->Is(Type::kObject)) return value;
    Blame(path + key, "is no object");
    return nullptr;
  }

  BaselineCell ReadCell(const JsonValue& json, const std::string& path) {
    BaselineCell cell;
    cell.name = Text(json, path, "name");
    cell.scenario = Text(json, path, "scenario");
    cell.fingerprint = Text(json, path, "fingerprint");
    cell.trial_hash = Text(json, path, "trial_hash");
    cell.seed = Seed(Text(json, path, "seed"), path + "seed");
    ReadOutcomes(Text(json, path, "outcomes"), path + "outcomes", cell);
    const JsonValue* resolved = Object(json, path, "resolved");
    if (resolved != nullptr) cell.resolved = core::DumpJson(*resolved);
    const JsonValue* margins = Object(json, path, "margins");
    const JsonValue* metrics = Object(json, path, "metrics");
    if (margins != nullptr && metrics != nullptr) ReadMetrics(*margins, *metrics, path, cell);
    return cell;
  }

  std::uint64_t Seed(const std::string& text, const std::string& path) {
    std::uint64_t seed = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size()) {
      Blame(path, "is no whole number as a text");
    }
    return seed;
  }

  void ReadOutcomes(const std::string& letters, const std::string& path, BaselineCell& cell) {
    for (const char letter : letters) {
      const std::size_t at = kOutcomeLetters.find(letter);
      if (at == std::string_view::npos) {
        Blame(path, fmt::format("has a letter other than {}", kOutcomeLetters));
        return;
      }
      cell.outcomes.push_back(static_cast<truth::TrialOutcome>(at));
    }
  }

  void ReadMetrics(const JsonValue& margins, const JsonValue& metrics, const std::string& path,
                   BaselineCell& cell) {
    for (const core::JsonMember& margin : margins.members()) {
      const std::string here = path + "margins." + margin.key;
      const std::optional<Metric> metric = statistics::FindMetric(margin.key);
      if (!metric) {
        if (unknown_ != nullptr) unknown_->push_back(margin.key);
        continue;
      }
      statistics::BaselineMetric read{.name = margin.key, .values = {}};
      if (margin.value.IsNumber() && margin.value.number() > 0.0) {
        read.margin = margin.value.number();
      } else {
        Blame(here, "is no number above 0");
      }
      read.values = metric->source == MetricSource::kOutcome
                        ? OutcomeValues(*metric, cell)
                        : ReadValues(metrics, path + "metrics.", margin.key, cell);
      cell.metrics.push_back(std::move(read));
    }
  }

  // Returns what MetricValues says of records with these outcomes.
  static std::vector<double> OutcomeValues(const Metric& metric, const BaselineCell& cell) {
    std::vector<truth::Record> records(cell.outcomes.size());
    for (std::size_t i = 0; i < records.size(); ++i) records[i].outcome = cell.outcomes[i];
    return statistics::MetricValues(metric, {}, records).value_or(std::vector<double>());
  }

  std::vector<double> ReadValues(const JsonValue& metrics, const std::string& path,
                                 const std::string& name, const BaselineCell& cell) {
    std::vector<double> values;
    const JsonValue* list = metrics.Find(name);
    if (list == nullptr || !list->Is(Type::kList) || list->list().size() != cell.outcomes.size()) {
      Blame(path + name,
            fmt::format("is no list of {} numbers, one for each trial", cell.outcomes.size()));
      return values;
    }
    for (const JsonValue& value : list->list()) {
      if (!value.IsNumber() && !value.Is(Type::kNull)) {
        Blame(path + name, "holds something that is neither a number nor null");
        return values;
      }
      values.push_back(value.IsNumber() ? value.number()
                                        : std::numeric_limits<double>::quiet_NaN());
    }
    return values;
  }

  std::vector<std::string>* unknown_;
  std::vector<core::Problem> problems_;
};

}  // namespace

bool IsBaseline(const JsonValue& json) {
  const JsonValue* kind = json.Find("kind");
  return kind != nullptr && kind->Is(Type::kText) && kind->text() == kBaselineKind;
}

Baseline ParseBaseline(const JsonValue& json, std::vector<std::string>* unknown) {
  return Reader(unknown).Read(json);
}

}  // namespace rockyard::report

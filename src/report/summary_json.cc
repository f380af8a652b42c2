#include "report/summary_json.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "core/json_text.h"
#include "report/line_text.h"
#include "report/result_table.h"
#include "report/run_description.h"

namespace rockyard::report {
namespace {

using core::JsonValue;
using core::NumberOrNull;
using statistics::ColumnSummary;
using statistics::DriveSummary;

constexpr const char* kModeMethod = "half-sample mode; range by subsampling, no coverage claimed";

JsonValue Column(const ColumnSummary* column) {
  if (column == nullptr) return JsonValue();
  return ObjectTree("count", column->count, "min", column->min, "p05", column->p05, "median",
                    column->median, "mean", column->mean, "mode", column->mode, "mode_range",
                    column->mode_range, "mode_method", kModeMethod, "p95", column->p95, "max",
                    column->max, "std", column->std);
}

JsonValue Outcomes(const DriveSummary& summary) {
  JsonValue outcomes = JsonValue::Object();
  for (std::size_t i = 0; i < truth::kTrialOutcomeNames.size(); ++i) {
    if (static_cast<truth::TrialOutcome>(i) == truth::TrialOutcome::kMeasured) continue;
    outcomes.Set(truth::kTrialOutcomeNames[i], JsonValue(summary.outcomes[i]));
  }
  return outcomes;
}

// The causes that happened.
JsonValue Causes(const DriveSummary& summary) {
  JsonValue causes = JsonValue::Object();
  for (std::size_t i = 0; i < truth::kEndCauses.size(); ++i) {
    if (summary.causes[i] > 0) causes.Set(truth::kEndCauses[i].name, JsonValue(summary.causes[i]));
  }
  return causes;
}

// Members of their own in the layout; every other column stands under "columns".
struct NamedColumn {
  std::string_view member;
  std::string_view column;
};
constexpr NamedColumn kTopColumns[] = {{"distance_m", "true_distance_m"},
                                       {"path_ratio", "path_ratio"},
                                       {"sim_time_s", "sim_time_s"},
                                       {"energy_wh", "energy_wh"}};
constexpr std::string_view kDeadReckoning[] = {"distance_error_percent", "heading_error_deg",
                                               "position_error_m"};

bool HasOwnMember(std::string_view column) {
  for (const NamedColumn& named : kTopColumns) {
    if (named.column == column) return true;
  }
  for (const std::string_view name : kDeadReckoning) {
    if (name == column) return true;
  }
  return false;
}

void AddColumns(const DriveSummary& summary, JsonValue& json) {
  for (const NamedColumn& named : kTopColumns) {
    json.Set(named.member, Column(summary.Find(named.column)));
  }
  JsonValue errors = JsonValue::Object();
  for (const std::string_view name : kDeadReckoning) {
    errors.Set(name, Column(summary.Find(name)));
  }
  json.Set("dead_reckoning", std::move(errors));
  JsonValue others = JsonValue::Object();
  for (const ColumnSummary& column : summary.columns) {
    if (!HasOwnMember(column.name)) others.Set(column.name, Column(&column));
  }
  json.Set("columns", std::move(others));
}

JsonValue MetricsJson(const std::vector<statistics::MetricSummary>& metrics) {
  JsonValue json = JsonValue::Object();
  for (const statistics::MetricSummary& summary : metrics) {
    if (summary.count > 0) json.Set(summary.metric.name, MetricJson(summary));
  }
  return json;
}

JsonValue MetricsByOutcome(const DriveSummary& summary) {
  JsonValue json = JsonValue::Object();
  for (std::size_t i = 0; i < summary.metrics_by_outcome.size(); ++i) {
    if (summary.metrics_by_outcome[i].empty()) continue;
    json.Set(truth::kTrialOutcomeNames[i], MetricsJson(summary.metrics_by_outcome[i]));
  }
  return json;
}

JsonValue CellRate(const statistics::CellRate& rate) {
  JsonValue json = RateJson(rate.rate);
  json.Set("ci95_all_cells", EndsOf(rate.simultaneous));
  return json;
}

JsonValue CellJson(const statistics::MeasurementSummary& summary, const statistics::Cell& cell) {
  JsonValue json = ObjectTree("cell", cell.number, "runs", cell.runs);
  for (std::size_t i = 0; i < cell.factors.size(); ++i) {
    json.Set(summary.factors[i].name, NumberOrNull(cell.factors[i]));
  }
  for (std::size_t i = 0; i < cell.bases.size(); ++i) {
    json.Set(summary.bases[i].name, NumberOrNull(cell.bases[i]));
  }
  for (std::size_t i = 0; i < cell.rates.size(); ++i) {
    json.Set(summary.rates[i].name, CellRate(cell.rates[i]));
  }
  for (std::size_t i = 0; i < cell.means.size(); ++i) {
    const bool squares = summary.means[i].role == truth::ColumnRole::kSquares;
    json.Set((squares ? "rms_" : "mean_") + summary.means[i].name, NumberOrNull(cell.means[i]));
  }
  return json;
}

JsonValue RunProvenance(const RunDescription& run) {
  JsonValue json = ProvenanceJson(run.provenance);
  SetMembers(json, "threads", run.threads, "ranks", 1, "builds", core::ListOf(run.builds));
  return json;
}

JsonValue Settings(const RunDescription& run) {
  return run.settings ? core::ListOf(*run.settings) : JsonValue();
}

// What runs of drives and of measurements tell alike, before and after what they found.
JsonValue Head(const RunDescription& run, std::int64_t completed, std::int64_t faults) {
  JsonValue json =
      ObjectTree("schema_version", kSchemaVersion, "scenario", run.scenario, "seed", run.seed,
                 "fingerprint", run.fingerprint, "settings", Settings(run), "localization",
                 run.localization, "ablations", core::ListOf(run.ablations), "trials",
                 ObjectTree("planned", run.planned, "stored", run.stored, "completed", completed,
                            "faults", faults));
  json.Update(AccountingJson(run));
  return json;
}

void AddTail(const RunDescription& run, JsonValue& json) {
  SetMembers(json, "trial_hash", run.trial_hash, "provenance", RunProvenance(run));
}

}  // namespace

JsonValue ProvenanceJson(const core::Provenance& p) {
  return ObjectTree("version", p.version, "commit", p.commit, "compiler", p.compiler, "flags",
                    p.flags, "build_type", p.build_type, "host", p.host, "cpu_model", p.cpu_model,
                    "cpu_level", p.cpu_level, "cpu_threads", p.cpu_threads);
}

JsonValue MeasurementValue(const RunDescription& run,
                           const statistics::MeasurementSummary& summary) {
  JsonValue json = Head(run, summary.completed, summary.faults);
  JsonValue widest = JsonValue::Object();
  for (std::size_t i = 0; i < summary.rates.size(); ++i) {
    widest.Set(summary.rates[i].name, NumberOrNull(summary.WidestInterval(i)));
  }
  SetMembers(json, "widest_ci95", std::move(widest), "simultaneous",
             "ci95_all_cells: at level 1 - 0.05 / planned_cells, all cells at once; of independent "
             "trials Clopper-Pearson",
             "planned_cells", summary.planned_cells, "cells",
             core::ListOf(summary.cells,
                          [&](const statistics::Cell& cell) { return CellJson(summary, cell); }));
  AddTail(run, json);
  return json;
}

JsonValue SummaryValue(const RunDescription& run, const DriveSummary& summary) {
  JsonValue json = Head(run, summary.completed, summary.faults);
  SetMembers(json, "declared_success", RateJson(summary.declared_success), "true_success",
             RateJson(summary.true_success), "outcomes", Outcomes(summary), "causes",
             Causes(summary), "ended_by_limit", RateJson(summary.ended_by_limit),
             "declared_success_without_limits", summary.SuccessWithoutLimits());
  AddColumns(summary, json);
  SetMembers(json, "metrics", MetricsJson(summary.metrics), "metrics_by_outcome",
             MetricsByOutcome(summary));
  AddTail(run, json);
  return json;
}

std::string MeasurementJson(const RunDescription& run,
                            const statistics::MeasurementSummary& summary) {
  return core::SpreadJson(MeasurementValue(run, summary)) + "\n";
}

std::string SummaryJson(const RunDescription& run, const DriveSummary& summary) {
  return core::SpreadJson(SummaryValue(run, summary)) + "\n";
}

std::string ResolvedScenarioJson(const RunDescription& run) {
  return core::SpreadJson(ObjectTree("scenario", core::ParseJson(run.resolved, "resolved scenario"),
                                     "fingerprint", run.fingerprint, "settings", Settings(run),
                                     "provenance", RunProvenance(run))) +
         "\n";
}

using statistics::MeanLack;

std::string ReasonOf(const statistics::MeanEstimate& estimate) {
  switch (estimate.lack) {
    case MeanLack::kNone:
      break;
    case MeanLack::kTooFewValues:
      return fmt::format("{} trials, needs {}", estimate.apart.trials, estimate.needs);
    case MeanLack::kNothingApart:
      return fmt::format("all are {}", FourDigits(estimate.usual));
    case MeanLack::kTooFewApart:
      return fmt::format("{} trials differ from {}, needs {}", estimate.apart.count,
                         FourDigits(estimate.usual), estimate.needs);
    case MeanLack::kNoBound:
      return "too long a tail for any number of trials";
  }
  return "";
}

JsonValue RateJson(const statistics::Proportion& rate) {
  return ObjectTree("count", rate.count, "trials", rate.trials, "rate", rate.rate, "ci95",
                    rate.interval, "ci_method", MethodName(rate.method));
}

JsonValue MetricJson(const statistics::MetricSummary& summary) {
  JsonValue json =
      ObjectTree("count", summary.count, "mean", summary.mean, "ci95", summary.interval);
  if (summary.metric.kind == statistics::MetricKind::kRate) {
    SetMembers(json, "ci_method", statistics::MethodName(summary.method));
    return json;
  }
  const statistics::MeanEstimate& estimate = summary.estimate;
  const statistics::Proportion& apart = estimate.apart;
  const bool lacks = estimate.lack != MeanLack::kNone;
  json.Set("ci_method", lacks ? JsonValue() : JsonValue("skewed_t"));
  if (lacks) json.Set("ci_reason", JsonValue(ReasonOf(estimate)));
  SetMembers(json, "median", summary.median, "median_ci95", summary.median_interval, "min",
             summary.min, "max", summary.max, "std", summary.deviation, "usual", estimate.usual,
             "share_apart",
             ObjectTree("count", apart.count, "rate", apart.rate, "ci95", apart.interval));
  return json;
}

}  // namespace rockyard::report

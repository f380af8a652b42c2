#include "report/summary_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "report/accounting.h"

namespace rockyard::report {
namespace {

using Json = nlohmann::ordered_json;
using statistics::ColumnSummary;
using statistics::DriveSummary;

constexpr int kSchemaVersion = 1;

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json Column(const ColumnSummary* column) {
  if (column == nullptr) return nullptr;
  return {{"count", column->count},       {"min", Number(column->min)},
          {"p05", Number(column->p05)},   {"median", Number(column->median)},
          {"mean", Number(column->mean)}, {"mode", Number(column->mode)},
          {"p95", Number(column->p95)},   {"max", Number(column->max)},
          {"std", Number(column->std)}};
}

Json Rate(const statistics::Proportion& rate, statistics::IntervalMethod method) {
  const bool wilson = method == statistics::IntervalMethod::kWilson;
  return {{"count", rate.count},
          {"trials", rate.trials},
          {"rate", Number(rate.rate)},
          {"ci95", Json::array({rate.interval.low, rate.interval.high})},
          {"ci_method", wilson ? "wilson" : "clopper_pearson"}};
}

Json Outcomes(const DriveSummary& summary) {
  Json outcomes = Json::object();
  for (std::size_t i = 0; i < truth::kTrialOutcomeNames.size(); ++i) {
    if (static_cast<truth::TrialOutcome>(i) == truth::TrialOutcome::kMeasured) continue;
    outcomes[std::string(truth::kTrialOutcomeNames[i])] = summary.outcomes[i];
  }
  return outcomes;
}

Json Program(const core::Provenance& p) {
  return {{"version", p.version},     {"commit", p.commit},         {"compiler", p.compiler},
          {"flags", p.flags},         {"build_type", p.build_type}, {"host", p.host},
          {"cpu_model", p.cpu_model}, {"cpu_level", p.cpu_level},   {"cpu_threads", p.cpu_threads}};
}

Json Provenance(const RunDescription& run) {
  Json json = Program(run.provenance);
  json["threads"] = run.threads;
  json["ranks"] = 1;
  json["builds"] = run.builds;
  return json;
}

std::string Text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
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

void AddColumns(Json& json, const DriveSummary& summary) {
  for (const NamedColumn& named : kTopColumns) {
    json[std::string(named.member)] = Column(summary.Find(named.column));
  }
  Json errors = Json::object();
  for (const std::string_view name : kDeadReckoning) {
    errors[std::string(name)] = Column(summary.Find(name));
  }
  json["dead_reckoning"] = std::move(errors);
  Json others = Json::object();
  for (const ColumnSummary& column : summary.columns) {
    if (!HasOwnMember(column.name)) others[column.name] = Column(&column);
  }
  json["columns"] = std::move(others);
}

Json Ends(const statistics::Interval& interval) {
  return Json::array({Number(interval.low), Number(interval.high)});
}

Json MetricJson(const statistics::MetricSummary& summary) {
  Json json = {
      {"count", summary.count}, {"mean", Number(summary.mean)}, {"ci95", Ends(summary.interval)}};
  if (summary.metric->kind == statistics::MetricKind::kRate) return json;
  json["median"] = Number(summary.median);
  json["median_ci95"] = Ends(summary.median_interval);
  json["min"] = Number(summary.min);
  json["max"] = Number(summary.max);
  json["std"] = Number(summary.deviation);
  return json;
}

Json MetricsJson(const std::vector<statistics::MetricSummary>& metrics) {
  Json json = Json::object();
  for (const statistics::MetricSummary& summary : metrics) {
    if (summary.count > 0) json[std::string(summary.metric->name)] = MetricJson(summary);
  }
  return json;
}

Json MetricsByOutcome(const DriveSummary& summary) {
  Json json = Json::object();
  for (std::size_t i = 0; i < summary.metrics_by_outcome.size(); ++i) {
    if (summary.metrics_by_outcome[i].empty()) continue;
    json[std::string(truth::kTrialOutcomeNames[i])] = MetricsJson(summary.metrics_by_outcome[i]);
  }
  return json;
}

Json CellJson(const statistics::MeasurementSummary& summary, const statistics::Cell& cell,
              statistics::IntervalMethod method) {
  Json json = {{"cell", cell.number}, {"runs", cell.runs}};
  for (std::size_t i = 0; i < cell.factors.size(); ++i) {
    json[summary.factors[i].name] = Number(cell.factors[i]);
  }
  for (std::size_t i = 0; i < cell.bases.size(); ++i) {
    json[summary.bases[i].name] = Number(cell.bases[i]);
  }
  for (std::size_t i = 0; i < cell.rates.size(); ++i) {
    Json rate = Rate(cell.rates[i].rate, method);
    const statistics::Interval& all = cell.rates[i].simultaneous;
    rate["ci95_all_cells"] = Json::array({all.low, all.high});
    json[summary.rates[i].name] = std::move(rate);
  }
  for (std::size_t i = 0; i < cell.means.size(); ++i) {
    const bool squares = summary.means[i].role == truth::ColumnRole::kSquares;
    json[(squares ? "rms_" : "mean_") + summary.means[i].name] = Number(cell.means[i]);
  }
  return json;
}

Json Settings(const RunDescription& run) { return run.settings ? Json(*run.settings) : Json(); }

Json Head(const RunDescription& run, std::int64_t completed, std::int64_t faults) {
  Json json = {{"schema_version", kSchemaVersion},
               {"scenario", run.scenario},
               {"seed", run.seed},
               {"fingerprint", run.fingerprint},
               {"settings", Settings(run)},
               {"localization", run.localization},
               {"ablations", run.ablations}};
  json["trials"] = {{"planned", run.planned},
                    {"stored", run.stored},
                    {"completed", completed},
                    {"faults", faults}};
  // Text, because JSON types stay inside one file.
  json.update(Json::parse(AccountingJson(run)));
  return json;
}

}  // namespace

std::string MeasurementJson(const RunDescription& run,
                            const statistics::MeasurementSummary& summary,
                            statistics::IntervalMethod method) {
  Json json = Head(run, summary.completed, summary.faults);
  Json widest = Json::object();
  for (std::size_t i = 0; i < summary.rates.size(); ++i) {
    widest[summary.rates[i].name] = summary.WidestInterval(i);
  }
  json["widest_ci95"] = std::move(widest);
  json["simultaneous"] =
      "ci95_all_cells: Clopper-Pearson at level 1 - 0.05 / planned_cells, all cells at once";
  json["planned_cells"] = summary.planned_cells;
  json["cells"] = Json::array();
  for (const statistics::Cell& cell : summary.cells) {
    json["cells"].push_back(CellJson(summary, cell, method));
  }
  json["trial_hash"] = run.trial_hash;
  json["provenance"] = Provenance(run);
  return Text(json);
}

std::string SummaryJson(const RunDescription& run, const DriveSummary& summary,
                        statistics::IntervalMethod method) {
  Json json = Head(run, summary.completed, summary.faults);
  json["declared_success"] = Rate(summary.declared_success, method);
  json["true_success"] = Rate(summary.true_success, method);
  json["outcomes"] = Outcomes(summary);
  AddColumns(json, summary);
  json["metrics"] = MetricsJson(summary.metrics);
  json["metrics_by_outcome"] = MetricsByOutcome(summary);
  json["trial_hash"] = run.trial_hash;
  json["provenance"] = Provenance(run);
  return Text(json);
}

std::string ProvenanceJson(const core::Provenance& provenance) { return Text(Program(provenance)); }

std::string ResolvedScenarioJson(const RunDescription& run) {
  return Text({{"scenario", Json::parse(run.resolved)},
               {"fingerprint", run.fingerprint},
               {"settings", Settings(run)},
               {"provenance", Provenance(run)}});
}

}  // namespace rockyard::report

#include "report/summary_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

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
    outcomes[std::string(truth::kTrialOutcomeNames[i])] = summary.outcomes[i];
  }
  return outcomes;
}

Json Provenance(const RunDescription& run) {
  const core::Provenance& p = run.provenance;
  return {{"version", p.version},
          {"commit", p.commit},
          {"compiler", p.compiler},
          {"flags", p.flags},
          {"build_type", p.build_type},
          {"host", p.host},
          {"cpu_model", p.cpu_model},
          {"cpu_level", p.cpu_level},
          {"cpu_threads", p.cpu_threads},
          {"threads", run.threads},
          {"ranks", 1},
          {"builds", run.builds}};
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

}  // namespace

std::string SummaryJson(const RunDescription& run, const DriveSummary& summary,
                        statistics::IntervalMethod method) {
  Json json = {{"schema_version", kSchemaVersion},
               {"scenario", run.scenario},
               {"seed", run.seed},
               {"fingerprint", run.fingerprint},
               {"localization", run.localization}};
  json["trials"] = {{"planned", run.planned},
                    {"stored", run.stored},
                    {"completed", summary.completed},
                    {"faults", summary.faults}};
  json["declared_success"] = Rate(summary.declared_success, method);
  json["true_success"] = Rate(summary.true_success, method);
  json["outcomes"] = Outcomes(summary);
  AddColumns(json, summary);
  json["trial_hash"] = run.trial_hash;
  json["provenance"] = Provenance(run);
  return Text(json);
}

std::string ResolvedScenarioJson(const RunDescription& run) {
  return Text({{"scenario", Json::parse(run.resolved)},
               {"fingerprint", run.fingerprint},
               {"provenance", Provenance(run)}});
}

}  // namespace rockyard::report

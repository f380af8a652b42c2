#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "report/accounting.h"
#include "report/atomic_file.h"
#include "report/sweep_files.h"

namespace rockyard::report {
namespace {

using Json = nlohmann::ordered_json;
using scenario::Sweep;

constexpr int kSchemaVersion = 1;

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json Pair(const statistics::Interval& interval) {
  return Json::array({Number(interval.low), Number(interval.high)});
}

Json Rate(const SweepRate& rate) {
  return {{"count", rate.rate.count},
          {"trials", rate.rate.trials},
          {"rate", Number(rate.rate.rate)},
          {"ci95", Pair(rate.rate.interval)},
          {"ci95_all_cells", Pair(rate.simultaneous)}};
}

Json Cell(const Sweep& sweep, std::size_t index, const SweepCellSummary& cell) {
  Json levels = Json::object();
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    const scenario::SweepLevel& level = sweep.cells[index].levels[i];
    levels[sweep.axes[i].name] = level.number ? Json(*level.number) : Json(level.text);
  }
  Json outcomes = Json::object();
  for (std::size_t i = 0; i < cell.outcomes.size(); ++i) {
    outcomes[std::string(truth::kTrialOutcomeNames[i])] = cell.outcomes[i];
  }
  Json metrics = Json::object();
  for (const statistics::MetricSummary& metric : cell.metrics) {
    metrics[std::string(metric.metric->name)] = {
        {"count", metric.count}, {"mean", Number(metric.mean)}, {"ci95", Pair(metric.interval)}};
  }
  Json json = {{"cell", index},
               {"name", sweep.cells[index].name},
               {"levels", levels},
               {"seed", sweep.cells[index].scenario.seed},
               {"trials",
                {{"planned", cell.planned},
                 {"stored", cell.stored},
                 {"completed", cell.completed},
                 {"faults", cell.faults}}},
               {"declared_success", Rate(cell.declared_success)},
               {"true_success", Rate(cell.true_success)},
               {"outcomes", outcomes},
               {"metrics", metrics},
               {"trial_hash", cell.trial_hash}};
  json.update(Json::parse(AccountingJson(cell.accounting, cell.stopping)));
  return json;
}

Json Fit(const SweepCurve& curve, std::size_t kind) {
  const statistics::LogisticFit& fit = curve.fits[kind];
  Json crossings = Json::array();
  for (const statistics::FitCrossing& crossing : curve.crossings[kind]) {
    crossings.push_back({{"rate", crossing.rate},
                         {"x", Number(crossing.x)},
                         {"ci95", Pair(crossing.interval)},
                         {"outside_of_data", crossing.extrapolated}});
  }
  return {{"curve", curve.label},
          {"success", kSuccessNames[kind]},
          {"fitted", fit.status == statistics::FitStatus::kFitted},
          {"logarithmic", fit.scale == statistics::FitScale::kLog},
          {"intercept", Number(fit.intercept)},
          {"slope", Number(fit.slope)},
          {"deviance", Number(fit.deviance)},
          {"degrees_of_freedom", fit.degrees_of_freedom},
          {"p_value", Number(fit.p_value)},
          {"clusters", fit.clusters},
          {"crossings", crossings}};
}

Json Difference(const SweepDifference& each) {
  return {{"axis", each.axis},
          {"first", each.first},
          {"second", each.second},
          {"at", each.at},
          {"success", each.success.what},
          {"paired", each.paired},
          {"difference", Number(each.success.difference)},
          {"ci95", Pair(each.success.interval)},
          {"p_value", Number(each.success.p_value)},
          {"holm_p_value", Number(each.adjusted_p)}};
}

Json Axes(const Sweep& sweep) {
  Json axes = Json::array();
  for (const scenario::SweepAxis& axis : sweep.axes) {
    axes.push_back({{"name", axis.name}, {"unit", axis.unit}, {"numeric", axis.numeric}});
  }
  return axes;
}

Json Totals(const SweepSummary& summary) {
  std::int64_t planned = 0;
  std::int64_t stored = 0;
  std::int64_t completed = 0;
  std::int64_t faults = 0;
  for (const SweepCellSummary& cell : summary.cells) {
    planned += cell.planned;
    stored += cell.stored;
    completed += cell.completed;
    faults += cell.faults;
  }
  return {{"planned", planned}, {"stored", stored}, {"completed", completed}, {"faults", faults}};
}

Json Accounted(const SweepSummary& summary) {
  return Json::parse(AccountingJson(TotalAccounting(summary), std::nullopt))["accounting"];
}

}  // namespace

std::string SweepJson(const Sweep& sweep, const SweepSummary& summary,
                      const SweepDescription& description) {
  Json cells = Json::array();
  for (std::size_t i = 0; i < summary.cells.size(); ++i) {
    cells.push_back(Cell(sweep, i, summary.cells[i]));
  }
  Json fits = Json::array();
  for (const SweepCurve& curve : summary.curves) {
    for (std::size_t kind = 0; kind < kSuccessNames.size(); ++kind) {
      fits.push_back(Fit(curve, kind));
    }
  }
  Json differences = Json::array();
  for (const SweepDifference& each : summary.differences) differences.push_back(Difference(each));
  const Json json = {{"schema_version", kSchemaVersion},
                     {"kind", "sweep"},
                     {"name", sweep.name},
                     {"seed", sweep.seed},
                     {"common_random_numbers", sweep.common_random_numbers},
                     {"axes", Axes(sweep)},
                     {"trials", Totals(summary)},
                     {"accounting", Accounted(summary)},
                     {"cells", cells},
                     {"fits", fits},
                     {"differences", differences},
                     {"attribution", Json::parse(AttributionJson(summary.attributions))},
                     {"notes", summary.notes},
                     {"trial_hash", description.trial_hash},
                     {"provenance",
                      {{"version", description.provenance.version},
                       {"commit", description.provenance.commit},
                       {"host", description.provenance.host},
                       {"threads", description.threads},
                       {"builds", description.builds}}}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void WriteSweepFiles(const std::filesystem::path& folder, const Sweep& sweep,
                     const SweepSummary& summary, const SweepDescription& description) {
  WriteFileAtomically(folder / "sweep.json", sweep.document);
  WriteFileAtomically(folder / "cells.csv", SweepCellsCsv(sweep, summary));
  WriteFileAtomically(folder / "curves.csv", SweepCurvesCsv(sweep, summary));
  WriteFileAtomically(folder / "fit.csv", SweepFitCsv(summary));
  WriteFileAtomically(folder / "fits.csv", SweepFitsCsv(summary));
  WriteFileAtomically(folder / "differences.csv", SweepDifferencesCsv(summary));
  if (!summary.attributions.empty()) {
    WriteFileAtomically(folder / "attribution.csv", AttributionCsv(summary.attributions));
  }
  const std::string drawing = SweepSvg(sweep, summary);
  if (!drawing.empty()) WriteFileAtomically(folder / "success.svg", drawing);
  WriteFileAtomically(folder / "summary.json", SweepJson(sweep, summary, description));
}

}  // namespace rockyard::report

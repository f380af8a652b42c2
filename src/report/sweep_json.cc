#include <utility>
#include <vector>

#include "core/json_text.h"
#include "report/accounting.h"
#include "report/atomic_file.h"
#include "report/mean_words.h"
#include "report/sweep_files.h"

namespace rockyard::report {
namespace {

using core::JsonValue;
using core::NumberOrNull;
using scenario::Sweep;

JsonValue Trials(const SweepCellSummary& cell) {
  return JsonValue::Object({{"planned", cell.planned},
                            {"stored", cell.stored},
                            {"completed", cell.completed},
                            {"faults", cell.faults}});
}

JsonValue Rate(const SweepRate& rate) {
  return JsonValue::Object({{"count", rate.rate.count},
                            {"trials", rate.rate.trials},
                            {"rate", NumberOrNull(rate.rate.rate)},
                            {"ci95", EndsOf(rate.rate.interval)},
                            {"ci95_all_cells", EndsOf(rate.simultaneous)}});
}

JsonValue Levels(const Sweep& sweep, const scenario::SweepCell& cell) {
  JsonValue levels = JsonValue::Object();
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    const scenario::SweepLevel& level = cell.levels[i];
    levels.Set(sweep.axes[i].name,
               level.number ? NumberOrNull(*level.number) : JsonValue(level.text));
  }
  return levels;
}

JsonValue Outcomes(const SweepCellSummary& cell) {
  JsonValue outcomes = JsonValue::Object();
  for (std::size_t i = 0; i < cell.outcomes.size(); ++i) {
    outcomes.Set(truth::kTrialOutcomeNames[i], JsonValue(cell.outcomes[i]));
  }
  return outcomes;
}

JsonValue Metrics(const SweepCellSummary& cell) {
  JsonValue metrics = JsonValue::Object();
  for (const statistics::MetricSummary& metric : cell.metrics) {
    metrics.Set(metric.metric->name, MetricJson(metric));
  }
  return metrics;
}

JsonValue Cell(const Sweep& sweep, std::size_t index, const SweepCellSummary& cell) {
  JsonValue json = JsonValue::Object({{"cell", index},
                                      {"name", sweep.cells[index].name},
                                      {"levels", Levels(sweep, sweep.cells[index])},
                                      {"seed", sweep.cells[index].scenario.seed},
                                      {"trials", Trials(cell)},
                                      {"declared_success", Rate(cell.declared_success)},
                                      {"true_success", Rate(cell.true_success)},
                                      {"outcomes", Outcomes(cell)}});
  json.Set("ended_by_limit", RateJson(cell.ended_by_limit));
  json.Set("declared_success_without_limits", EndsOf(cell.success_without_limits));
  json.Set("metrics", Metrics(cell));
  json.Set("trial_hash", JsonValue(cell.trial_hash));
  json.Update(AccountingJson(cell.accounting, cell.stopping));
  return json;
}

JsonValue Crossing(const statistics::FitCrossing& crossing) {
  return JsonValue::Object({{"rate", NumberOrNull(crossing.rate)},
                            {"x", NumberOrNull(crossing.x)},
                            {"ci95", EndsOf(crossing.interval)},
                            {"outside_of_data", crossing.extrapolated}});
}

JsonValue Fit(const SweepCurve& curve, std::size_t kind) {
  const statistics::LogisticFit& fit = curve.fits[kind];
  return JsonValue::Object({{"curve", curve.label},
                            {"success", kSuccessNames[kind]},
                            {"fitted", fit.status == statistics::FitStatus::kFitted},
                            {"logarithmic", fit.scale == statistics::FitScale::kLog},
                            {"intercept", NumberOrNull(fit.intercept)},
                            {"slope", NumberOrNull(fit.slope)},
                            {"deviance", NumberOrNull(fit.deviance)},
                            {"degrees_of_freedom", fit.degrees_of_freedom},
                            {"p_value", NumberOrNull(fit.p_value)},
                            {"clusters", fit.clusters},
                            {"crossings", core::ListOf(curve.crossings[kind], Crossing)}});
}

JsonValue Difference(const SweepDifference& each) {
  return JsonValue::Object({{"axis", each.axis},
                            {"first", each.first},
                            {"second", each.second},
                            {"at", each.at},
                            {"success", each.success.what},
                            {"paired", each.paired},
                            {"difference", NumberOrNull(each.success.difference)},
                            {"ci95", EndsOf(each.success.interval)},
                            {"p_value", NumberOrNull(each.success.p_value)},
                            {"holm_p_value", NumberOrNull(each.adjusted_p)}});
}

JsonValue Axis(const scenario::SweepAxis& axis) {
  return JsonValue::Object({{"name", axis.name}, {"unit", axis.unit}, {"numeric", axis.numeric}});
}

JsonValue Totals(const SweepSummary& summary) {
  SweepCellSummary total;
  for (const SweepCellSummary& cell : summary.cells) {
    total.planned += cell.planned;
    total.stored += cell.stored;
    total.completed += cell.completed;
    total.faults += cell.faults;
  }
  return Trials(total);
}

JsonValue Cells(const Sweep& sweep, const SweepSummary& summary) {
  JsonValue::List cells;
  for (std::size_t i = 0; i < summary.cells.size(); ++i) {
    cells.push_back(Cell(sweep, i, summary.cells[i]));
  }
  return JsonValue(std::move(cells));
}

JsonValue Fits(const std::vector<SweepCurve>& curves) {
  JsonValue::List fits;
  for (const SweepCurve& curve : curves) {
    for (std::size_t kind = 0; kind < kSuccessNames.size(); ++kind) {
      fits.push_back(Fit(curve, kind));
    }
  }
  return JsonValue(std::move(fits));
}

JsonValue Provenance(const SweepDescription& description) {
  return JsonValue::Object({{"version", description.provenance.version},
                            {"commit", description.provenance.commit},
                            {"host", description.provenance.host},
                            {"threads", description.threads},
                            {"builds", core::ListOf(description.builds)}});
}

}  // namespace

JsonValue SweepValue(const Sweep& sweep, const SweepSummary& summary,
                     const SweepDescription& description) {
  JsonValue json = JsonValue::Object({{"schema_version", kSchemaVersion},
                                      {"kind", "sweep"},
                                      {"name", sweep.name},
                                      {"seed", sweep.seed},
                                      {"common_random_numbers", sweep.common_random_numbers},
                                      {"axes", core::ListOf(sweep.axes, Axis)},
                                      {"trials", Totals(summary)}});
  json.Update(AccountingJson(TotalAccounting(summary), std::nullopt));
  json.Set("cells", Cells(sweep, summary));
  json.Set("fits", Fits(summary.curves));
  json.Set("differences", core::ListOf(summary.differences, Difference));
  json.Set("attribution", AttributionJson(summary.attributions));
  json.Set("notes", core::ListOf(summary.notes));
  json.Set("trial_hash", JsonValue(description.trial_hash));
  json.Set("provenance", Provenance(description));
  return json;
}

std::string SweepJson(const Sweep& sweep, const SweepSummary& summary,
                      const SweepDescription& description) {
  return core::SpreadJson(SweepValue(sweep, summary, description)) + "\n";
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

#include <utility>
#include <vector>

#include "core/json_text.h"
#include "report/accounting.h"
#include "report/atomic_file.h"
#include "report/json_members.h"
#include "report/mean_words.h"
#include "report/sweep_files.h"

namespace rockyard::report {
namespace {

using core::JsonValue;
using scenario::Sweep;

JsonValue Trials(const SweepCellSummary& cell) {
  return ObjectTree("planned", cell.planned, "stored", cell.stored, "completed", cell.completed,
                    "faults", cell.faults);
}

JsonValue Rate(const SweepRate& rate) {
  return ObjectTree("count", rate.rate.count, "trials", rate.rate.trials, "rate", rate.rate.rate,
                    "ci95", rate.rate.interval, "ci95_all_cells", rate.simultaneous);
}

JsonValue Levels(const Sweep& sweep, const scenario::SweepCell& cell) {
  JsonValue levels = JsonValue::Object();
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    const scenario::SweepLevel& level = cell.levels[i];
    levels.Set(sweep.axes[i].name,
               level.number ? core::NumberOrNull(*level.number) : JsonValue(level.text));
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
  const scenario::SweepCell& planned = sweep.cells[index];
  JsonValue json =
      ObjectTree("cell", index, "name", planned.name, "levels", Levels(sweep, planned), "seed",
                 planned.scenario.seed, "trials", Trials(cell), "declared_success",
                 Rate(cell.declared_success), "true_success", Rate(cell.true_success), "outcomes",
                 Outcomes(cell), "ended_by_limit", RateJson(cell.ended_by_limit),
                 "declared_success_without_limits", cell.success_without_limits, "metrics",
                 Metrics(cell), "trial_hash", cell.trial_hash);
  json.Update(AccountingJson(cell.accounting, cell.stopping));
  return json;
}

JsonValue Crossing(const statistics::FitCrossing& crossing) {
  return ObjectTree("rate", crossing.rate, "x", crossing.x, "ci95", crossing.interval,
                    "outside_of_data", crossing.extrapolated);
}

JsonValue Fit(const SweepCurve& curve, std::size_t kind) {
  const statistics::LogisticFit& fit = curve.fits[kind];
  return ObjectTree("curve", curve.label, "success", kSuccessNames[kind], "fitted",
                    fit.status == statistics::FitStatus::kFitted, "logarithmic",
                    fit.scale == statistics::FitScale::kLog, "intercept", fit.intercept, "slope",
                    fit.slope, "deviance", fit.deviance, "degrees_of_freedom",
                    fit.degrees_of_freedom, "p_value", fit.p_value, "clusters", fit.clusters,
                    "crossings", core::ListOf(curve.crossings[kind], Crossing));
}

JsonValue Difference(const SweepDifference& each) {
  const SuccessComparison& success = each.success;
  return ObjectTree("axis", each.axis, "first", each.first, "second", each.second, "at", each.at,
                    "success", success.what, "paired", each.paired, "difference",
                    success.difference, "ci95", success.interval, "p_value", success.p_value,
                    "holm_p_value", each.adjusted_p);
}

JsonValue Axis(const scenario::SweepAxis& axis) {
  return ObjectTree("name", axis.name, "unit", axis.unit, "numeric", axis.numeric);
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
  const core::Provenance& provenance = description.provenance;
  return ObjectTree("version", provenance.version, "commit", provenance.commit, "host",
                    provenance.host, "threads", description.threads, "builds",
                    core::ListOf(description.builds));
}

}  // namespace

JsonValue SweepValue(const Sweep& sweep, const SweepSummary& summary,
                     const SweepDescription& description) {
  JsonValue json =
      ObjectTree("schema_version", kSchemaVersion, "kind", "sweep", "name", sweep.name, "seed",
                 sweep.seed, "common_random_numbers", sweep.common_random_numbers, "axes",
                 core::ListOf(sweep.axes, Axis), "trials", Trials(TotalTrials(summary)));
  json.Update(AccountingJson(TotalAccounting(summary), std::nullopt));
  SetMembers(json, "cells", Cells(sweep, summary), "fits", Fits(summary.curves), "differences",
             core::ListOf(summary.differences, Difference), "attribution",
             AttributionJson(summary.attributions), "notes", core::ListOf(summary.notes),
             "trial_hash", description.trial_hash, "provenance", Provenance(description));
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

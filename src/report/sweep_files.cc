#include "report/sweep_files.h"

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json_text.h"
#include "report/atomic_file.h"
#include "report/result_table.h"
#include "report/run_description.h"
#include "report/summary_json.h"
#include "report/sweep_summary.h"

namespace rockyard::report {
namespace {

using scenario::Sweep;

void AddAxes(const Sweep& sweep, CsvRow& row) {
  for (const scenario::SweepAxis& axis : sweep.axes) row.Add(axis.name);
}

void AddLevels(const scenario::SweepCell& cell, CsvRow& row) {
  for (const scenario::SweepLevel& level : cell.levels) row.Add(level.text);
}

void AddRate(const SweepRate& rate, CsvRow& row) {
  row.Add(rate.rate.rate, rate.rate.interval, rate.simultaneous);
}

std::string CellCsvLine(std::size_t index, const Sweep& sweep, const SweepCellSummary& cell) {
  const scenario::SweepCell& planned = sweep.cells[index];
  CsvRow row(index, planned.name);
  AddLevels(planned, row);
  row.Add(planned.scenario.seed, cell.planned, cell.stored, cell.completed, cell.faults,
          cell.outcomes);
  AddRate(cell.declared_success, row);
  AddRate(cell.true_success, row);
  row.Add(cell.trial_hash, cell.accounting.pending, cell.accounting.infrastructure_faults);
  if (cell.stopping) {
    row.Add(cell.stopping->end, cell.stopping->trials, cell.stopping->low, cell.stopping->high);
  } else {
    row.AddEmpty(4);
  }
  return row.Add(cell.ended_by_limit.count).Line();
}

// Must stay in the order of statistics::FitStatus.
constexpr std::array<std::string_view, 4> kStatusNames{"fitted", "too_few_points", "no_contrast",
                                                       "separated"};

std::string FitCsvLine(const SweepCurve& curve, std::size_t kind) {
  const statistics::LogisticFit& fit = curve.fits[kind];
  CsvRow row(curve.label, kSuccessNames[kind], kStatusNames[static_cast<std::size_t>(fit.status)],
             fit.scale == statistics::FitScale::kLog ? "log" : "linear", fit.intercept, fit.slope,
             fit.covariance, fit.deviance, fit.degrees_of_freedom, fit.p_value, fit.slope_p_value);
  if (curve.crossings[kind].empty()) row.AddEmpty(8);
  for (const statistics::FitCrossing& crossing : curve.crossings[kind]) {
    row.Add(crossing.x, crossing.interval, crossing.extrapolated ? "outside" : "inside");
  }
  return row.Add(fit.clusters).Line();
}

}  // namespace

std::string SweepCellsCsv(const Sweep& sweep, const SweepSummary& summary) {
  CsvRow head("cell", "name");
  AddAxes(sweep, head);
  head.Add("seed", "planned", "stored", "completed", "faults", truth::kTrialOutcomeNames);
  for (const std::string name : {"declared_success", "true_success"}) {
    for (const char* suffix : {"", "_low", "_high", "_all_low", "_all_high"}) {
      head.Add(name + suffix);
    }
  }
  head.Add("trial_hash", "pending", "infrastructure_faults", "stopped", "stopped_at", "stop_low",
           "stop_high", "ended_by_limit");
  std::string csv = head.Line();
  for (std::size_t i = 0; i < summary.cells.size(); ++i) {
    csv += CellCsvLine(i, sweep, summary.cells[i]);
  }
  return csv;
}

std::string SweepCurvesCsv(const Sweep& sweep, const SweepSummary& summary) {
  CsvRow head("cell");
  AddAxes(sweep, head);
  head.Add("metric", "unit", "n", "mean", "mean_low", "mean_high", "median", "median_low",
           "median_high");
  std::string csv = head.Line();
  for (std::size_t i = 0; i < summary.cells.size(); ++i) {
    for (const statistics::MetricSummary& metric : summary.cells[i].metrics) {
      CsvRow row(i);
      AddLevels(sweep.cells[i], row);
      row.Add(metric.metric.name, metric.metric.unit, metric.count, metric.mean, metric.interval,
              metric.median, metric.median_interval);
      csv += row.Line();
    }
  }
  return csv;
}

std::string SweepFitCsv(const SweepSummary& summary) {
  std::string csv = "curve,success,x,rate,low,high\n";
  for (const SweepCurve& curve : summary.curves) {
    for (std::size_t kind = 0; kind < kSuccessNames.size(); ++kind) {
      for (const FitPoint& point : FittedLine(curve.fits[kind])) {
        csv += CsvLine(curve.label, kSuccessNames[kind], point.x, point.rate, point.band);
      }
    }
  }
  return csv;
}

std::string SweepFitsCsv(const SweepSummary& summary) {
  std::string csv =
      "curve,success,status,scale,intercept,slope,var_intercept,covariance,var_slope,deviance,"
      "degrees_of_freedom,p_value,slope_p_value,x90,x90_low,x90_high,x90_place,x50,x50_low,"
      "x50_high,x50_place,clusters\n";
  for (const SweepCurve& curve : summary.curves) {
    for (std::size_t kind = 0; kind < kSuccessNames.size(); ++kind) {
      csv += FitCsvLine(curve, kind);
    }
  }
  return csv;
}

std::string SweepDifferencesCsv(const SweepSummary& summary) {
  std::string csv =
      "axis,first,second,at,success,paired,n_first,rate_first,n_second,rate_second,difference,low,"
      "high,both,only_first,only_second,neither,p_value,holm_p_value\n";
  for (const SweepDifference& each : summary.differences) {
    const SuccessComparison& success = each.success;
    CsvRow row(each.axis, each.first, each.second, each.at, success.what,
               each.paired ? "yes" : "no", success.first.trials, success.first.rate,
               success.second.trials, success.second.rate, success.difference, success.interval);
    const statistics::PairedCounts& counts = success.counts;
    if (each.paired) {
      row.Add(counts.both, counts.only_first, counts.only_second, counts.neither);
    } else {
      row.AddEmpty(4);
    }
    csv += row.Add(success.p_value, each.adjusted_p).Line();
  }
  return csv;
}

namespace {

using core::JsonValue;

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
    metrics.Set(metric.metric.name, MetricJson(metric));
  }
  return metrics;
}

JsonValue CellTree(const Sweep& sweep, std::size_t index, const SweepCellSummary& cell) {
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
    cells.push_back(CellTree(sweep, i, summary.cells[i]));
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

#include <array>
#include <string_view>

#include "report/csv.h"
#include "report/sweep_curves.h"
#include "report/sweep_files.h"

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

// In the order of statistics::FitStatus.
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
      row.Add(metric.metric->name, metric.metric->unit, metric.count, metric.mean, metric.interval,
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

}  // namespace rockyard::report

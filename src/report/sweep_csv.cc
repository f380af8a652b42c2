#include <cmath>
#include <string_view>
#include <vector>

#include "report/csv.h"
#include "report/sweep_curves.h"
#include "report/sweep_files.h"

namespace rockyard::report {
namespace {

using scenario::Sweep;
using Fields = std::vector<std::string>;

void AddAxes(const Sweep& sweep, Fields& fields) {
  for (const scenario::SweepAxis& axis : sweep.axes) fields.push_back(CsvField(axis.name));
}

void AddLevels(const scenario::SweepCell& cell, Fields& fields) {
  for (const scenario::SweepLevel& level : cell.levels) fields.push_back(CsvField(level.text));
}

void AddInterval(const statistics::Interval& interval, Fields& fields) {
  fields.push_back(CsvNumber(interval.low));
  fields.push_back(CsvNumber(interval.high));
}

void AddRate(const SweepRate& rate, Fields& fields) {
  fields.push_back(CsvNumber(rate.rate.rate));
  AddInterval(rate.rate.interval, fields);
  AddInterval(rate.simultaneous, fields);
}

Fields CellFields(std::size_t index, const Sweep& sweep, const SweepCellSummary& cell) {
  const scenario::SweepCell& planned = sweep.cells[index];
  Fields fields{std::to_string(index), CsvField(planned.name)};
  AddLevels(planned, fields);
  for (const std::int64_t number :
       {planned.scenario.seed, cell.planned, cell.stored, cell.completed, cell.faults}) {
    fields.push_back(std::to_string(number));
  }
  for (const std::int64_t count : cell.outcomes) fields.push_back(std::to_string(count));
  AddRate(cell.declared_success, fields);
  AddRate(cell.true_success, fields);
  fields.push_back(cell.trial_hash);
  fields.push_back(std::to_string(cell.accounting.pending));
  fields.push_back(std::to_string(cell.accounting.infrastructure_faults));
  if (cell.stopping) {
    fields.push_back(cell.stopping->end);
    fields.push_back(std::to_string(cell.stopping->trials));
    AddInterval({cell.stopping->low, cell.stopping->high}, fields);
  } else {
    fields.resize(fields.size() + 4);
  }
  fields.push_back(std::to_string(cell.ended_by_limit.count));
  return fields;
}

std::string_view StatusName(statistics::FitStatus status) {
  switch (status) {
    case statistics::FitStatus::kFitted:
      return "fitted";
    case statistics::FitStatus::kTooFewPoints:
      return "too_few_points";
    case statistics::FitStatus::kNoContrast:
      return "no_contrast";
    case statistics::FitStatus::kSeparated:
      return "separated";
  }
  return "";
}

Fields FitFields(const SweepCurve& curve, std::size_t kind) {
  const statistics::LogisticFit& fit = curve.fits[kind];
  Fields fields{CsvField(curve.label), std::string(kSuccessNames[kind]),
                std::string(StatusName(fit.status)),
                fit.scale == statistics::FitScale::kLog ? "log" : "linear"};
  for (const double number :
       {fit.intercept, fit.slope, fit.covariance[0], fit.covariance[1], fit.covariance[2],
        fit.deviance, static_cast<double>(fit.degrees_of_freedom), fit.p_value,
        fit.slope_p_value}) {
    fields.push_back(CsvNumber(number));
  }
  if (curve.crossings[kind].empty()) fields.resize(fields.size() + 8);
  for (const statistics::FitCrossing& crossing : curve.crossings[kind]) {
    fields.push_back(CsvNumber(crossing.x));
    AddInterval(crossing.interval, fields);
    fields.emplace_back(crossing.extrapolated ? "outside" : "inside");
  }
  fields.push_back(std::to_string(fit.clusters));
  return fields;
}

}  // namespace

std::string SweepCellsCsv(const Sweep& sweep, const SweepSummary& summary) {
  Fields head{"cell", "name"};
  AddAxes(sweep, head);
  for (const char* name : {"seed", "planned", "stored", "completed", "faults"}) {
    head.emplace_back(name);
  }
  for (const std::string_view outcome : truth::kTrialOutcomeNames) head.emplace_back(outcome);
  for (const std::string name : {"declared_success", "true_success"}) {
    for (const char* suffix : {"", "_low", "_high", "_all_low", "_all_high"}) {
      head.push_back(name + suffix);
    }
  }
  for (const char* name : {"trial_hash", "pending", "infrastructure_faults", "stopped",
                           "stopped_at", "stop_low", "stop_high", "ended_by_limit"}) {
    head.emplace_back(name);
  }
  std::string csv = CsvLine(head);
  for (std::size_t i = 0; i < summary.cells.size(); ++i) {
    csv += CsvLine(CellFields(i, sweep, summary.cells[i]));
  }
  return csv;
}

std::string SweepCurvesCsv(const Sweep& sweep, const SweepSummary& summary) {
  Fields head{"cell"};
  AddAxes(sweep, head);
  for (const char* name : {"metric", "unit", "n", "mean", "mean_low", "mean_high", "median",
                           "median_low", "median_high"}) {
    head.emplace_back(name);
  }
  std::string csv = CsvLine(head);
  for (std::size_t i = 0; i < summary.cells.size(); ++i) {
    for (const statistics::MetricSummary& metric : summary.cells[i].metrics) {
      Fields fields{std::to_string(i)};
      AddLevels(sweep.cells[i], fields);
      fields.emplace_back(metric.metric->name);
      fields.emplace_back(metric.metric->unit);
      fields.push_back(std::to_string(metric.count));
      fields.push_back(CsvNumber(metric.mean));
      AddInterval(metric.interval, fields);
      fields.push_back(CsvNumber(metric.median));
      AddInterval(metric.median_interval, fields);
      csv += CsvLine(fields);
    }
  }
  return csv;
}

std::string SweepFitCsv(const SweepSummary& summary) {
  std::string csv = "curve,success,x,rate,low,high\n";
  for (const SweepCurve& curve : summary.curves) {
    for (std::size_t kind = 0; kind < kSuccessNames.size(); ++kind) {
      for (const FitPoint& point : FittedLine(curve.fits[kind])) {
        csv += CsvLine(Fields{CsvField(curve.label), std::string(kSuccessNames[kind]),
                              CsvNumber(point.x), CsvNumber(point.rate), CsvNumber(point.band.low),
                              CsvNumber(point.band.high)});
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
      csv += CsvLine(FitFields(curve, kind));
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
    Fields fields{CsvField(each.axis), CsvField(each.first), CsvField(each.second),
                  CsvField(each.at),   success.what,         each.paired ? "yes" : "no"};
    for (const statistics::Proportion& rate : {success.first, success.second}) {
      fields.push_back(std::to_string(rate.trials));
      fields.push_back(CsvNumber(rate.rate));
    }
    fields.push_back(CsvNumber(success.difference));
    AddInterval(success.interval, fields);
    const statistics::PairedCounts& counts = success.counts;
    for (const std::int64_t count :
         {counts.both, counts.only_first, counts.only_second, counts.neither}) {
      fields.push_back(each.paired ? std::to_string(count) : std::string());
    }
    fields.push_back(CsvNumber(success.p_value));
    fields.push_back(CsvNumber(each.adjusted_p));
    csv += CsvLine(fields);
  }
  return csv;
}

}  // namespace rockyard::report

#include "report/sweep_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "report/accounting.h"
#include "statistics/drive_summary.h"
#include "statistics/multiple_testing.h"

namespace rockyard::report {
namespace {

using scenario::Sweep;
using scenario::SweepCell;
using statistics::Proportion;
using truth::Record;

constexpr double kConfidence = 0.95;
constexpr std::array<double, 2> kCrossingRates{0.9, 0.5};

SweepRate RateOf(const Proportion& rate, std::size_t cells) {
  const double alone = 1.0 - (1.0 - kConfidence) / static_cast<double>(cells);
  return {rate, statistics::ProportionInterval(rate.count, rate.trials, alone,
                                               statistics::IntervalMethod::kClopperPearson)};
}

SweepCellSummary SummarizeCell(const SweepCellTrials& trials, std::size_t cells,
                               statistics::IntervalMethod method) {
  const statistics::DriveSummary drive =
      statistics::Summarize(trials.schema, trials.prefix, trials.planned, method);
  SweepCellSummary summary;
  summary.planned = trials.planned;
  summary.stored = trials.stored;
  summary.accounting = trials.accounting;
  summary.stopping = trials.stopping;
  summary.completed = drive.completed;
  summary.faults = drive.faults;
  summary.declared_success = RateOf(drive.declared_success, cells);
  summary.true_success = RateOf(drive.true_success, cells);
  summary.outcomes = drive.outcomes;
  summary.metrics = statistics::SummarizeMetrics(trials.schema, trials.prefix, method);
  summary.trial_hash = trials.trial_hash;
  return summary;
}

// The levels of a cell but for one axis: what has to be equal for two cells to be compared along
// it.
std::string Others(const Sweep& sweep, const SweepCell& cell, std::size_t axis) {
  std::string text;
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    if (i == axis) continue;
    text +=
        fmt::format("{}{}={}", text.empty() ? "" : ",", sweep.axes[i].name, cell.levels[i].text);
  }
  return text;
}

// Cells that differ along one axis alone, in the order of the sweep.
std::vector<std::pair<std::string, std::vector<std::size_t>>> Groups(const Sweep& sweep,
                                                                     std::size_t axis) {
  std::vector<std::pair<std::string, std::vector<std::size_t>>> groups;
  std::map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    const std::string others = Others(sweep, sweep.cells[i], axis);
    const auto [at, fresh] = known.try_emplace(others, groups.size());
    if (fresh) groups.emplace_back(others, std::vector<std::size_t>());
    groups[at->second].second.push_back(i);
  }
  return groups;
}

SweepCurve Curve(const Sweep& sweep, const std::vector<SweepCellSummary>& cells, std::string label,
                 std::vector<std::size_t> members) {
  const std::size_t axis = *sweep.fit_axis;
  const auto number = [&](std::size_t cell) { return *sweep.cells[cell].levels[axis].number; };
  std::sort(members.begin(), members.end(),
            [&](std::size_t a, std::size_t b) { return number(a) < number(b); });
  SweepCurve curve{
      .label = std::move(label), .cells = std::move(members), .x = {}, .fits = {}, .crossings = {}};
  for (const std::size_t cell : curve.cells) curve.x.push_back(number(cell));
  const bool log = sweep.fit_scale == scenario::AxisScale::kLog && curve.x.front() > 0.0;
  for (std::size_t kind = 0; kind < 2; ++kind) {
    std::vector<statistics::DosePoint> points;
    for (std::size_t i = 0; i < curve.cells.size(); ++i) {
      const SweepCellSummary& cell = cells[curve.cells[i]];
      const Proportion& rate = kind == 0 ? cell.declared_success.rate : cell.true_success.rate;
      points.push_back({curve.x[i], rate.count, rate.trials});
    }
    statistics::LogisticFit& fit = curve.fits[kind];
    fit = statistics::FitLogistic(points,
                                  log ? statistics::FitScale::kLog : statistics::FitScale::kLinear);
    if (fit.status != statistics::FitStatus::kFitted) continue;
    for (const double rate : kCrossingRates) {
      curve.crossings[kind].push_back(statistics::FindCrossing(fit, points, rate));
    }
  }
  return curve;
}

// Points that fill several axes share no levels: each would be a curve of its own.
bool HasCurves(const Sweep& sweep) {
  return sweep.fit_axis && (sweep.design == scenario::DesignKind::kGrid || sweep.axes.size() == 1);
}

std::vector<SweepCurve> Curves(const Sweep& sweep, const std::vector<SweepCellSummary>& cells) {
  std::vector<SweepCurve> curves;
  if (!HasCurves(sweep)) return curves;
  for (auto& [label, members] : Groups(sweep, *sweep.fit_axis)) {
    curves.push_back(Curve(sweep, cells, label, std::move(members)));
  }
  return curves;
}

// Records without their values: what comparing successes needs.
std::vector<Record> OutcomesOf(const std::vector<Record>& records) {
  std::vector<Record> outcomes;
  outcomes.reserve(records.size());
  for (const Record& record : records) {
    outcomes.push_back({record.trial, record.outcome, {}, {}});
  }
  return outcomes;
}

class Comparer {
 public:
  Comparer(const Sweep& sweep, const std::vector<std::vector<Record>>& outcomes)
      : sweep_(sweep), outcomes_(outcomes) {}

  std::vector<SweepDifference> Compare() {
    if (sweep_.design == scenario::DesignKind::kGrid) {
      for (std::size_t axis = 0; axis < sweep_.axes.size(); ++axis) {
        if (!sweep_.axes[axis].numeric) CompareAlong(axis);
      }
    }
    std::vector<double> p_values;
    for (const SweepDifference& each : differences_) p_values.push_back(each.success.p_value);
    const std::vector<double> adjusted = statistics::HolmAdjust(p_values);
    for (std::size_t i = 0; i < adjusted.size(); ++i) differences_[i].adjusted_p = adjusted[i];
    return std::move(differences_);
  }

 private:
  void CompareAlong(std::size_t axis) {
    for (const auto& [at, members] : Groups(sweep_, axis)) {
      for (std::size_t i = 1; i < members.size(); ++i) Add(axis, at, members.front(), members[i]);
    }
  }

  void Add(std::size_t axis, const std::string& at, std::size_t first, std::size_t second) {
    const RunComparison comparison = CompareRuns(View(first), View(second));
    for (const SuccessComparison& success : comparison.successes) {
      differences_.push_back({.axis = sweep_.axes[axis].name,
                              .first = sweep_.cells[first].levels[axis].text,
                              .second = sweep_.cells[second].levels[axis].text,
                              .at = at,
                              .paired = comparison.paired,
                              .success = success});
    }
  }

  ComparedRun View(std::size_t cell) const {
    return {.name = sweep_.cells[cell].name,
            .seed = static_cast<std::uint64_t>(sweep_.cells[cell].scenario.seed),
            .schema = {},
            .records = outcomes_[cell]};
  }

  const Sweep& sweep_;
  const std::vector<std::vector<Record>>& outcomes_;
  std::vector<SweepDifference> differences_;
};

// With common random numbers, cells whose trials are equal to the last bit differ by a setting that
// does nothing.
std::vector<std::string> EqualCells(const Sweep& sweep,
                                    const std::vector<SweepCellSummary>& cells) {
  std::vector<std::string> notes;
  std::map<std::pair<std::string, std::int64_t>, std::size_t> known;
  for (std::size_t i = 0; sweep.common_random_numbers && i < cells.size(); ++i) {
    if (cells[i].completed == 0 || cells[i].completed == cells[i].faults) continue;
    const auto [at, fresh] = known.try_emplace({cells[i].trial_hash, cells[i].completed}, i);
    if (fresh) continue;
    notes.push_back(fmt::format(
        "every trial of cell {} is equal to that of cell {}: what they differ in had no effect",
        sweep.cells[i].name, sweep.cells[at->second].name));
  }
  return notes;
}

}  // namespace

double FitAbscissa(const statistics::LogisticFit& fit, double share) {
  if (fit.scale == statistics::FitScale::kLinear) {
    return fit.lowest_x + share * (fit.highest_x - fit.lowest_x);
  }
  return fit.lowest_x * std::pow(fit.highest_x / fit.lowest_x, share);
}

Accounting TotalAccounting(const SweepSummary& summary) {
  Accounting total;
  for (const SweepCellSummary& cell : summary.cells) total = Sum(total, cell.accounting);
  return total;
}

SweepSummary SummarizeSweep(const Sweep& sweep, const SweepCellLoader& load,
                            statistics::IntervalMethod method) {
  SweepSummary summary;
  std::vector<std::vector<Record>> outcomes;
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    const SweepCellTrials trials = load(i);
    summary.cells.push_back(SummarizeCell(trials, sweep.cells.size(), method));
    outcomes.push_back(OutcomesOf(trials.prefix));
  }
  summary.curves = Curves(sweep, summary.cells);
  summary.differences = Comparer(sweep, outcomes).Compare();
  summary.attributions = AttributeSweep(sweep, outcomes);
  summary.notes = EqualCells(sweep, summary.cells);
  return summary;
}

}  // namespace rockyard::report

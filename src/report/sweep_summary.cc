#include "report/sweep_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/numbers.h"
#include "report/run_description.h"
#include "report/trial_outcomes.h"
#include "statistics/clustered_rate.h"
#include "statistics/drive_summary.h"
#include "statistics/multiple_testing.h"

namespace rockyard::report {
namespace {

using scenario::Sweep;
using scenario::SweepCell;
using statistics::ClusterScores;
using statistics::DosePoint;
using statistics::FitScale;
using statistics::FitStatus;
using statistics::LogisticFit;

// Must stay in the order of the columns x90 and x50 of fits.csv, and of those of the text.
constexpr std::array<double, 2> kCrossingRates{0.9, 0.5};
constexpr int kFitPoints = 61;

// Returns the levels of a cell but for one axis, which have to be equal for two cells to be
// compared along it.
std::string Others(const Sweep& sweep, const SweepCell& cell, std::size_t axis) {
  std::string text;
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    if (i == axis) continue;
    text +=
        fmt::format("{}{}={}", text.empty() ? "" : ",", sweep.axes[i].name, cell.levels[i].text);
  }
  return text;
}

// One curve of one kind of success.
class CurveFitter {
 public:
  CurveFitter(const SweepCurve& curve, std::span<const CellOutcomes> outcomes, SuccessKind kind)
      : curve_(curve), outcomes_(outcomes), kind_(kind) {
    for (std::size_t i = 0; i < curve.cells.size(); ++i) {
      const CellOutcomes& cell = Cell(i);
      shared_ = shared_ || cell.SharesLayouts();
      per_layout_ = std::lcm(per_layout_, cell.per_layout());
      DosePoint point{.x = curve.x[i]};
      for (std::size_t trial = 0; trial < cell.size(); ++trial) {
        if (cell.IsFault(trial)) continue;
        ++point.trials;
        if (cell.Succeeded(trial, kind)) ++point.count;
      }
      points_.push_back(point);
    }
  }

  LogisticFit Fit(FitScale scale, bool common_random_numbers) const {
    const LogisticFit fit = statistics::FitLogistic(points_, scale);
    if (fit.status != FitStatus::kFitted || !(common_random_numbers || shared_)) return fit;
    ClusterScores scores(fit);
    std::size_t first = 0;
    for (std::size_t i = 0; i < curve_.cells.size(); ++i) {
      const CellOutcomes& cell = Cell(i);
      for (std::size_t trial = 0; trial < cell.size(); ++trial) {
        if (cell.IsFault(trial)) continue;
        scores.Add(first + trial / per_layout_, curve_.x[i], cell.Succeeded(trial, kind_));
      }
      if (!common_random_numbers) first += cell.size() / per_layout_ + 1;
    }
    return scores.Fit(shared_);
  }

  std::span<const DosePoint> points() const { return points_; }

 private:
  const CellOutcomes& Cell(std::size_t i) const { return outcomes_[curve_.cells[i]]; }

  const SweepCurve& curve_;
  std::span<const CellOutcomes> outcomes_;
  SuccessKind kind_;
  std::vector<DosePoint> points_;
  bool shared_ = false;
  std::size_t per_layout_ = 1;
};

SweepCurve Curve(const Sweep& sweep, std::span<const CellOutcomes> outcomes, std::string label,
                 std::vector<std::size_t> members) {
  const std::size_t axis = *sweep.fit_axis;
  const auto number = [&](std::size_t cell) { return *sweep.cells[cell].levels[axis].number; };
  std::sort(members.begin(), members.end(),
            [&](std::size_t a, std::size_t b) { return number(a) < number(b); });
  SweepCurve curve{
      .label = std::move(label), .cells = std::move(members), .x = {}, .fits = {}, .crossings = {}};
  for (const std::size_t cell : curve.cells) curve.x.push_back(number(cell));
  const bool log = sweep.fit_scale == scenario::AxisScale::kLog && curve.x.front() > 0.0;
  for (std::size_t kind = 0; kind < kSuccessNames.size(); ++kind) {
    const CurveFitter fitter(curve, outcomes, static_cast<SuccessKind>(kind));
    const LogisticFit fit =
        fitter.Fit(log ? FitScale::kLog : FitScale::kLinear, sweep.common_random_numbers);
    curve.fits[kind] = fit;
    if (fit.status != FitStatus::kFitted) continue;
    for (const double rate : kCrossingRates) {
      curve.crossings[kind].push_back(statistics::FindCrossing(fit, fitter.points(), rate));
    }
  }
  return curve;
}

// A number between the lowest setting of a fit (share 0) and the highest (1), in equal steps of the
// fit's scale.
double Abscissa(const LogisticFit& fit, double share) {
  if (fit.scale == FitScale::kLinear) {
    return fit.lowest_x + share * (fit.highest_x - fit.lowest_x);
  }
  return fit.lowest_x * std::pow(fit.highest_x / fit.lowest_x, share);
}

// Cells that differ along one axis alone, in the order of the sweep, by the levels of the others.
std::vector<std::pair<std::string, std::vector<std::size_t>>> CellsAlong(const Sweep& sweep,
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

// One curve for each setting of the other axes; none where points fill several axes, which share no
// levels. Trials are clusters (statistics::ClusterScores) where cells share random numbers or
// trials share layouts: those of one index or, where they share layouts, of one layout (of the
// least common multiple, where cells differ in how many do); of all cells with common random
// numbers, else of each cell. Memory: 40 bytes per cluster of a curve.
std::vector<SweepCurve> FitCurves(const Sweep& sweep, std::span<const CellOutcomes> outcomes) {
  std::vector<SweepCurve> curves;
  const bool one_axis = sweep.axes.size() == 1;
  if (!sweep.fit_axis || !(sweep.design == scenario::DesignKind::kGrid || one_axis)) return curves;
  for (auto& [label, members] : CellsAlong(sweep, *sweep.fit_axis)) {
    curves.push_back(Curve(sweep, outcomes, label, std::move(members)));
  }
  return curves;
}

using core::kNaN;
using statistics::Interval;
using statistics::kConfidence;
using statistics::Proportion;
using truth::Record;

// Returns the interval of a rate: exact, or one that allows for the stopping rule, by which the
// number of trials depends on what they say, or for trials on one layout, which are no independent
// ones.
Interval IntervalOf(const SweepCellTrials& trials, const CellOutcomes& outcomes, SuccessKind kind,
                    const Proportion& rate, double confidence) {
  if (trials.stopping) {
    return statistics::ProportionInterval(rate.count, rate.trials, confidence,
                                          statistics::IntervalMethod::kStopped);
  }
  if (outcomes.SharesLayouts()) {
    return statistics::ClusteredRateInterval(outcomes.ByLayout(kind), confidence);
  }
  return statistics::ProportionInterval(rate.count, rate.trials, confidence,
                                        statistics::IntervalMethod::kClopperPearson);
}

SweepRate RateOf(const SweepCellTrials& trials, const CellOutcomes& outcomes, SuccessKind kind,
                 const Proportion& rate, std::size_t cells) {
  const double alone = 1.0 - (1.0 - kConfidence) / static_cast<double>(cells);
  SweepRate result{rate, IntervalOf(trials, outcomes, kind, rate, alone)};
  if (trials.stopping || outcomes.SharesLayouts()) {
    result.rate.interval = IntervalOf(trials, outcomes, kind, rate, kConfidence);
  }
  return result;
}

SweepCellSummary SummarizeCell(const SweepCellTrials& trials, const CellOutcomes& outcomes,
                               std::size_t cells, statistics::IntervalMethod method) {
  const statistics::DriveSummary drive =
      statistics::Summarize(trials.schema, trials.prefix, trials.planned, method);
  SweepCellSummary summary;
  summary.planned = trials.planned;
  summary.stored = trials.stored;
  summary.accounting = trials.accounting;
  summary.stopping = trials.stopping;
  summary.completed = drive.completed;
  summary.faults = drive.faults;
  summary.declared_success =
      RateOf(trials, outcomes, SuccessKind::kDeclared, drive.declared_success, cells);
  summary.true_success = RateOf(trials, outcomes, SuccessKind::kTrue, drive.true_success, cells);
  summary.ended_by_limit = drive.ended_by_limit;
  summary.success_without_limits = drive.SuccessWithoutLimits();
  summary.outcomes = drive.outcomes;
  summary.metrics = statistics::SummarizeMetrics(trials.schema, trials.prefix, method);
  summary.trial_hash = trials.trial_hash;
  return summary;
}

class Comparer {
 public:
  Comparer(const Sweep& sweep, std::span<const SweepCellSummary> cells,
           std::span<const CellOutcomes> outcomes)
      : sweep_(sweep), cells_(cells), outcomes_(outcomes) {}

  std::vector<SweepDifference> Compare() {
    if (sweep_.design == scenario::DesignKind::kGrid) {
      for (std::size_t axis = 0; axis < sweep_.axes.size(); ++axis) {
        if (!sweep_.axes[axis].numeric) CompareAlong(axis);
      }
    }
    // Tests that cannot be made are no members of the family.
    std::vector<double> p_values;
    for (const SweepDifference& each : differences_) {
      if (std::isfinite(each.success.p_value)) p_values.push_back(each.success.p_value);
    }
    const std::vector<double> adjusted = statistics::HolmAdjust(p_values);
    auto next = adjusted.begin();
    for (SweepDifference& each : differences_) {
      each.adjusted_p = std::isfinite(each.success.p_value) ? *next++ : kNaN;
    }
    return std::move(differences_);
  }

 private:
  void CompareAlong(std::size_t axis) {
    for (const auto& [at, members] : CellsAlong(sweep_, axis)) {
      for (std::size_t i = 1; i < members.size(); ++i) Add(axis, at, members.front(), members[i]);
    }
  }

  void Add(std::size_t axis, const std::string& at, std::size_t first, std::size_t second) {
    // Records of two cells at a time.
    const std::vector<Record> before = outcomes_[first].Records();
    const std::vector<Record> after = outcomes_[second].Records();
    const RunComparison comparison = CompareRuns(View(first, before), View(second, after));
    for (std::size_t kind = 0; kind < comparison.successes.size(); ++kind) {
      differences_.push_back({.axis = sweep_.axes[axis].name,
                              .first = sweep_.cells[first].levels[axis].text,
                              .second = sweep_.cells[second].levels[axis].text,
                              .at = at,
                              .paired = comparison.paired,
                              .success = comparison.successes[kind]});
    }
  }

  ComparedRun View(std::size_t cell, std::span<const Record> records) const {
    return {.name = sweep_.cells[cell].name,
            .seed = static_cast<std::uint64_t>(sweep_.cells[cell].scenario.seed),
            .schema = {},
            .records = records,
            .groups = outcomes_[cell].Groups()};
  }

  const Sweep& sweep_;
  std::span<const SweepCellSummary> cells_;
  std::span<const CellOutcomes> outcomes_;
  std::vector<SweepDifference> differences_;
};

// Names cells whose trials are equal to the last bit with common random numbers: they differ by a
// setting that does nothing.
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

// What the intervals allow for, and what does not.
void AddCautions(std::span<const SweepCellSummary> cells, std::span<const CellOutcomes> outcomes,
                 std::vector<std::string>& notes) {
  if (std::any_of(cells.begin(), cells.end(),
                  [](const SweepCellSummary& cell) { return cell.stopping.has_value(); })) {
    notes.emplace_back("a rule ended cells: intervals of their rates allow for it;");
    notes.emplace_back(
        "fits, differences, shares and means take the numbers of trials as if they were planned");
  }
  if (std::any_of(outcomes.begin(), outcomes.end(),
                  [](const CellOutcomes& cell) { return cell.SharesLayouts(); })) {
    notes.emplace_back(
        "trials share layouts of rocks: intervals of rates, means, fits and differences allow "
        "for");
    notes.emplace_back("it; medians have no intervals, and differences no p-values");
  }
}

}  // namespace

SweepCellSummary TotalTrials(const SweepSummary& summary) {
  SweepCellSummary total;
  for (const SweepCellSummary& cell : summary.cells) {
    total.planned += cell.planned;
    total.stored += cell.stored;
    total.completed += cell.completed;
    total.faults += cell.faults;
  }
  return total;
}

Accounting TotalAccounting(const SweepSummary& summary) {
  Accounting total;
  for (const SweepCellSummary& cell : summary.cells) total = Sum(total, cell.accounting);
  return total;
}

SweepSummary SummarizeSweep(const Sweep& sweep, const SweepCellLoader& load,
                            statistics::IntervalMethod method) {
  SweepSummary summary;
  std::vector<CellOutcomes> outcomes;
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    const SweepCellTrials trials = load(i);
    outcomes.emplace_back(trials.prefix, sweep.cells[i].scenario.drive.course.trials_per_layout);
    summary.cells.push_back(SummarizeCell(trials, outcomes.back(), sweep.cells.size(), method));
  }
  summary.curves = FitCurves(sweep, outcomes);
  summary.differences = Comparer(sweep, summary.cells, outcomes).Compare();
  summary.attributions = AttributeSweep(sweep, outcomes);
  summary.notes = EqualCells(sweep, summary.cells);
  AddCautions(summary.cells, outcomes, summary.notes);
  return summary;
}

bool Misfits(const LogisticFit& fit) { return fit.p_value < kMisfit; }

std::vector<FitPoint> FittedLine(const LogisticFit& fit) {
  std::vector<FitPoint> line;
  if (fit.status != FitStatus::kFitted) return line;
  for (int i = 0; i < kFitPoints; ++i) {
    const double x = Abscissa(fit, i / (kFitPoints - 1.0));
    line.push_back({.x = x, .rate = fit.Rate(x), .band = fit.Band(x)});
  }
  return line;
}

}  // namespace rockyard::report

// What the cells of a sweep say, in numbers, for its files, its table and the report page. None of
// them decides an exit code, and no record depends on one.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "report/attribution.h"
#include "report/paired_comparison.h"
#include "report/run_description.h"
#include "report/trial_outcomes.h"
#include "scenario/sweep.h"
#include "statistics/logistic_fit.h"
#include "statistics/metrics.h"
#include "statistics/proportions.h"
#include "truth/record.h"

namespace rockyard::report {

// The finished trials of one cell, as the store has them.
struct SweepCellTrials {
  truth::RecordSchema schema;
  std::vector<truth::Record> prefix;  // contiguous
  std::int64_t planned = 0;
  std::int64_t stored = 0;  // beyond the prefix too
  std::string trial_hash;   // of the prefix
  Accounting accounting = {};
  std::optional<StoppingReport> stopping = {};  // where the rule ended the cell, if there is one
};

// Loads a cell by its index in the sweep. It is called once per cell, in order, so that the records
// of one cell are in memory at a time; of the other cells one byte per trial is kept.
using SweepCellLoader = std::function<SweepCellTrials(std::size_t)>;

// A rate with its own 95 % interval, and one that holds for all cells of the sweep at once with 95
// % (Bonferroni, by Clopper and Pearson, as for the cells of a measurement). Both intervals allow
// for the stopping rule where one ended the cell (statistics::IntervalMethod::kStopped), and are by
// layouts (statistics/clustered_rate.h) where trials share them.
struct SweepRate {
  statistics::Proportion rate;
  statistics::Interval simultaneous{0.0, 1.0};
};

struct SweepCellSummary {
  std::int64_t planned = 0;
  std::int64_t stored = 0;
  std::int64_t completed = 0;  // of the prefix, faults included
  std::int64_t faults = 0;     // simulator faults: in no rate and in no metric
  SweepRate declared_success;
  SweepRate true_success;
  statistics::Proportion ended_by_limit;  // neither arrived nor failed
  statistics::Interval success_without_limits;
  std::array<std::int64_t, truth::kTrialOutcomeNames.size()> outcomes{};
  std::vector<statistics::MetricSummary> metrics;
  std::string trial_hash;
  Accounting accounting = {};
  std::optional<StoppingReport> stopping = {};
};

// Success against the numbers of the fit axis, at fixed levels of all others.
struct SweepCurve {
  std::string label;               // "navigator=gestalt"; empty where there is one curve
  std::vector<std::size_t> cells;  // ascending along the axis
  std::vector<double> x;
  std::array<statistics::LogisticFit, 2> fits;  // by SuccessKind
  // The numbers at which 90 % and 50 % succeed; empty where there is no fit.
  std::array<std::vector<statistics::FitCrossing>, 2> crossings;
};

// Two levels of an axis of names, everything else equal: the first level against another.
struct SweepDifference {
  std::string axis;
  std::string first;   // level
  std::string second;  // level
  std::string at;      // levels of the other axes
  bool paired = false;
  SuccessComparison success;
  double adjusted_p = 1.0;  // Holm, over every difference of the sweep
};

struct SweepSummary {
  std::vector<SweepCellSummary> cells;  // as those of the sweep
  std::vector<SweepCurve> curves;       // of grids with a numeric axis
  std::vector<SweepDifference> differences;
  std::vector<SweepAttribution> attributions;  // of sweeps along ablations
  std::vector<std::string> notes;  // cells whose trials are equal: a setting without effect
};

// Counts of trials of all cells together.
SweepCellSummary TotalTrials(const SweepSummary& summary);

// The accounting of all cells together.
Accounting TotalAccounting(const SweepSummary& summary);

// Summarizes a sweep. Rates cover the contiguous prefix of each cell, without simulator faults.
//
// Curves: FitCurves (sweep_summary.cc). Differences: report::CompareRuns, in pairs where cells
// share their seed; where trials share layouts, with intervals that allow for it and no p-value.
// Cost: linear in the trials, and at most some milliseconds per curve. Memory: the records of one
// cell, and one byte for each trial of the sweep.
SweepSummary SummarizeSweep(const scenario::Sweep& sweep, const SweepCellLoader& load,
                            statistics::IntervalMethod method);

// Goodness of fit below which a curve is said not to follow its settings.
inline constexpr double kMisfit = 0.01;

// Whether a curve is said not to follow its settings: whether statistics::LogisticFit::p_value,
// with its limits, is below kMisfit. False where it is not known.
bool Misfits(const statistics::LogisticFit& fit);

// A point of a fitted curve.
struct FitPoint {
  double x = 0.0;
  double rate = 0.0;
  statistics::Interval band;  // pointwise, 95 %
};

// Returns 61 points (kFitPoints) from the lowest setting to the highest, in equal steps of the
// fit's scale; none where nothing is fitted.
std::vector<FitPoint> FittedLine(const statistics::LogisticFit& fit);

}  // namespace rockyard::report

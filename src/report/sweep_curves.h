// Success along the numeric axis of a sweep.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "report/sweep_outcomes.h"
#include "report/sweep_summary.h"
#include "scenario/sweep.h"

namespace rockyard::report {

// Cells that differ along one axis alone, in the order of the sweep, by the levels of the others.
std::vector<std::pair<std::string, std::vector<std::size_t>>> CellsAlong(
    const scenario::Sweep& sweep, std::size_t axis);

// One curve for each setting of the other axes; none where points fill several axes, which share no
// levels. Trials are clusters (statistics::ClusterScores) where cells share random numbers or
// trials share layouts: those of one index or, where they share layouts, of one layout (of the
// least common multiple, where cells differ in how many do); of all cells with common random
// numbers, else of each cell. Memory: 40 bytes per cluster of a curve.
std::vector<SweepCurve> FitCurves(const scenario::Sweep& sweep,
                                  std::span<const CellOutcomes> outcomes);

// Goodness of fit below which a curve is said not to follow its settings.
inline constexpr double kMisfit = 0.01;

// Whether it is: by statistics::LogisticFit::p_value, with its limits. False where that is not
// known.
bool Misfits(const statistics::LogisticFit& fit);

// A point of a fitted curve.
struct FitPoint {
  double x = 0.0;
  double rate = 0.0;
  statistics::Interval band;  // pointwise, 95 %
};

// 61 of them from the lowest setting to the highest, in equal steps of the fit's scale; none where
// nothing is fitted.
std::vector<FitPoint> FittedLine(const statistics::LogisticFit& fit);

}  // namespace rockyard::report

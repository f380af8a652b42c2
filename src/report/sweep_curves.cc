#include "report/sweep_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace rockyard::report {
namespace {

using scenario::Sweep;
using scenario::SweepCell;
using statistics::ClusterScores;
using statistics::DosePoint;
using statistics::FitScale;
using statistics::FitStatus;
using statistics::LogisticFit;

constexpr std::array<double, 2> kCrossingRates{0.9, 0.5};
constexpr int kFitPoints = 61;

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

}  // namespace

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

std::vector<SweepCurve> FitCurves(const Sweep& sweep, std::span<const CellOutcomes> outcomes) {
  std::vector<SweepCurve> curves;
  const bool one_axis = sweep.axes.size() == 1;
  if (!sweep.fit_axis || !(sweep.design == scenario::DesignKind::kGrid || one_axis)) return curves;
  for (auto& [label, members] : CellsAlong(sweep, *sweep.fit_axis)) {
    curves.push_back(Curve(sweep, outcomes, label, std::move(members)));
  }
  return curves;
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

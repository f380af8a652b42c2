#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "report/accounting.h"
#include "report/line_text.h"
#include "report/sweep_curves.h"
#include "report/sweep_files.h"

namespace rockyard::report {
namespace {

using scenario::Sweep;
using statistics::FitStatus;

constexpr std::size_t kLabelWidth = 24;
// Longer tables are for files.
constexpr std::size_t kMaxCells = 60;
constexpr std::size_t kMaxDifferences = 40;
// What has more digits does not fit its column.
constexpr double kHugeCell = 1e5;
constexpr double kMinP = 1e-9;

std::string RateColumn(const statistics::Proportion& rate) {
  if (rate.trials == 0) return fmt::format("{:>22}", "-");
  return fmt::format("{:5.1f} ({:5.1f} ..{:6.1f})", 100.0 * rate.rate, 100.0 * rate.interval.low,
                     100.0 * rate.interval.high);
}

std::string Mean(const SweepCellSummary& cell, std::string_view metric) {
  const auto found = std::find_if(
      cell.metrics.begin(), cell.metrics.end(),
      [&](const statistics::MetricSummary& each) { return each.metric->name == metric; });
  if (found == cell.metrics.end() || !std::isfinite(found->mean)) return "-";
  if (std::fabs(found->mean) >= kHugeCell) return fmt::format("{:.0e}", found->mean);
  return fmt::format("{:.{}f}", found->mean, std::fabs(found->mean) < 100.0 ? 2 : 0);
}

// In five columns; cells.csv has every digit.
std::string Count(std::int64_t trials) {
  if (trials < 100'000) return fmt::format("{}", trials);
  return trials < 10'000'000 ? fmt::format("{}k", trials / 1000)
                             : fmt::format("{}M", trials / 1'000'000);
}

// In the order of scenario::DesignKind.
constexpr std::array<std::string_view, 4> kDesignNames{"grid", "list", "Latin hypercube",
                                                       "Sobol points"};

std::string Head(const Sweep& sweep, const SweepSummary& summary) {
  const SweepCellSummary total = TotalTrials(summary);
  std::string text = Wrapped(fmt::format(
      "{}: {}, {} cells, seed {}{}\n  {} of {} trials\n", Cut(Printable(sweep.name), 40),
      kDesignNames[static_cast<std::size_t>(sweep.design)], sweep.cells.size(), sweep.seed,
      sweep.common_random_numbers ? ", common random numbers" : "", total.completed,
      total.planned));
  text += AccountingText(TotalAccounting(summary));
  if (total.faults > 0) {
    text += fmt::format("  {} simulator faults, in none of the rates below\n", total.faults);
  }
  return text;
}

// Levels say more than numbers of cells, as long as they are few.
std::string Label(const Sweep& sweep, std::size_t cell) {
  if (sweep.axes.size() > 2) return fmt::format("cell {}", cell);
  std::string label;
  for (const scenario::SweepLevel& level : sweep.cells[cell].levels) {
    label += fmt::format("{}{}", label.empty() ? "" : ", ", level.text);
  }
  return label;
}

std::string AxisNames(const Sweep& sweep) {
  if (sweep.axes.size() > 2) return "see cells.csv";
  std::string names;
  for (const scenario::SweepAxis& axis : sweep.axes) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", axis.name);
  }
  return names;
}

// Below the table: how much of the rates hangs on how long drives were allowed to go on.
std::string LimitLine(const Sweep& sweep, const SweepSummary& summary) {
  std::size_t most = 0;
  std::size_t cells = 0;
  for (std::size_t i = 0; i < summary.cells.size(); ++i) {
    const statistics::Proportion& ended = summary.cells[i].ended_by_limit;
    if (ended.count == 0) continue;
    if (cells++ == 0 || ended.rate > summary.cells[most].ended_by_limit.rate) most = i;
  }
  if (cells == 0) return "";
  return Wrapped(fmt::format(
      "  (in {} of {} cells drives were ended by a limit, patience or time, and had neither "
      "arrived "
      "nor failed: up to {:.1f} %, in {}; without limits declared success may be higher by as "
      "much)\n",
      cells, summary.cells.size(), 100.0 * summary.cells[most].ended_by_limit.rate,
      Cut(Label(sweep, most), kLabelWidth)));
}

std::string CellTable(const Sweep& sweep, const SweepSummary& summary, TextStyle style) {
  std::string head = fmt::format(
      "  {:<{}} {:>5} {:>22} {:>22} {:>6} {:>7} {:>6}", Cut(AxisNames(sweep), kLabelWidth),
      kLabelWidth, "n", "declared success [%]", "true success [%]", "path", "time", "energy");
  std::string text =
      (style == TextStyle::kColour ? fmt::format("\x1b[1m{}\x1b[0m", head) : head) + "\n";
  for (std::size_t i = 0; i < std::min(summary.cells.size(), kMaxCells); ++i) {
    const SweepCellSummary& cell = summary.cells[i];
    text += fmt::format("  {:<{}} {:>5} {} {} {:>6} {:>7} {:>6}\n",
                        Cut(Label(sweep, i), kLabelWidth), kLabelWidth,
                        Count(cell.completed - cell.faults), RateColumn(cell.declared_success.rate),
                        RateColumn(cell.true_success.rate), Mean(cell, "path_ratio"),
                        Mean(cell, "time_to_goal_s"), Mean(cell, "energy_to_goal_wh"));
  }
  if (summary.cells.size() > kMaxCells) {
    text += fmt::format("  and {} more cells: cells.csv\n", summary.cells.size() - kMaxCells);
  }
  return text +
         "  (intervals of 95 % for a cell alone; path ratio, time [s] and energy [Wh]: means of "
         "arrivals)\n" +
         LimitLine(sweep, summary);
}

// Where the rule ended each cell.
std::string Stops(const Sweep& sweep, const SweepSummary& summary) {
  if (summary.cells.empty() || !summary.cells.front().stopping) return "";
  const StoppingReport& rule = *summary.cells.front().stopping;
  std::string text = fmt::format(
      "  stopping rule: half-width {:.2f} % of declared success ({:g} %), looked at every {} "
      "trials,\n"
      "  at most {} of a cell; allocation {}\n",
      100.0 * rule.half_width, 100.0 * rule.confidence, rule.block, rule.max_trials,
      rule.allocation);
  for (std::size_t i = 0; i < std::min(summary.cells.size(), kMaxCells); ++i) {
    text += fmt::format("    {:<{}} {}\n", Cut(Label(sweep, i), kLabelWidth), kLabelWidth,
                        StoppingPhrase(*summary.cells[i].stopping));
  }
  return Wrapped(text);
}

// A number outside of the settings is not known any better than that.
std::string Place(double x, const statistics::LogisticFit& fit) {
  if (std::isnan(x)) return "none";
  if (x < fit.lowest_x) return fmt::format("< {:.3g}", fit.lowest_x);
  if (x > fit.highest_x) return fmt::format("> {:.3g}", fit.highest_x);
  return fmt::format("{:.3g}", x);
}

std::string FitLine(const SweepCurve& curve, std::size_t kind) {
  const statistics::LogisticFit& fit = curve.fits[kind];
  const std::string_view name = kSuccessNames[kind];
  std::string text = fmt::format("    {:<9} ", name.substr(0, name.find(' ')));
  // In the order of FitStatus.
  constexpr std::array<std::string_view, 4> kLacks{
      "", "fewer than two cells with trials", "nothing but successes, or nothing but failures",
      "successes and failures do not overlap; put cells between them"};
  if (fit.status != FitStatus::kFitted) {
    return text + fmt::format("no fit: {}\n", kLacks[static_cast<std::size_t>(fit.status)]);
  }
  for (const statistics::FitCrossing& crossing : curve.crossings[kind]) {
    text += fmt::format("{:<35} ", fmt::format("{} ({} .. {})", Place(crossing.x, fit),
                                               Place(crossing.interval.low, fit),
                                               Place(crossing.interval.high, fit)));
  }
  text += std::isfinite(fit.p_value)
              ? fmt::format("{:.2g}{}", fit.p_value, Misfits(fit) ? " *" : "")
              : std::string("-");
  return text + "\n";
}

std::string Fits(const Sweep& sweep, const SweepSummary& summary) {
  if (summary.curves.empty()) return "";
  const bool log = summary.curves.front().fits[0].scale == statistics::FitScale::kLog;
  std::string text = fmt::format("\n  logistic fit of success against {}{}, 95 % intervals{}\n",
                                 log ? "ln " : "", sweep.axes[*sweep.fit_axis].name,
                                 sweep.common_random_numbers ? ", with common random numbers" : "");
  text += fmt::format("    {:<9} {:<35} {:<35} fit p\n", "success", "90 % at", "50 % at");
  for (const SweepCurve& curve : summary.curves) {
    if (!curve.label.empty()) text += "  " + Cut(curve.label, 96) + "\n";
    for (std::size_t kind = 0; kind < kSuccessNames.size(); ++kind) text += FitLine(curve, kind);
  }
  const bool misfit =
      std::any_of(summary.curves.begin(), summary.curves.end(), [](const SweepCurve& curve) {
        return std::any_of(curve.fits.begin(), curve.fits.end(), Misfits);
      });
  if (misfit) {
    text += fmt::format(
        "    * the rates lie beside the curve (p < {}): trust them rather than its crossings\n",
        kMisfit);
  }
  return text;
}

std::string PText(double p) {
  if (!std::isfinite(p)) return "";
  return p < kMinP ? fmt::format("p < {:g}", kMinP) : fmt::format("p = {:.2g}", p);
}

std::string Differences(const SweepSummary& summary) {
  if (summary.differences.empty()) return "";
  std::string text =
      fmt::format("\n  differences of success, {}, in points; p by Holm over all {}\n",
                  summary.differences.front().paired ? "trial by trial" : "as two samples",
                  summary.differences.size());
  for (std::size_t i = 0; i < std::min(summary.differences.size(), kMaxDifferences); ++i) {
    const SweepDifference& each = summary.differences[i];
    const SuccessComparison& success = each.success;
    text += fmt::format("  {:<31} {:<18} {:<8} {:+6.1f} ({:+6.1f} ..{:+7.1f})  {}\n",
                        Cut(fmt::format("{} - {}", each.second, each.first), 31), Cut(each.at, 18),
                        success.what.substr(0, success.what.find(' ')), 100.0 * success.difference,
                        100.0 * success.interval.low, 100.0 * success.interval.high,
                        PText(each.adjusted_p));
  }
  if (summary.differences.size() > kMaxDifferences) {
    text += fmt::format("  and {} more: differences.csv\n",
                        summary.differences.size() - kMaxDifferences);
  }
  return text;
}

}  // namespace

std::string SweepText(const Sweep& sweep, const SweepSummary& summary,
                      const SweepDescription& description, TextStyle style) {
  std::string text = Head(sweep, summary) + CellTable(sweep, summary, style) +
                     Stops(sweep, summary) + Fits(sweep, summary) + Differences(summary) +
                     AttributionText(summary.attributions);
  for (const std::string& note : summary.notes) text += Wrapped("  " + Printable(note)) + "\n";
  return text + fmt::format("  trial hash {}\n", description.trial_hash);
}

}  // namespace rockyard::report

// The table of a sweep on the terminal, and its drawing (sweep_files.h).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "report/line_text.h"
#include "report/run_description.h"
#include "report/sweep_files.h"
#include "report/sweep_summary.h"
#include "report/xml_text.h"

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

std::string CellNumber(double value) {
  if (!std::isfinite(value)) return "-";
  if (std::fabs(value) >= kHugeCell) return fmt::format("{:.0e}", value);
  return fmt::format("{:.{}f}", value, std::fabs(value) < 100.0 ? 2 : 0);
}

// Returns a metric of a cell; null where the cell has none of that name.
const statistics::MetricSummary* FindSummary(const SweepCellSummary& cell,
                                             std::string_view metric) {
  const auto found = std::find_if(
      cell.metrics.begin(), cell.metrics.end(),
      [&](const statistics::MetricSummary& each) { return each.metric.name == metric; });
  return found == cell.metrics.end() ? nullptr : &*found;
}

std::string Mean(const SweepCellSummary& cell, std::string_view metric) {
  const statistics::MetricSummary* found = FindSummary(cell, metric);
  return found == nullptr ? "-" : CellNumber(found->mean);
}

// Returns a number in five columns; cells.csv has every digit.
std::string Count(std::int64_t trials) {
  if (trials < 100'000) return fmt::format("{}", trials);
  return trials < 10'000'000 ? fmt::format("{}k", trials / 1000)
                             : fmt::format("{}M", trials / 1'000'000);
}

// Must stay in the order of scenario::DesignKind.
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

// Returns the line below the table: how much of the rates hangs on how long drives were allowed to
// go on.
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

// Returns the names of what navigators count for themselves of which some cell has a value.
std::vector<std::string> OwnNames(const SweepSummary& summary) {
  std::vector<std::string> names;
  for (const SweepCellSummary& cell : summary.cells) {
    for (const statistics::MetricSummary& each : cell.metrics) {
      const std::string& name = each.metric.name;
      if (!truth::IsOwnColumn(name) || each.count == 0) continue;
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

constexpr std::size_t kOwnWidth = 23;

// Returns the mean, with its interval where there is one that has room.
std::string OwnMean(const SweepCellSummary& cell, std::string_view name) {
  const statistics::MetricSummary* found = FindSummary(cell, name);
  if (found == nullptr) return "-";
  std::string mean = CellNumber(found->mean);
  if (!std::isfinite(found->interval.low)) return mean;
  std::string both = fmt::format("{} ({} .. {})", mean, CellNumber(found->interval.low),
                                 CellNumber(found->interval.high));
  return both.size() <= kOwnWidth ? both : mean;
}

// The means of what navigators count for themselves, three columns of them; "-" in the cells that
// another navigator drove.
std::string OwnTable(const Sweep& sweep, const SweepSummary& summary) {
  constexpr std::size_t kMostOwn = 3;
  const std::vector<std::string> names = OwnNames(summary);
  if (names.empty()) return "";
  const auto shown = std::span(names).first(std::min(names.size(), kMostOwn));
  std::string text = fmt::format("\n  {:<{}}", "counted by navigators", kLabelWidth);
  for (const std::string& name : shown) {
    text += fmt::format(" {:>{}}", Cut(Printable(name), kOwnWidth), kOwnWidth);
  }
  text += "\n";
  for (std::size_t i = 0; i < std::min(summary.cells.size(), kMaxCells); ++i) {
    text += fmt::format("  {:<{}}", Cut(Label(sweep, i), kLabelWidth), kLabelWidth);
    for (const std::string& name : shown) {
      text += fmt::format(" {:>{}}", OwnMean(summary.cells[i], name), kOwnWidth);
    }
    text += "\n";
  }
  text += "  (means of all trials, with intervals of 95 % for a cell alone";
  if (names.size() > shown.size()) {
    text += fmt::format("; {} more: curves.csv", names.size() - shown.size());
  }
  return text + ")\n";
}

// Tells where the rule ended each cell.
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
std::string CrossingText(double x, const statistics::LogisticFit& fit) {
  if (std::isnan(x)) return "none";
  if (x < fit.lowest_x) return fmt::format("< {:.3g}", fit.lowest_x);
  if (x > fit.highest_x) return fmt::format("> {:.3g}", fit.highest_x);
  return fmt::format("{:.3g}", x);
}

std::string FitLine(const SweepCurve& curve, std::size_t kind) {
  const statistics::LogisticFit& fit = curve.fits[kind];
  const std::string_view name = kSuccessNames[kind];
  std::string text = fmt::format("    {:<9} ", name.substr(0, name.find(' ')));
  // Must stay in the order of FitStatus.
  constexpr std::array<std::string_view, 4> kLacks{
      "", "fewer than two cells with trials", "nothing but successes, or nothing but failures",
      "successes and failures do not overlap; put cells between them"};
  if (fit.status != FitStatus::kFitted) {
    return text + fmt::format("no fit: {}\n", kLacks[static_cast<std::size_t>(fit.status)]);
  }
  for (const statistics::FitCrossing& crossing : curve.crossings[kind]) {
    text += fmt::format("{:<35} ", fmt::format("{} ({} .. {})", CrossingText(crossing.x, fit),
                                               CrossingText(crossing.interval.low, fit),
                                               CrossingText(crossing.interval.high, fit)));
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
  std::string text = fmt::format(
      "\n  differences of success, {}, in points; intervals of each, p by Holm over all {}\n",
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
                     OwnTable(sweep, summary) + Stops(sweep, summary) + Fits(sweep, summary) +
                     Differences(summary) + AttributionText(summary.attributions);
  for (const std::string& note : summary.notes) text += Wrapped("  " + Printable(note)) + "\n";
  return text + fmt::format("  trial hash {}\n", description.trial_hash);
}

namespace {

// Pixels.
constexpr double kCurveWidth = 430.0;
constexpr double kCurveHeight = 300.0;
constexpr double kCurveLeft = 56.0;
constexpr double kCurveTop = 62.0;
constexpr double kCurveGap = 56.0;
constexpr double kLegendLine = 18.0;
constexpr double kBottom = 56.0;
constexpr double kMark = 4.0;

std::string Text(double x, double y, std::string_view text, std::string_view style = "") {
  return SvgStyledText(x, y, text, style);
}

std::string Stroke(std::string_view colour) { return fmt::format("stroke=\"{}\"", colour); }

// Shapes tell curves apart where colours do not.
std::string Mark(std::size_t curve, double x, double y) {
  const std::string_view colour = CurveColour(curve);
  switch (curve % 3) {
    case 0:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"/>\n", x, y,
                         kMark, colour);
    case 1:
      return SvgBox(x - kMark, y - kMark, 2 * kMark, 2 * kMark, fmt::format("fill=\"{}\"", colour));
    default:
      return fmt::format("<path d=\"M {:.1f} {:.1f} l {:.1f} {:.1f} h {:.1f} Z\" fill=\"{}\"/>\n",
                         x, y - 1.3 * kMark, 1.2 * kMark, 2.2 * kMark, -2.4 * kMark, colour);
  }
}

// One kind of success.
class Panel {
 public:
  Panel(const Sweep& sweep, const SweepSummary& summary, std::size_t kind)
      : sweep_(sweep),
        summary_(summary),
        kind_(kind),
        left_(kCurveLeft + static_cast<double>(kind) * (kCurveWidth + kCurveGap)) {
    for (const SweepCurve& curve : summary.curves) {
      low_ = std::min(low_, curve.x.front());
      high_ = std::max(high_, curve.x.back());
    }
    log_ = low_ > 0.0 && summary.curves.front().fits[0].scale == statistics::FitScale::kLog;
  }

  std::string Draw() const {
    std::string svg = Axes();
    for (std::size_t i = 0; i < summary_.curves.size(); ++i) svg += Curve(i);
    return svg;
  }

 private:
  // Points at the ends keep away from the frame.
  double X(double x) const {
    const double share =
        log_ ? std::log(x / low_) / std::log(high_ / low_) : (x - low_) / (high_ - low_);
    return left_ + kCurveWidth * (0.04 + 0.92 * share);
  }
  static double Y(double rate) { return kCurveTop + kCurveHeight * (0.97 - 0.94 * rate); }

  std::string Axes() const {
    std::string svg =
        SvgBox(left_, kCurveTop, kCurveWidth, kCurveHeight, "fill=\"none\" stroke=\"#999\"");
    svg += Text(left_, kCurveTop - 8.0, kSuccessNames[kind_], "font-weight=\"bold\"");
    for (const double rate : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      svg += SvgLine({left_, Y(rate)}, {left_ + kCurveWidth, Y(rate)}, Stroke("#e4e4e4"));
      svg += Text(left_ - 5.0, Y(rate) + 4.0, fmt::format("{:.0f} %", 100.0 * rate),
                  "text-anchor=\"end\"");
    }
    double last = -std::numeric_limits<double>::infinity();
    for (const double x : Ticks()) {
      if (X(x) - last < 44.0) continue;
      last = X(x);
      svg += SvgLine({X(x), kCurveTop + kCurveHeight}, {X(x), kCurveTop + kCurveHeight + 4.0},
                     Stroke("#999"));
      svg += Text(X(x), kCurveTop + kCurveHeight + 16.0, fmt::format("{:.4g}", x),
                  "text-anchor=\"middle\"");
    }
    const scenario::SweepAxis& axis = sweep_.axes[*sweep_.fit_axis];
    const std::string unit = axis.unit == "1" ? "" : fmt::format(" [{}]", axis.unit);
    return svg + Text(left_ + 0.5 * kCurveWidth, kCurveTop + kCurveHeight + 34.0,
                      axis.name + unit + (log_ ? ", logarithmic" : ""), "text-anchor=\"middle\"");
  }

  std::vector<double> Ticks() const {
    std::vector<double> ticks;
    for (const SweepCurve& curve : summary_.curves) {
      ticks.insert(ticks.end(), curve.x.begin(), curve.x.end());
    }
    std::sort(ticks.begin(), ticks.end());
    ticks.erase(std::unique(ticks.begin(), ticks.end()), ticks.end());
    return ticks;
  }

  std::string Fit(std::size_t number) const {
    std::vector<SvgBandPoint> points;
    for (const auto& [x, rate, band] : FittedLine(summary_.curves[number].fits[kind_])) {
      points.push_back({X(x), Y(rate), Y(band.low), Y(band.high)});
    }
    const std::string stroke = Stroke(CurveColour(number)) + " stroke-width=\"1.5\"";
    return points.empty() ? "" : SvgBand(points, CurveColour(number), 0.18, stroke);
  }

  std::string Curve(std::size_t number) const {
    const SweepCurve& curve = summary_.curves[number];
    std::string svg = Fit(number);
    // Bars of several curves at one number stand beside each other.
    const double shift = 6.0 * (static_cast<double>(number) -
                                0.5 * (static_cast<double>(summary_.curves.size()) - 1.0));
    for (std::size_t i = 0; i < curve.cells.size(); ++i) {
      const SweepCellSummary& cell = summary_.cells[curve.cells[i]];
      const statistics::Proportion& rate =
          kind_ == 0 ? cell.declared_success.rate : cell.true_success.rate;
      if (rate.trials == 0) continue;
      const double x = X(curve.x[i]) + std::clamp(shift, -14.0, 14.0);
      svg += SvgLine({x, Y(rate.interval.low)}, {x, Y(rate.interval.high)},
                     Stroke(CurveColour(number)));
      svg += Mark(number, x, Y(rate.rate));
    }
    return svg;
  }

  const Sweep& sweep_;
  const SweepSummary& summary_;
  std::size_t kind_;
  double left_;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
  bool log_ = false;
};

}  // namespace

std::string SweepSvg(const Sweep& sweep, const SweepSummary& summary) {
  const bool drawn =
      std::any_of(summary.curves.begin(), summary.curves.end(),
                  [](const SweepCurve& curve) { return curve.x.front() < curve.x.back(); });
  if (!drawn) return "";
  const double legend_top = kCurveTop + kCurveHeight + kBottom;
  const double width = kCurveLeft + 2 * kCurveWidth + kCurveGap + 20.0;
  const double height = legend_top + kLegendLine * static_cast<double>(summary.curves.size()) + 8.0;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height);
  svg += Text(
      12.0, 24.0,
      fmt::format("{}: success with 95 % intervals, logistic fit with its 95 % band", sweep.name),
      "font-size=\"15\"");
  for (std::size_t kind = 0; kind < kSuccessNames.size(); ++kind) {
    svg += Panel(sweep, summary, kind).Draw();
  }
  for (std::size_t i = 0; i < summary.curves.size(); ++i) {
    if (summary.curves[i].label.empty()) continue;
    const double y = legend_top + kLegendLine * static_cast<double>(i);
    svg += Mark(i, kCurveLeft, y - 4.0) + Text(kCurveLeft + 12.0, y, summary.curves[i].label);
  }
  return svg + "</svg>\n";
}

}  // namespace rockyard::report

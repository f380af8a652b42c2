#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "report/colour_ramp.h"
#include "report/sweep_curves.h"
#include "report/sweep_files.h"
#include "report/xml_text.h"

namespace rockyard::report {
namespace {

using scenario::Sweep;

// Pixels.
constexpr double kPanelWidth = 430.0;
constexpr double kPanelHeight = 300.0;
constexpr double kLeft = 56.0;
constexpr double kTop = 62.0;
constexpr double kGap = 56.0;
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
        left_(kLeft + static_cast<double>(kind) * (kPanelWidth + kGap)) {
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
    return left_ + kPanelWidth * (0.04 + 0.92 * share);
  }
  static double Y(double rate) { return kTop + kPanelHeight * (0.97 - 0.94 * rate); }

  std::string Axes() const {
    std::string svg =
        SvgBox(left_, kTop, kPanelWidth, kPanelHeight, "fill=\"none\" stroke=\"#999\"");
    svg += Text(left_, kTop - 8.0, kSuccessNames[kind_], "font-weight=\"bold\"");
    for (const double rate : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      svg += SvgLine({left_, Y(rate)}, {left_ + kPanelWidth, Y(rate)}, Stroke("#e4e4e4"));
      svg += Text(left_ - 5.0, Y(rate) + 4.0, fmt::format("{:.0f} %", 100.0 * rate),
                  "text-anchor=\"end\"");
    }
    double last = -std::numeric_limits<double>::infinity();
    for (const double x : Ticks()) {
      if (X(x) - last < 44.0) continue;
      last = X(x);
      svg +=
          SvgLine({X(x), kTop + kPanelHeight}, {X(x), kTop + kPanelHeight + 4.0}, Stroke("#999"));
      svg += Text(X(x), kTop + kPanelHeight + 16.0, fmt::format("{:.4g}", x),
                  "text-anchor=\"middle\"");
    }
    const scenario::SweepAxis& axis = sweep_.axes[*sweep_.fit_axis];
    const std::string unit = axis.unit == "1" ? "" : fmt::format(" [{}]", axis.unit);
    return svg + Text(left_ + 0.5 * kPanelWidth, kTop + kPanelHeight + 34.0,
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
  const double legend_top = kTop + kPanelHeight + kBottom;
  const double width = kLeft + 2 * kPanelWidth + kGap + 20.0;
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
    svg += Mark(i, kLeft, y - 4.0) + Text(kLeft + 12.0, y, summary.curves[i].label);
  }
  return svg + "</svg>\n";
}

}  // namespace rockyard::report

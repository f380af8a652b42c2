#include "report/chart_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text.h"

namespace rockyard::report {
namespace {

// Pixels.
constexpr int kColumns = 3;
constexpr double kSheetMargin = 24.0;
constexpr double kPlotWidth = 270.0;
constexpr double kPlotHeight = 190.0;
constexpr double kAxisRoom = 62.0;     // to the left of a plot
constexpr double kTitleRoom = 34.0;    // above it
constexpr double kFootRoom = 52.0;     // below it
constexpr double kBarTextRoom = 70.0;  // to the right of bars, beyond the room for labels
constexpr double kLetter = 6.2;        // about the width of one in a label
constexpr double kLineHeight = 13.0;

constexpr std::string_view kInk = "#222";
constexpr std::string_view kGrid = "stroke=\"#e4e4e4\" stroke-width=\"1\"";
constexpr std::string_view kFrame = "fill=\"none\" stroke=\"#888\" stroke-width=\"1\"";

// Round numbers from below the least to above the largest value.
struct ChartScale {
  double low = 0.0;
  double high = 1.0;
  double step = 0.5;

  double Share(double value) const { return (value - low) / (high - low); }
};

ChartScale ScaleOver(double least, double most, int intervals) {
  if (!(most > least)) {
    const double around = std::isfinite(least) ? least : 0.0;
    least = around - 0.5;
    most = around + 0.5;
  }
  const double rough = (most - least) / intervals;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1.0 - 1e-9)) {
      step = factor * power;
      break;
    }
  }
  return {step * std::floor(least / step + 1e-9), step * std::ceil(most / step - 1e-9), step};
}

// The least and the largest of the finite values that it is told.
struct ChartRange {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void Take(double value) {
    if (!std::isfinite(value)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

std::string Styled(double x, double y, std::string_view text, double size, std::string_view style) {
  return SvgStyledText(x, y, text, fmt::format("font-size=\"{:g}\" {}", size, style));
}

// Places for texts of one line each, in ascending order, apart from each other and within a range.
std::vector<double> Apart(std::vector<double> wanted, double least, double most) {
  for (std::size_t i = 1; i < wanted.size(); ++i) {
    wanted[i] = std::max(wanted[i], wanted[i - 1] + kLineHeight);
  }
  double bound = most;
  for (std::size_t i = wanted.size(); i-- > 0;) {
    wanted[i] = std::min(wanted[i], bound);
    bound = wanted[i] - kLineHeight;
  }
  bound = least;
  for (double& place : wanted) {
    place = std::max(place, bound);
    bound = place + kLineHeight;
  }
  return wanted;
}

class Plot {
 public:
  Plot(const Chart& chart, double left, double top) : chart_(chart), left_(left), top_(top) {
    ChartRange x;
    ChartRange y;
    for (const ChartCurve& curve : chart.curves) {
      for (const ChartPoint& point : curve.points) {
        x.Take(point.x);
        for (const double value : {point.y, point.low, point.high}) y.Take(value);
      }
    }
    for (const ChartMark& mark : chart.marks) {
      x.Take(mark.x);
      y.Take(mark.y);
    }
    for (const ChartRule& rule : chart.rules) y.Take(rule.y);
    x_ = ScaleOver(x.least, x.most, 6);
    y_ = ScaleOver(y.least, y.most, 5);
  }

  std::string Draw() const {
    std::string svg = Axes();
    for (const ChartCurve& curve : chart_.curves) svg += Bands(curve);
    for (const ChartRule& rule : chart_.rules) svg += Rule(rule);
    for (const ChartCurve& curve : chart_.curves) svg += Lines(curve);
    for (const ChartMark& mark : chart_.marks) {
      svg += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\" fill=\"white\" stroke=\"{}\" "
          "stroke-width=\"1.6\"/>\n",
          X(mark.x), Y(mark.y), mark.colour);
    }
    return svg + Labels();
  }

 private:
  double X(double value) const { return left_ + x_.Share(value) * kPlotWidth; }
  double Y(double value) const { return top_ + (1.0 - y_.Share(value)) * kPlotHeight; }

  std::string Axes() const {
    const double bottom = top_ + kPlotHeight;
    std::string svg = Styled(left_, top_ - 12.0, chart_.title, 13.0, "font-weight=\"bold\"");
    for (double tick = x_.low; tick <= x_.high + 1e-9 * x_.step; tick += x_.step) {
      svg += SvgLine({X(tick), top_}, {X(tick), bottom}, kGrid) +
             Styled(X(tick), bottom + 16.0, Tick(tick, x_.step), 11.0, "text-anchor=\"middle\"");
    }
    for (double tick = y_.low; tick <= y_.high + 1e-9 * y_.step; tick += y_.step) {
      svg += SvgLine({left_, Y(tick)}, {left_ + kPlotWidth, Y(tick)}, kGrid) +
             Styled(left_ - 6.0, Y(tick) + 4.0, Tick(tick, y_.step), 11.0, "text-anchor=\"end\"");
    }
    if (y_.low < 0.0 && y_.high > 0.0) {
      svg += SvgLine({left_, Y(0.0)}, {left_ + kPlotWidth, Y(0.0)},
                     "stroke=\"#888\" stroke-width=\"1\"");
    }
    svg += SvgBox(left_, top_, kPlotWidth, kPlotHeight, kFrame);
    svg += Styled(left_ + 0.5 * kPlotWidth, bottom + 34.0, chart_.x_title, 12.0,
                  "text-anchor=\"middle\"");
    const double x = left_ - 44.0;
    const double y = top_ + 0.5 * kPlotHeight;
    return svg +
           Styled(
               x, y, chart_.y_title, 12.0,
               fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 {:.1f} {:.1f})\"", x, y));
  }

  static std::string Tick(double value, double step) {
    return fmt::format("{:g}", step * std::round(value / step));
  }

  // Calls draw(points) for each stretch of points that are all there.
  template <typename There, typename Draw>
  static void Stretches(const ChartCurve& curve, const There& there, const Draw& draw) {
    std::vector<ChartPoint> stretch;
    for (const ChartPoint& point : curve.points) {
      if (there(point)) {
        stretch.push_back(point);
      } else {
        draw(stretch);
        stretch.clear();
      }
    }
    draw(stretch);
  }

  std::string Bands(const ChartCurve& curve) const {
    std::string svg;
    const auto banded = [](const ChartPoint& p) {
      return std::isfinite(p.low) && std::isfinite(p.high);
    };
    Stretches(curve, banded, [&](const std::vector<ChartPoint>& stretch) {
      if (stretch.size() < 2) return;
      std::vector<SvgPoint> outline;
      outline.reserve(2 * stretch.size());
      for (const ChartPoint& p : stretch) outline.push_back({X(p.x), Y(p.high)});
      for (std::size_t i = stretch.size(); i-- > 0;) {
        outline.push_back({X(stretch[i].x), Y(stretch[i].low)});
      }
      svg += SvgPolygon(outline, fmt::format("fill=\"{}\" fill-opacity=\"0.18\"", curve.colour));
    });
    return svg;
  }

  std::string Lines(const ChartCurve& curve) const {
    std::string svg;
    const auto there = [](const ChartPoint& p) { return std::isfinite(p.y); };
    Stretches(curve, there, [&](const std::vector<ChartPoint>& stretch) {
      if (stretch.empty()) return;
      std::vector<SvgPoint> line;
      line.reserve(stretch.size());
      for (const ChartPoint& p : stretch) line.push_back({X(p.x), Y(p.y)});
      svg += SvgPolyline(
          line,
          fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"2\" "
                      "stroke-linejoin=\"round\"{} data-curve=\"{}: {}\"",
                      curve.colour,
                      curve.dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", curve.dash),
                      core::EscapeXml(chart_.title), core::EscapeXml(curve.label)));
    });
    return svg;
  }

  std::string Rule(const ChartRule& rule) const {
    const double y = Y(rule.y);
    return SvgLine({left_, y}, {left_ + kPlotWidth, y},
                   "stroke=\"#555\" stroke-width=\"1\" stroke-dasharray=\"5 4\"") +
           Styled(left_ + 5.0, y + (y > top_ + 16.0 ? -4.0 : 12.0), rule.label, 11.0,
                  "fill=\"#555\"");
  }

  std::string Labels() const {
    struct End {
      double x, y;
      const ChartCurve* curve;
    };
    std::vector<End> ends;
    for (const ChartCurve& curve : chart_.curves) {
      const auto last = std::find_if(curve.points.rbegin(), curve.points.rend(),
                                     [](const ChartPoint& p) { return std::isfinite(p.y); });
      if (curve.label.empty() || last == curve.points.rend()) continue;
      ends.push_back({X(last->x), Y(last->y), &curve});
    }
    std::stable_sort(ends.begin(), ends.end(),
                     [](const End& a, const End& b) { return a.y < b.y; });
    std::vector<double> wanted;
    wanted.reserve(ends.size());
    for (const End& end : ends) wanted.push_back(end.y);
    const std::vector<double> places = Apart(wanted, top_ + 4.0, top_ + kPlotHeight - 2.0);
    std::string svg;
    const double x = left_ + kPlotWidth + 12.0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      svg += SvgLine({ends[i].x, ends[i].y}, {x - 3.0, places[i]},
                     fmt::format("stroke=\"{}\" stroke-width=\"0.8\" stroke-opacity=\"0.7\"",
                                 ends[i].curve->colour)) +
             Styled(x, places[i] + 4.0, ends[i].curve->label, 11.0,
                    fmt::format("fill=\"{}\"", ends[i].curve->colour));
    }
    return svg;
  }

  const Chart& chart_;
  double left_;
  double top_;
  ChartScale x_;
  ChartScale y_;
};

// The room that labels take.
double LabelRoom(const ChartSheet& sheet) {
  std::size_t longest = 8;
  for (const Chart& chart : sheet.charts) {
    for (const ChartCurve& curve : chart.curves) longest = std::max(longest, curve.label.size());
  }
  for (const BarChart& chart : sheet.bars) {
    for (const ChartBar& bar : chart.bars) longest = std::max(longest, bar.label.size());
  }
  return 14.0 + kLetter * static_cast<double>(longest);
}

std::string DrawBars(const BarChart& chart, double label_room, double left, double top) {
  ChartRange range;
  range.Take(0.0);
  for (const ChartBar& bar : chart.bars) {
    for (const double value : {bar.value, bar.low, bar.high}) range.Take(value);
  }
  const ChartScale scale = ScaleOver(range.least, range.most, 5);
  const double plot_left = left - kAxisRoom + label_room;
  const double width = kPlotWidth + kAxisRoom - kBarTextRoom - label_room;
  const double bottom = top + kPlotHeight;
  const auto x = [&](double value) { return plot_left + scale.Share(value) * width; };
  std::string svg = Styled(left, top - 12.0, chart.title, 13.0, "font-weight=\"bold\"");
  for (double tick = scale.low; tick <= scale.high + 1e-9 * scale.step; tick += scale.step) {
    svg +=
        SvgLine({x(tick), top}, {x(tick), bottom}, kGrid) +
        Styled(x(tick), bottom + 16.0, fmt::format("{:g}", tick), 11.0, "text-anchor=\"middle\"");
  }
  svg += SvgBox(plot_left, top, width, kPlotHeight, kFrame);
  svg +=
      Styled(plot_left + 0.5 * width, bottom + 34.0, chart.x_title, 12.0, "text-anchor=\"middle\"");
  const double pitch =
      kPlotHeight / static_cast<double>(std::max<std::size_t>(chart.bars.size(), 1));
  const double half = std::min(9.0, 0.3 * pitch);
  for (std::size_t i = 0; i < chart.bars.size(); ++i) {
    const ChartBar& bar = chart.bars[i];
    const double y = top + (static_cast<double>(i) + 0.5) * pitch;
    const std::string fill = fmt::format("fill=\"{}\"", bar.colour);
    svg += Styled(plot_left - 6.0, y + 4.0, bar.label, 11.0, "text-anchor=\"end\" " + fill);
    if (std::isfinite(bar.value)) {
      const double end = x(bar.value);
      svg +=
          SvgBox(plot_left, y - half, end - plot_left, 2.0 * half, fill + " fill-opacity=\"0.6\"");
    }
    if (std::isfinite(bar.low) && std::isfinite(bar.high)) {
      svg += SvgLine({x(bar.low), y}, {x(bar.high), y},
                     fmt::format("stroke=\"{}\" stroke-width=\"2\"", kInk));
      for (const double tip : {bar.low, bar.high}) {
        svg += SvgLine({x(tip), y - 4.0}, {x(tip), y + 4.0},
                       fmt::format("stroke=\"{}\" stroke-width=\"2\"", kInk));
      }
    }
    svg += Styled(plot_left + width + 8.0, y + 4.0, bar.text, 11.0, "");
  }
  return svg;
}

}  // namespace

std::string ChartSheetSvg(const ChartSheet& sheet) {
  const double label_room = LabelRoom(sheet);
  const double cell_width = kAxisRoom + kPlotWidth + label_room;
  const double cell_height = kTitleRoom + kPlotHeight + kFootRoom;
  const double head = 40.0 + 17.0 * static_cast<double>(sheet.lines.size());
  const std::size_t cells = sheet.charts.size() + sheet.bars.size();
  const std::size_t row_count = (cells + kColumns - 1) / kColumns;
  const auto rows = static_cast<double>(row_count);
  const double width = 2.0 * kSheetMargin + kColumns * cell_width;
  const double height = head + rows * cell_height + kSheetMargin;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" fill=\"{2}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height, kInk);
  svg += Styled(kSheetMargin, 28.0, sheet.title, 18.0, "font-weight=\"bold\"");
  for (std::size_t i = 0; i < sheet.lines.size(); ++i) {
    svg += Styled(kSheetMargin, 48.0 + 17.0 * static_cast<double>(i), sheet.lines[i], 12.0,
                  "fill=\"#444\"");
  }
  for (std::size_t i = 0; i < cells; ++i) {
    const double left = kSheetMargin + static_cast<double>(i % kColumns) * cell_width + kAxisRoom;
    const std::size_t row = i / kColumns;
    const double top = head + static_cast<double>(row) * cell_height + kTitleRoom;
    svg += i < sheet.charts.size()
               ? Plot(sheet.charts[i], left, top).Draw()
               : DrawBars(sheet.bars[i - sheet.charts.size()], label_room, left, top);
  }
  return svg + "</svg>\n";
}

}  // namespace rockyard::report

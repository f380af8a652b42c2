
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <vector>

#include "report/colour_ramp.h"
#include "report/measurement_text.h"
#include "report/xml_text.h"

namespace rockyard::report {
namespace {

using statistics::Cell;
using statistics::MeasurementSummary;

// Pixels.
constexpr double kPanelWidth = 190.0;
constexpr double kPanelHeight = 130.0;
constexpr double kLeft = 60.0;
constexpr double kTop = 70.0;
constexpr double kGap = 34.0;

double FactorOf(const Cell& cell, std::size_t factor) {
  return factor < cell.factors.size() ? cell.factors[factor] : 0.0;
}

std::vector<double> ValuesOf(const MeasurementSummary& summary, std::size_t factor) {
  std::vector<double> values;
  for (const Cell& cell : summary.cells) values.push_back(FactorOf(cell, factor));
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t IndexOf(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) -
                                  values.begin());
}

class Drawing {
 public:
  Drawing(const MeasurementSummary& summary, std::size_t rate)
      : summary_(summary), rate_(rate), x_(ValuesOf(summary, 0)) {
    for (std::size_t factor = 1; factor < 4; ++factor) {
      split_[factor - 1] = ValuesOf(summary, factor);
    }
  }

  std::string Draw(const std::string& title) const {
    const auto [columns, curves, rows] = split_;
    const double width = kLeft + static_cast<double>(columns.size()) * (kPanelWidth + kGap) + 20.0;
    const double height = kTop + static_cast<double>(rows.size()) * (kPanelHeight + 2 * kGap) + 20;
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" "
        "font-family=\"sans-serif\" font-size=\"11\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        "<text x=\"12\" y=\"20\" font-size=\"14\">{}: {} against {}, bands of 95 %</text>\n",
        width, height, EscapeXml(title), summary_.rates[rate_].name, summary_.factors[0].name);
    svg += Legend(curves);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      for (std::size_t column = 0; column < columns.size(); ++column) {
        svg += Panel(row, column);
      }
    }
    return svg + "</svg>\n";
  }

 private:
  double X(std::size_t column, double value) const {
    const double share = (value - x_.front()) / (x_.back() - x_.front());
    return kLeft + static_cast<double>(column) * (kPanelWidth + kGap) + share * kPanelWidth;
  }
  static double Y(std::size_t row, double rate) {
    return kTop + static_cast<double>(row) * (kPanelHeight + 2 * kGap) +
           (1.0 - rate) * kPanelHeight;
  }

  std::string Label(std::size_t factor, double value) const {
    return factor < summary_.factors.size()
               ? fmt::format("{} {:.4g}", summary_.factors[factor].name, value)
               : std::string();
  }

  std::string Legend(const std::vector<double>& curves) const {
    std::string svg;
    if (summary_.factors.size() < 3) return svg;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      svg +=
          fmt::format("<text x=\"{:.0f}\" y=\"40\" fill=\"{}\">{}</text>\n",
                      12.0 + 170.0 * static_cast<double>(i), CurveColour(i), Label(2, curves[i]));
    }
    return svg;
  }

  std::string Panel(std::size_t row, std::size_t column) const {
    const double left = X(column, x_.front());
    const double top = Y(row, 1.0);
    std::string svg =
        SvgBox(left, top, kPanelWidth, kPanelHeight, "fill=\"none\" stroke=\"#999\"") +
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{} {}</text>\n", left, top - 4.0,
                    Label(1, split_[0][column]), Label(3, split_[2][row]));
    for (const double tick : {0.0, 0.5, 1.0}) {
      svg += SvgStyledText(left - 3.0, Y(row, tick) + 4.0, fmt::format("{:g}", tick),
                           "text-anchor=\"end\"");
    }
    for (const double tick : {x_.front(), x_.back()}) {
      svg += SvgStyledText(X(column, tick), Y(row, 0.0) + 14.0, fmt::format("{:.4g}", tick),
                           "text-anchor=\"middle\"");
    }
    for (std::size_t curve = 0; curve < split_[1].size(); ++curve) svg += Curve(row, column, curve);
    return svg;
  }

  std::string Curve(std::size_t row, std::size_t column, std::size_t curve) const {
    std::map<double, const Cell*> along;  // by the first factor
    for (const Cell& cell : summary_.cells) {
      const bool here = IndexOf(split_[0], FactorOf(cell, 1)) == column &&
                        IndexOf(split_[1], FactorOf(cell, 2)) == curve &&
                        IndexOf(split_[2], FactorOf(cell, 3)) == row;
      if (here && cell.rates[rate_].rate.trials > 0) along[cell.factors[0]] = &cell;
    }
    std::vector<SvgBandPoint> points;
    for (const auto& [value, cell] : along) {
      const statistics::Proportion& rate = cell->rates[rate_].rate;
      points.push_back({X(column, value), Y(row, rate.rate), Y(row, rate.interval.low),
                        Y(row, rate.interval.high)});
    }
    const std::string_view colour = CurveColour(curve);
    return SvgBand(points, colour, 0.25, fmt::format("stroke=\"{}\"", colour));
  }

  const MeasurementSummary& summary_;
  std::size_t rate_;
  std::vector<double> x_;
  std::array<std::vector<double>, 3> split_;  // columns, curves, rows
};

}  // namespace

std::string CellsSvg(const MeasurementSummary& summary, const std::string& title) {
  const std::size_t rate = MainRate(summary.rates);
  if (summary.cells.empty() || summary.factors.empty() || rate == summary.rates.size()) return "";
  if (ValuesOf(summary, 0).size() < 2) return "";
  return Drawing(summary, rate).Draw(title);
}

}  // namespace rockyard::report

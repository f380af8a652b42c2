// Charts of curves with bands, measured points and bars, several of them on one sheet, as SVG. The
// command `mobility` draws by it. No record depends on it: the drawing may change.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/xml_text.h"

namespace rockyard::report {

// Values in the units of the axes. Where y is NaN the curve is broken, where low or high is, it has
// no band.
struct ChartPoint {
  double x;
  double y;
  double low;
  double high;
};

struct ChartCurve {
  std::string label;   // stands at its right end; "": none
  std::string colour;  // of SVG
  std::string dash;    // stroke-dasharray; "": a full line
  std::vector<ChartPoint> points;
};

// Measured points.
struct ChartMark {
  double x;
  double y;
  std::string colour;
};

// A level that matters, as a dashed line across.
struct ChartRule {
  double y;
  std::string label;
};

struct Chart {
  std::string title;
  std::string x_title;  // with the unit
  std::string y_title;
  std::vector<ChartCurve> curves;
  std::vector<ChartMark> marks;
  std::vector<ChartRule> rules;
};

// A row of a chart of bars: a value, what it may be, and a text beside it.
struct ChartBar {
  std::string label;
  std::string colour;
  double value;  // NaN: only the text
  double low;
  double high;
  std::string text;
};

struct BarChart {
  std::string title;
  std::string x_title;
  std::vector<ChartBar> bars;
};

struct ChartSheet {
  std::string title;
  std::vector<std::string> lines;  // below the title
  std::vector<Chart> charts;       // three in a row
  std::vector<BarChart> bars;      // after them
};

// Returns an SVG file. Axes begin and end at round numbers; curves are labelled at their ends, with
// labels apart. The attribute data-curve of a curve's lines is "CHART: LABEL".
std::string ChartSheetSvg(const ChartSheet& sheet);

}  // namespace rockyard::report

// The CSV and the drawing of a trace.
#include <gmock/gmock.h>

#include <cmath>
#include <sstream>
#include <string>

#include "report/trace_csv.h"
#include "report/trace_drawing.h"
#include "sample_trace.h"

namespace rockyard::report {
namespace {

using testing::HasSubstr;

constexpr DrawnArea kPlan{-2.0, 10.0, -2.0, 2.0};

std::size_t CountOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(TraceCsv, SamplesAndEventsInOrderOfTime) {
  const truth::TracedTrial trial = SampleTrial();
  std::istringstream lines(TraceCsv(trial.trace));
  std::string line;
  std::getline(lines, line);
  const std::size_t columns = CountOf(line, ",");
  EXPECT_EQ(columns, 11U);
  double last_s = 0.0;
  std::size_t rows = 0;
  for (; std::getline(lines, line); ++rows) {
    EXPECT_EQ(CountOf(line, ","), columns) << line;
    const double time_s = std::stod(line.substr(line.find(',') + 1));
    EXPECT_GE(time_s, last_s);
    last_s = time_s;
  }
  EXPECT_EQ(rows, trial.trace.samples.size() + trial.trace.events.size());
  EXPECT_THAT(TraceCsv(trial.trace), HasSubstr("\nevent,20,hazard,1,0,0,0.1,1.5,0,0,1,..#..\n"));
}

TEST(TraceDrawing, PathsBreakAtReflectionsAndMarksLieOnBoth) {
  const TraceDrawing drawing = DrawTrace(SampleTrial(), kPlan);
  EXPECT_EQ(CountOf(drawing.elements, "<polyline"), 4U);  // two pieces of two paths
  EXPECT_THAT(drawing.elements, HasSubstr("points=\"0.000,-0.000 0.100,-0.000 "));
  // Three scans at one place: one circle on each path, and one in the key.
  EXPECT_EQ(CountOf(drawing.elements, "<circle"), 3U);
  EXPECT_THAT(drawing.elements, HasSubstr("scrape  at 67 s"));
  EXPECT_THAT(drawing.elements, HasSubstr("sample&lt;&amp;&gt;, seed 7, trial 12: no_path"));
  EXPECT_LT(drawing.area.y_min_m, kPlan.y_min_m);
  EXPECT_EQ(drawing.area.x_max_m, kPlan.x_max_m);
}

TEST(TraceDrawing, LongPathsAreThinnedAndKeepTheirEnds) {
  truth::TracedTrial trial = SampleTrial();
  trial.trace.samples.clear();
  for (int i = 0; i <= 40000; ++i) {
    trial.trace.samples.push_back(
        SampleOf(100.0 + i, 12.5 * i / 40000.0, std::sin(0.01 * i), 0.0, "drive"));
  }
  trial.trace.events.clear();
  const TraceDrawing drawing = DrawTrace(trial, kPlan);
  const std::size_t points = CountOf(drawing.elements, ",") - 2;  // two in the title
  EXPECT_LE(points, 2 * kMaxDrawnPoints);
  EXPECT_GT(points, kMaxDrawnPoints);
  EXPECT_THAT(drawing.elements, HasSubstr("points=\"0.000,-0.000 "));
  EXPECT_THAT(drawing.elements, HasSubstr("12.500,"));
  EXPECT_DOUBLE_EQ(drawing.area.x_max_m, 13.0);  // the believed path is 0.5 m ahead
}

}  // namespace
}  // namespace rockyard::report

// Charts: axes that end at round numbers, labels apart, curves that break where nothing is.
#include "report/chart_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

namespace rockyard::report {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::size_t Times(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++count;
  }
  return count;
}

std::string SheetOf(const std::vector<ChartCurve>& curves) {
  return ChartSheetSvg({.title = "A < B",
                        .lines = {},
                        .charts = {{"slip", "slope [deg]", "slip [%]", curves, {}, {}}},
                        .bars = {}});
}

ChartCurve Curve(const std::string& label, const std::vector<ChartPoint>& points) {
  return {label, "#0072B2", "", points};
}

TEST(Charts, AxesEndAtRoundNumbersAndTextIsEscaped) {
  const std::string svg =
      SheetOf({Curve("a & b", {{0.0, 3.0, kNone, kNone}, {23.0, 87.0, kNone, kNone}})});
  EXPECT_THAT(svg, HasSubstr("A &lt; B"));
  EXPECT_THAT(svg, HasSubstr("a &amp; b"));
  EXPECT_THAT(svg, HasSubstr(">100</text>"));
  EXPECT_THAT(svg, HasSubstr(">25</text>"));
  EXPECT_THAT(svg, Not(HasSubstr(">87</text>")));
  EXPECT_EQ(Times(svg, "<polygon"), 0U);
}

TEST(Charts, CurvesBreakWhereNothingIs) {
  const std::string svg = SheetOf({Curve("a", {{0.0, 1.0, 0.5, 1.5},
                                               {1.0, 1.0, 0.5, 1.5},
                                               {2.0, kNone, kNone, kNone},
                                               {3.0, 2.0, kNone, kNone},
                                               {4.0, 2.0, kNone, kNone}})});
  EXPECT_EQ(Times(svg, "data-curve=\"slip: a\""), 2U);
  EXPECT_EQ(Times(svg, "<polygon"), 1U);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(Charts, LabelsOfCurvesThatMeetStayApart) {
  std::vector<ChartCurve> curves;
  for (const char* label : {"first", "second", "third"}) {
    curves.push_back(Curve(label, {{0.0, 0.0, kNone, kNone}, {1.0, 1.0, kNone, kNone}}));
  }
  const std::string svg = SheetOf(curves);
  std::vector<double> places;
  const std::regex label("y=\"([0-9.]+)\" font-size=\"11\" fill=\"#0072B2\"");
  for (std::sregex_iterator at(svg.begin(), svg.end(), label), end; at != end; ++at) {
    places.push_back(std::stod((*at)[1]));
  }
  ASSERT_EQ(places.size(), 3U);
  EXPECT_GE(places[1] - places[0], 12.9);
  EXPECT_GE(places[2] - places[1], 12.9);
}

TEST(Charts, NothingToDrawIsNoFault) {
  EXPECT_THAT(SheetOf({}), Not(HasSubstr("nan")));
  EXPECT_THAT(SheetOf({Curve("flat", {{0.0, 2.0, kNone, kNone}})}), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace rockyard::report

#include "report/navigation_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "report/colour_ramp.h"

namespace rockyard::report {
namespace {

using messages::MotionCommand;
using messages::MotionKind;
using messages::NavigationView;
using testing::HasSubstr;
using testing::Not;

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

// 4 x 2 cells; the lower row is known (255 255 0 0), the upper row is not.
NavigationView Sample() {
  NavigationView view;
  view.estimate = {.x_m = 0.4, .y_m = 0.2, .heading_rad = 0.0, .distance_m = 0.0};
  view.goal = {0.7, 0.3};
  view.map = {
      .x0_m = 0.0, .y0_m = 0.0, .xstep_m = 0.2, .ystep_m = 0.2, .nx = 4, .ny = 2, .cells = {}};
  for (const int goodness : {255, 255, 0, 0}) {
    view.map.cells.push_back({.has_data = true,
                              .elevation_m = goodness == 0 ? 0.3 : -0.1,
                              .known = true,
                              .goodness = static_cast<std::uint8_t>(goodness),
                              .certainty = 255});
  }
  view.map.cells.resize(8);
  for (const double curvature : {-2.0, 0.0, 2.0}) {
    view.forward.push_back({.motion = {MotionKind::kArc, curvature, 1},
                            .hazard = 200.0,
                            .hazard_certainty = 255.0,
                            .waypoint = 100.0,
                            .merged = 157.0,
                            .best = curvature >= 0.0,
                            .chosen = curvature > 0.0});
    view.backward.push_back({.motion = {MotionKind::kArc, curvature, -1}});
  }
  return view;
}

TEST(NavigationSvg, DrawsMapsVotesAndTheChoice) {
  const std::string svg = NavigationSvg({"trial 3 <b>&", Sample()});
  EXPECT_THAT(svg, HasSubstr("trial 3 &lt;b&gt;&amp;: forward +2.00 /m (vote 157)"));
  EXPECT_THAT(svg, HasSubstr("dark -0.10 m, light 0.30 m"));
  EXPECT_EQ(Count(svg, "<polyline"), 6) << "every arc";
  EXPECT_EQ(Count(svg, "stroke-width=\"4\""), 1) << "the chosen one";
  EXPECT_EQ(Count(svg, "fill=\"#009e73\""), 2) << "two arcs share the best vote";
  EXPECT_EQ(Count(svg, "stroke=\"#009e73\""), 1);
  // Background, three panels; cells in runs: two of elevation, two of goodness, one of certainty;
  // three rows of six votes; two underlines, one frame.
  EXPECT_EQ(Count(svg, "<rect"), 1 + 3 + 5 + 18 + 2 + 1);
}

TEST(NavigationSvg, TheLeftmostTurnStandsLeft) {
  NavigationView view = Sample();
  view.backward.clear();
  const std::string svg = NavigationSvg({"t", view});
  // The only frame stands around the first vote of its block: label and gap before it.
  EXPECT_THAT(svg, HasSubstr("<rect x=\"85.0\""));
}

TEST(NavigationSvg, NothingSeenYet) {
  NavigationView view;
  const std::string svg = NavigationSvg({"empty", view});
  EXPECT_THAT(svg, HasSubstr("elevation: no data"));
  EXPECT_THAT(svg, HasSubstr("empty: nothing"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(NavigationCsv, LeavesUnknownFieldsEmpty) {
  const std::string csv = MapCsv(Sample().map);
  EXPECT_THAT(csv, HasSubstr("x_m,y_m,elevation_m,goodness,certainty\n0.1,0.1,-0.1,255,255\n"));
  EXPECT_THAT(csv, HasSubstr(",0.1,0.3,0,255\n"));
  EXPECT_EQ(Count(csv, ",,,\n"), 4);
  const std::string votes = VotesCsv(Sample());
  EXPECT_THAT(votes, HasSubstr("\nforward,2,1,200,255,100,157,1,1\n"));
  EXPECT_THAT(votes, HasSubstr("\nbackward,-2,-1,0,0,0,0,0,0\n"));
}

TEST(NavigationCsv, PointsOfACloud) {
  messages::PointCloud cloud;
  cloud.points_R = {{0.5, -0.25, 0.125}};
  EXPECT_EQ(CloudCsv(cloud), "x_m,y_m,z_m\n0.5,-0.25,0.125\n");
}

TEST(ChosenText, NamesTurns) {
  NavigationView view;
  view.point_turns.push_back(
      {.motion = {MotionKind::kTurnInPlace, 0.0, -1}, .merged = 12.0, .chosen = true});
  EXPECT_EQ(ChosenText(view), "turn right (vote 12)");
}

double Luminance(const Rgb& c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; }

TEST(RampColour, GrowsLighterAllTheWayAndClamps) {
  for (int i = 1; i <= 100; ++i) {
    EXPECT_GE(Luminance(RampColour(0.01 * i)), Luminance(RampColour(0.01 * (i - 1)))) << i;
  }
  EXPECT_EQ(RampColour(-3.0), RampColour(0.0));
  EXPECT_EQ(RampColour(3.0), RampColour(1.0));
}

}  // namespace
}  // namespace rockyard::report

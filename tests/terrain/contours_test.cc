#include "terrain/contours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "terrain/analytic_ground.h"

namespace rockyard::terrain {
namespace {

constexpr Rectangle kArea{-4.0, 6.0, -3.0, 3.0};

bool IsOnEdge(const CoursePoint& p) {
  const double inside_m = std::min(
      {p.x_m - kArea.x_min_m, kArea.x_max_m - p.x_m, p.y_m - kArea.y_min_m, kArea.y_max_m - p.y_m});
  return std::abs(inside_m) < 1e-9;
}

bool IsClosed(const Contour& contour) {
  const CoursePoint& first = contour.line.front();
  const CoursePoint& last = contour.line.back();
  return first.x_m == last.x_m && first.y_m == last.y_m;
}

TEST(Contours, LevelGroundHasNone) {
  EXPECT_TRUE(Contours(Ground(), kArea, 10, 1000).lines.empty());
}

// A plane of 0.2 along x spans 2 m over the area: no more than ten heights, 0.2 m apart, each one
// line across, straight and in its place.
TEST(Contours, OfAPlaneAreStraightLinesAcross) {
  const Ground plane(GroundParams{.slope_rad = std::atan(0.2)}, {});
  const ContourMap map = Contours(plane, kArea, 10, 900);
  EXPECT_DOUBLE_EQ(map.interval_m, 0.2);
  ASSERT_EQ(map.lines.size(), 10u);
  for (const Contour& contour : map.lines) {
    EXPECT_FALSE(IsClosed(contour));
    const auto [low, high] = std::ranges::minmax(contour.line, {}, &CoursePoint::y_m);
    EXPECT_DOUBLE_EQ(low.y_m, -3.0);
    EXPECT_DOUBLE_EQ(high.y_m, 3.0);
    for (const CoursePoint& p : contour.line) {
      ASSERT_NEAR(0.2 * p.x_m, contour.height_m, 1e-9);
    }
  }
}

// Hills have rings about their tops and hollows; every point is at its height to the second order
// of the grid, and none of the heights in between is lacking.
TEST(Contours, OfHillsCloseAboutTops) {
  const Ground hills = GroundOn(Sampled(Hills, 0.125));
  const ContourMap map = Contours(hills, kArea, 12, 6000);
  std::set<long> heights;
  std::size_t closed = 0;
  for (const Contour& contour : map.lines) {
    closed += IsClosed(contour) ? 1 : 0;
    if (!IsClosed(contour)) {
      EXPECT_TRUE(IsOnEdge(contour.line.front()) && IsOnEdge(contour.line.back()));
    }
    heights.insert(std::lround(contour.height_m / map.interval_m));
    for (const CoursePoint& p : contour.line) {
      ASSERT_NEAR(Hills(p.x_m, p.y_m), contour.height_m, 0.003);
    }
  }
  EXPECT_DOUBLE_EQ(map.interval_m, 0.05);
  EXPECT_EQ(heights, (std::set<long>{-2, -1, 0, 1, 2}));
  EXPECT_GT(closed, 6u);
  EXPECT_LT(closed, map.lines.size()) << "some run over the area's edge";
}

// Four corners about a saddle, twice: the mean of the corners joins the high or the low ones.
TEST(Contours, SaddlesAreJoinedByTheMean) {
  for (const double middle : {0.3, -0.3}) {
    const auto saddle = [middle](double x, double y) { return x * y + middle; };
    const Ground ground = GroundOn(Sampled(saddle, 1.0));
    const ContourMap map = Contours(ground, {-1.0, 1.0, -1.0, 1.0}, 1, 1);
    // One cell with the heights 1 + middle, -1 + middle, ...: two lines at 0, none through both.
    std::vector<Contour> zero;
    for (const Contour& contour : map.lines) {
      if (contour.height_m == 0.0) zero.push_back(contour);
    }
    ASSERT_EQ(zero.size(), 2u);
    for (const Contour& contour : zero) {
      ASSERT_EQ(contour.line.size(), 2u);
      // Each cuts off a low corner where the middle is high, and a high one where it is low.
      const double x = contour.line[0].x_m + contour.line[1].x_m;
      const double y = contour.line[0].y_m + contour.line[1].y_m;
      EXPECT_LT(x * y * middle, 0.0);
    }
  }
}

}  // namespace
}  // namespace rockyard::terrain

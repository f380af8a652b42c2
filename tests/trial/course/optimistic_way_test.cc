// The way of a rover that sees perfectly, but only so far: against closed forms and bounds.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "terrain/field.h"
#include "trial/course/layout.h"
#include "trial/course/route_planner.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

constexpr messages::Goal kGoal{7.6, 0.0};
constexpr double kEverywhere_m = std::numeric_limits<double>::infinity();
constexpr double kGrid = 1.02;  // ways on the grid are longer than in the plane by less

// A rover for which PlanRoute knows no demand but that of the optimist: as long as it is wide to
// turn, and without a margin.
DriveParams Round(const std::string& name) {
  DriveParams drive = Pathfinder(name);
  drive.rover.geometry.length_m = 0.0;
  drive.course.oracle_route.margin_m = 0.0;
  drive.course.oracle_route.low_rock_m = drive.rover.geometry.belly_clearance_m;
  return drive;
}

terrain::Rock Rock(double x_m, double y_m, double radius_m) {
  return {.center_W = {x_m, y_m, 0.0}, .semi_axes_m = {radius_m, radius_m, 0.3}, .height_m = 0.3};
}

double Length_m(const messages::Route& route) {
  messages::Goal from{0.0, 0.0};
  double length_m = 0.0;
  for (const messages::Goal& to : route.corners) {
    length_m += std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
    from = to;
  }
  return length_m;
}

// The shortest way from a point of the x axis round a disc about (3, 0) to the goal: two tangents
// and an arc.
double RoundDisc_m(double from_x_m, double radius_m) {
  const double before_m = 3.0 - from_x_m;
  const double after_m = kGoal.x_m - 3.0;
  const double arc_rad =
      std::numbers::pi - std::acos(radius_m / before_m) - std::acos(radius_m / after_m);
  return std::sqrt(before_m * before_m - radius_m * radius_m) + radius_m * arc_rad +
         std::sqrt(after_m * after_m - radius_m * radius_m);
}

TEST(OptimisticWayTest, LeadsStraightUntilARockComesIntoRange) {
  const DriveParams drive = Round("nominal");
  EXPECT_DOUBLE_EQ(OptimisticWay_m(drive, {}, kGoal, 1.0).value(), 7.6);
  const std::vector rocks{Rock(3.0, 0.0, 0.2)};
  const double keep_m = 0.2 + 0.5 * 0.48;
  const double known_m = Length_m(PlanRoute(drive, rocks, kGoal));
  double last_m = known_m;
  for (const double range_m : {1.2, 0.8}) {
    const double seen_at_m = 3.0 - 0.2 - range_m;
    const double expected_m = seen_at_m + RoundDisc_m(seen_at_m, keep_m);
    const double way_m = OptimisticWay_m(drive, rocks, kGoal, range_m).value();
    EXPECT_GT(way_m, expected_m);
    EXPECT_LT(way_m, kGrid * expected_m);
    EXPECT_NEAR(way_m - known_m, expected_m - RoundDisc_m(0.0, keep_m), 0.03);
    EXPECT_GT(way_m, last_m) << "the later it is seen, the longer";
    last_m = way_m;
  }
}

TEST(OptimisticWayTest, RocksBesideItsWayAndLowOnesCostNothing) {
  const DriveParams drive = Round("nominal");
  std::vector rocks{Rock(3.0, 0.9, 0.2), Rock(5.0, 0.0, 0.2)};
  rocks[1].height_m = 0.12;
  EXPECT_DOUBLE_EQ(OptimisticWay_m(drive, rocks, kGoal, 1.0).value(), 7.6);
  rocks[1].height_m = 0.14;
  EXPECT_GT(OptimisticWay_m(drive, rocks, kGoal, 1.0).value(), 7.62);
}

// A wall from y = -1.8 to 0.6 m, in a strip that ends at 2 m. Who knows it heads for its end. With
// a range of 0.6 m a rover first drives at it to 3 - 0.1 - 0.6 m; from there the shortest way past
// its end, by that end's disc, is a bound.
TEST(OptimisticWayTest, FollowsAWallThatIsLongerThanItsRange) {
  DriveParams drive = Round("nominal");
  drive.terrain.arena.kind = terrain::ArenaKind::kOpen;
  std::vector<terrain::Rock> wall;
  for (int i = 0; i <= 24; ++i) wall.push_back(Rock(3.0, -1.8 + 0.1 * i, 0.1));
  const double known_m = Length_m(PlanRoute(drive, wall, kGoal));
  const double end_m = 0.6 + 0.1 + 0.5 * 0.48;
  const double bound_m = 2.3 + std::hypot(0.7, end_m) + std::hypot(4.6, end_m);
  const double way_m = OptimisticWay_m(drive, wall, kGoal, 0.6).value();
  ASSERT_GT(bound_m, 1.02 * known_m);
  EXPECT_GT(way_m, bound_m);
  EXPECT_LT(way_m, known_m + 2.0 * 1.8) << "to the wrong end and back";
  EXPECT_DOUBLE_EQ(OptimisticWay_m(drive, wall, kGoal, kEverywhere_m).value(), known_m);
  // Shut: no demand has a way.
  for (int i = 25; i <= 80; ++i) wall.push_back(Rock(3.0, -1.8 + 0.1 * i, 0.1));
  for (int i = 1; i <= 60; ++i) wall.push_back(Rock(3.0, -1.8 - 0.1 * i, 0.1));
  EXPECT_FALSE(OptimisticWay_m(drive, wall, kGoal, 0.6).has_value());
}

TEST(OptimisticWayTest, IsNeverShorterThanTheRouteOfWhoKnowsAll) {
  const DriveParams drive = Round("vl2");
  double excess = 0.0;
  int ways = 0;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const terrain::Field field =
        terrain::BuildField(drive.terrain, LayoutKey(drive, {1, i}), TerrainCourse(drive.course));
    const std::span<const terrain::Rock> rocks = field.terrain.rocks();
    const double known_m = Length_m(PlanRoute(drive, rocks, kGoal));
    const std::optional<double> way_m = OptimisticWay_m(drive, rocks, kGoal, 1.0);
    ASSERT_EQ(way_m.has_value(), known_m > 0.0);
    if (!way_m) continue;
    EXPECT_GE(*way_m, known_m);
    EXPECT_DOUBLE_EQ(OptimisticWay_m(drive, rocks, kGoal, kEverywhere_m).value(), known_m);
    excess += *way_m / known_m - 1.0;
    ++ways;
  }
  EXPECT_GT(ways, 40);
  EXPECT_GT(excess / ways, 0.01) << "what is not known costs";
}

}  // namespace
}  // namespace rockyard::trial

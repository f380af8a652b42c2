// Routes by true knowledge of the rocks, and the rover that follows them.
#include "trial/course/route_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "terrain/field.h"
#include "trial/course/layout.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

terrain::Rock Rock(double x_m, double y_m, double radius_m, double height_m) {
  terrain::Rock rock;
  rock.center_W = {x_m, y_m, 0.0};
  rock.semi_axes_m = {radius_m, radius_m, height_m};
  rock.height_m = height_m;
  return rock;
}

messages::Route PlanAmong(std::vector<terrain::Rock> rocks) {
  const DriveParams drive = Pathfinder("nominal");
  const terrain::Terrain terrain(terrain::Ground(), std::move(rocks), {});
  return PlanRoute(drive, terrain.rocks(), {7.6, 0.0});
}

// Distance of the route from a point.
double Clearance(const messages::Route& route, double x_m, double y_m) {
  messages::Goal from{0.0, 0.0};
  double min_m = 1e9;
  for (const messages::Goal& to : route.corners) {
    for (int i = 0; i <= 1000; ++i) {
      const double share = i / 1000.0;
      min_m = std::min(min_m, std::hypot(from.x_m + share * (to.x_m - from.x_m) - x_m,
                                         from.y_m + share * (to.y_m - from.y_m) - y_m));
    }
    from = to;
  }
  return min_m;
}

TEST(FreeGridTest, ShortestPathGoesRoundAWall) {
  FreeGrid grid({0.0, 5.0, 0.0, 5.0}, 1.0);
  for (int iy = 0; iy < 4; ++iy) grid.Block(Rock(2.5, iy + 0.5, 0.1, 1.0), 0.3);
  EXPECT_FALSE(grid.IsFree(2, 3));
  const std::vector<std::size_t> way = ShortestPath(grid, grid.Index(0, 0), grid.Index(4, 0));
  ASSERT_FALSE(way.empty());
  EXPECT_NE(std::find(way.begin(), way.end(), grid.Index(2, 4)), way.end());
  EXPECT_FALSE(grid.IsClear(grid.Centre(grid.Index(0, 0)), grid.Centre(grid.Index(4, 0))));
  grid.Block(Rock(2.5, 4.5, 0.1, 1.0), 0.3);
  EXPECT_TRUE(ShortestPath(grid, grid.Index(0, 0), grid.Index(4, 0)).empty());
}

// Across a corner only where both cells beside it are free: a rover on the way between two blocked
// cells that touch would drive through both, and past one through that.
TEST(FreeGridTest, NoPathCutsACorner) {
  FreeGrid one({0.0, 3.0, 0.0, 3.0}, 1.0);
  one.Block(Rock(1.5, 0.5, 0.1, 1.0), 0.3);
  const std::vector<std::size_t> round = ShortestPath(one, one.Index(0, 0), one.Index(1, 1));
  EXPECT_EQ(round, (std::vector<std::size_t>{one.Index(0, 0), one.Index(0, 1), one.Index(1, 1)}));

  FreeGrid both = one;  // a corner that two blocked cells shut in
  both.Block(Rock(0.5, 1.5, 0.1, 1.0), 0.3);
  EXPECT_TRUE(ShortestPath(both, both.Index(0, 0), both.Index(1, 1)).empty());

  const FreeGrid none({0.0, 3.0, 0.0, 3.0}, 1.0);
  EXPECT_EQ(ShortestPath(none, none.Index(0, 0), none.Index(1, 1)).size(), 2U);
}

// Routes lead over centres, so that these must keep the room to the walls that the bounds stand
// for.
TEST(FreeGridTest, CentresLieWithinTheBoundsAndTheBoundsWithinTheCells) {
  for (const double length_m : {5.0, 5.2, 5.49, 5.5, 5.7, 5.99}) {
    const terrain::Rectangle bounds{1.0, 1.0 + length_m, -2.0, -2.0 + length_m};
    const FreeGrid grid(bounds, 1.0);
    const messages::Goal last = grid.Centre(grid.size() - 1);
    EXPECT_LE(last.x_m, bounds.x_max_m) << length_m;
    EXPECT_LE(last.y_m, bounds.y_max_m) << length_m;
    EXPECT_GT(last.x_m + 1.0, bounds.x_max_m) << "no cell is missing, " << length_m;
    EXPECT_TRUE(grid.IsFree({bounds.x_max_m - 1e-9, bounds.y_max_m - 1e-9})) << length_m;
    EXPECT_FALSE(grid.IsFree({bounds.x_max_m + 0.6, bounds.y_min_m + 0.5})) << length_m;
    EXPECT_FALSE(grid.IsFree({bounds.x_min_m - 1e-9, bounds.y_min_m + 0.5})) << length_m;
  }
}

TEST(RoutePlannerTest, NoRocksGiveOneStraightLeg) {
  const messages::Route route = PlanAmong({});
  ASSERT_EQ(route.corners.size(), 1U);
  EXPECT_EQ(route.corners[0].x_m, 7.6);
}

// Half the diagonal of 0.65 m by 0.48 m and the margin of 5 cm, to half a diagonal of a cell.
TEST(RoutePlannerTest, KeepsClearOfARockInTheWay) {
  const messages::Route route = PlanAmong({Rock(3.0, 0.0, 0.2, 0.3)});
  const double room_m = 0.5 * std::hypot(0.65, 0.48) + 0.05;
  EXPECT_GT(Clearance(route, 3.0, 0.0), 0.2 + room_m - 0.036);
  EXPECT_LT(Clearance(route, 3.0, 0.0), 0.2 + room_m + 0.1);
}

TEST(RoutePlannerTest, LowRocksAreCrossedWhereThereIsNoWayRound) {
  std::vector<terrain::Rock> wall;
  for (double y_m = -1.8; y_m < 1.9; y_m += 0.3) wall.push_back(Rock(3.0, y_m, 0.15, 0.10));
  EXPECT_FALSE(PlanAmong(wall).corners.empty());
  for (terrain::Rock& rock : wall) rock.height_m = 0.2;
  EXPECT_TRUE(PlanAmong(wall).corners.empty());
}

TEST(RoutePlannerTest, NarrowGapsAreTheLastResort) {
  // 0.50 m between two walls: less than the width and two margins.
  std::vector<terrain::Rock> wall{Rock(3.0, 0.40, 0.15, 0.3), Rock(3.0, -0.40, 0.15, 0.3)};
  for (double y_m = 0.7; y_m < 1.9; y_m += 0.3) {
    wall.push_back(Rock(3.0, y_m, 0.15, 0.3));
    wall.push_back(Rock(3.0, -y_m, 0.15, 0.3));
  }
  const messages::Route route = PlanAmong(wall);
  ASSERT_FALSE(route.corners.empty());
  EXPECT_LT(Clearance(route, 3.0, 0.0), 0.1);
}

TEST(RoutePlannerTest, RoutesStayBetweenTheMirrorLinesAndRepeat) {
  const DriveParams drive = Pathfinder("vl2");
  for (std::uint32_t i = 0; i < 10; ++i) {
    const terrain::Field field =
        terrain::BuildField(drive.terrain, LayoutKey(drive, {1, i}), TerrainCourse(drive.course));
    const messages::Route route = PlanRoute(drive, field.terrain.rocks(), {7.6, 0.0});
    const messages::Route again = PlanRoute(drive, field.terrain.rocks(), {7.6, 0.0});
    ASSERT_EQ(route.corners.size(), again.corners.size());
    for (std::size_t c = 0; c < route.corners.size(); ++c) {
      EXPECT_LE(std::abs(route.corners[c].y_m), 1.1);
      EXPECT_EQ(route.corners[c].x_m, again.corners[c].x_m);
    }
  }
}

// With the true pose the follower keeps to the route; where there is none it gives up.
TEST(RouteTrialTest, ArrivesWhereThereIsAWay) {
  const DriveParams drive =
      Pathfinder("nominal", {"rover.fidelity=quasi_static", "localization.estimator=oracle",
                             "navigation.navigator=route"});
  const std::vector<DriveResult> results = RunTrials(drive, 40);
  const auto reached = std::count_if(results.begin(), results.end(), [](const DriveResult& each) {
    return each.outcome == truth::TrialOutcome::kGoalReached;
  });
  EXPECT_GE(reached, 36);
  for (const DriveResult& result : results) EXPECT_EQ(result.record.scans, 0.0);
}

TEST(RouteTrialTest, GivesUpWhereThereIsNone) {
  const DriveParams drive =
      Pathfinder("nominal", {"rover.fidelity=quasi_static", "navigation.navigator=route",
                             "terrain.rocks.kind=listed", "terrain.rocks.listed.x_m=[3,3,3,3]",
                             "terrain.rocks.listed.y_m=[-1.2,-0.4,0.4,1.2]",
                             "terrain.rocks.listed.diameter_m=[0.8,0.8,0.8,0.8]",
                             "terrain.rocks.listed.height_m=[0.5,0.5,0.5,0.5]"});
  const DriveResult result = RunTrial(drive, {1, 0});
  EXPECT_EQ(result.outcome, truth::TrialOutcome::kNoPath);
  EXPECT_EQ(result.record.true_distance_m, 0.0);
}

// The rover drives to the goal that it is told; the true one decides.
TEST(DesignatedDriveTest, AFarGoalIsAFalseOne) {
  const DriveParams drive =
      Pathfinder("nominal", {"rover.fidelity=quasi_static", "localization.estimator=oracle",
                             "terrain.rocks.kind=none", "course.designation.enabled=true",
                             "course.designation.pan_error_deg=6"});
  const DriveResult result = RunTrial(drive, {1, 0});
  EXPECT_EQ(result.outcome, truth::TrialOutcome::kFalseGoal);
  EXPECT_NEAR(result.record.designation_error_m, 7.6 * 6.0 * std::numbers::pi / 180.0, 0.1);
  EXPECT_LT(result.record.believed_goal_distance_m, 0.1001);
  EXPECT_GT(result.record.true_goal_distance_m, 0.65);
}

}  // namespace
}  // namespace rockyard::trial

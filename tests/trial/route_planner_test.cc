// Routes by true knowledge of the rocks, and the rover that follows them.

#include "trial/course/route_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "terrain/field.h"
#include "trial/course/free_grid.h"
#include "trial/course/goal_designation.h"
#include "trial/course/layout.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

terrain::Rock Rock(double x_m, double y_m, double radius_m, double height_m) {
  return {.center_W = {x_m, y_m, 0.0},
          .semi_axes_m = {radius_m, radius_m, height_m},
          .height_m = height_m};
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

// Routes planned on a map of the rocks, and the drives along them.

const Overrides kLander = {"rover.fidelity=quasi_static", "course.designation.enabled=true",
                           "course.route_map.source=lander"};

DriveParams Lander(const Overrides& more, const std::string& name = "nominal") {
  return Pathfinder(name, kLander + more);
}

terrain::Terrain FieldOf(const DriveParams& drive, core::TrialKey key) {
  return terrain::BuildField(drive.terrain, LayoutKey(drive, key), TerrainCourse(drive.course))
      .terrain;
}

bool AreSame(const std::vector<messages::Goal>& a, const std::vector<messages::Goal>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const messages::Goal& one, const messages::Goal& other) {
                      return one.x_m == other.x_m && one.y_m == other.y_m;
                    });
}

TEST(ToldPlacesTest, WithoutARouteTheyAreTheDesignatedOnes) {
  DriveParams drive = Pathfinder("nominal", {"course.designation.enabled=true"});
  drive.course.waypoints = {.x_m = {3.0}, .y_m = {0.5}};
  const terrain::Terrain terrain = FieldOf(drive, {1, 4});
  EXPECT_TRUE(AreSame(ToldPlaces(drive, terrain, {1, 4}), DesignatedGoals(drive.course, {1, 4})));
}

TEST(ToldRouteTest, IsPlannedAmongTheRocksOfItsMap) {
  DriveParams drive = Lander({"navigation.navigator=route"});
  const terrain::Terrain terrain = FieldOf(drive, {1, 2});
  const messages::Goal goal = DesignatedGoal(drive.course, {1, 2});
  std::vector<terrain::Rock> rocks;
  for (const MappedRock& rock : MapFromLander(drive.course, terrain, {1, 2})) {
    rocks.push_back(rock.rock);
  }
  const messages::Route known = ToldRoute(drive, terrain, {1, 2}, goal);
  ASSERT_GT(known.corners.size(), 1U);
  EXPECT_TRUE(AreSame(known.corners, PlanRoute(drive, rocks, goal).corners));
  drive.course.route_map.source = RouteMap::kOracle;
  const messages::Route best = ToldRoute(drive, terrain, {1, 2}, goal);
  EXPECT_TRUE(AreSame(best.corners, PlanRoute(drive, terrain.rocks(), goal).corners));
  EXPECT_FALSE(AreSame(best.corners, known.corners));
  drive.course.route_map.source = RouteMap::kLander;
  // Of another trial the errors, and so the way, are others.
  drive.course.lander_map.disparity_sd_px = 0.5;
  EXPECT_FALSE(AreSame(ToldRoute(drive, terrain, {1, 2}, goal).corners,
                       ToldRoute(drive, terrain, {1, 3}, goal).corners));
  // Nothing known: straight ahead.
  drive.course.lander_map.reach_m = 0.1;
  EXPECT_EQ(ToldRoute(drive, terrain, {1, 2}, goal).corners.size(), 1U);
}

double Between(const messages::Goal& a, const messages::Goal& b) {
  return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
}

TEST(ToldPlacesTest, CornersKeepTheirDistanceAndTheirOrder) {
  DriveParams drive = Lander({"course.route_map.use=waypoints"}, "vl2");
  std::size_t corners = 0;
  std::size_t kept = 0;
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    const core::TrialKey key{1, trial};
    const terrain::Terrain terrain = FieldOf(drive, key);
    const messages::Goal goal = DesignatedGoal(drive.course, key);
    const messages::Route route = ToldRoute(drive, terrain, key, goal);
    const std::vector<messages::Goal> places = ToldPlaces(drive, terrain, key);
    ASSERT_FALSE(places.empty());
    EXPECT_TRUE(AreSame({places.back()}, {goal}));
    messages::Goal from{0.0, 0.0};
    auto next = route.corners.begin();
    for (const messages::Goal& place : places) {
      const bool last = &place == &places.back();
      if (!last) {
        EXPECT_GE(Between(from, place), 0.5);
        EXPECT_GE(Between(place, goal), 0.5);
        next = std::find_if(next, route.corners.end(), [&](const messages::Goal& corner) {
          return AreSame({corner}, {place});
        });
        EXPECT_NE(next, route.corners.end());
      }
      from = place;
    }
    corners += route.corners.size();
    kept += places.size();
  }
  EXPECT_LT(kept, corners);
  EXPECT_GT(kept, 30U);
  drive.course.route_map.spacing_m = 20.0;
  EXPECT_EQ(ToldPlaces(drive, FieldOf(drive, {1, 2}), {1, 2}).size(), 1U);
}

// A wall of rocks from one mirror line to the other: no way, so the goal alone.
TEST(ToldPlacesTest, WhereTheMapShowsNoWayTheGoalAloneIsTold) {
  const Overrides wall = {"terrain.rocks.kind=listed", "terrain.rocks.listed.x_m=[3,3,3,3]",
                          "terrain.rocks.listed.y_m=[-1.2,-0.4,0.4,1.2]",
                          "terrain.rocks.listed.diameter_m=[0.8,0.8,0.8,0.8]",
                          "terrain.rocks.listed.height_m=[0.5,0.5,0.5,0.5]"};
  const DriveParams merged = Lander(wall + Overrides{"course.route_map.use=waypoints"});
  EXPECT_EQ(ToldPlaces(merged, FieldOf(merged, {1, 0}), {1, 0}).size(), 1U);
  // Who can do nothing but follow a route gives up.
  const DriveParams blind = Lander(wall + Overrides{"navigation.navigator=route"});
  const DriveResult result = RunTrial(blind, {1, 0});
  EXPECT_EQ(result.outcome, truth::TrialOutcome::kNoPath);
  EXPECT_EQ(result.record.true_distance_m, 0.0);
}

// One rock in the way and a rover that knows where it is: blind and on the true rocks' route, blind
// without any map (into the rock), and blind on the lander's.
TEST(LanderMapDriveTest, TheMapLeadsABlindRoverRoundARock) {
  const Overrides one = {
      "terrain.rocks.kind=listed",           "terrain.rocks.listed.x_m=[3]",
      "terrain.rocks.listed.y_m=[0.05]",     "terrain.rocks.listed.diameter_m=[0.6]",
      "terrain.rocks.listed.height_m=[0.4]", "localization.estimator=oracle",
      "navigation.navigator=route"};
  EXPECT_EQ(RunTrial(Lander(one), {1, 0}).outcome, truth::TrialOutcome::kGoalReached);
  EXPECT_NE(RunTrial(Lander(one + Overrides{"course.lander_map.reach_m=2"}), {1, 0}).outcome,
            truth::TrialOutcome::kGoalReached);
}

// The corners are passed, not arrived at: near each, or across the line through it.
TEST(LanderMapDriveTest, ARoverThatLooksItselfPassesTheCorners) {
  const DriveParams drive =
      Lander({"course.route_map.use=waypoints", "localization.estimator=oracle"});
  double reached = 0.0;
  bool farther_than_arrival = false;
  for (std::uint32_t trial = 0; trial < 12; ++trial) {
    const TracedTrial run = RunTraced(drive, trial);
    const auto places = ToldPlaces(drive, FieldOf(drive, {1, trial}), {1, trial});
    const auto events = EventsOf(run.trace, "waypoint");
    EXPECT_EQ(run.result.record.waypoints_reached, static_cast<double>(events.size()));
    if (run.result.outcome != truth::TrialOutcome::kGoalReached) continue;
    ASSERT_EQ(events.size(), places.size() - 1);
    for (std::size_t i = 0; i < events.size(); ++i) {
      const messages::Goal from = i == 0 ? messages::Goal{0.0, 0.0} : places[i - 1];
      const messages::Goal at{events[i].pose.x_m, events[i].pose.y_m};
      const double beyond = (at.x_m - places[i].x_m) * (places[i].x_m - from.x_m) +
                            (at.y_m - places[i].y_m) * (places[i].y_m - from.y_m);
      EXPECT_TRUE(Between(at, places[i]) <= 0.3 + 1e-9 || beyond >= -1e-9) << trial;
      farther_than_arrival = farther_than_arrival || Between(at, places[i]) > 0.2;
    }
    EXPECT_GT(run.result.record.scans, 0.0);
    reached += run.result.record.waypoints_reached;
  }
  EXPECT_GT(reached, 3.0);
  EXPECT_TRUE(farther_than_arrival);
}

// What is off does nothing: any value of the map's parameters leaves every bit as it is.
TEST(LanderMapDriveTest, AMapThatNobodyAsksForChangesNothing) {
  const Overrides plain = {"rover.fidelity=quasi_static", "course.designation.enabled=true"};
  const DriveParams before = Pathfinder("nominal", plain);
  const DriveParams after = Pathfinder(
      "nominal",
      plain + Overrides{"course.lander_map.mast_height_m=3", "course.lander_map.edge_sd_px=9",
                        "course.route_map.spacing_m=3", "course.route_map.passing_m=3"});
  for (std::uint32_t trial = 0; trial < 3; ++trial) {
    EXPECT_TRUE(Differences(RunTrial(before, {1, trial}), RunTrial(after, {1, trial})).empty());
  }
}

}  // namespace
}  // namespace rockyard::trial

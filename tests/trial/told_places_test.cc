// Routes planned on a map of the rocks, and the drives along them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "terrain/field.h"
#include "trial/course/goal_designation.h"
#include "trial/course/layout.h"
#include "trial/course/route_planner.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

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
  const DriveResult without =
      RunTrial(Lander(one + Overrides{"course.lander_map.reach_m=2"}), {1, 0});
  EXPECT_NE(without.outcome, truth::TrialOutcome::kGoalReached);
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

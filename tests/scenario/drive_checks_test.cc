// Settings that every module accepts alone and that would mislead together are refused, where the
// groups are in use.

#include "core/error.h"
#include "core/refusals.h"
#include "scenario/load.h"
#include "trial/drive_checks_params.h"

namespace rockyard::scenario {
namespace {

using Overrides = std::vector<std::string>;
using core::OneProblem;

std::vector<core::Problem> ProblemsOf(const std::string& name, const Overrides& overrides,
                                      const std::string& family = "gestalt") {
  const auto folder = std::filesystem::path(ROCKYARD_SOURCE_DIR) / "scenarios" / family;
  return core::ProblemsIn([&] { LoadScenario(folder / (name + ".json"), overrides); });
}

// One setting beyond its limit, and the same within it.
struct Limit {
  std::string label;
  std::string scenario;
  std::string beyond;
  std::string within;
  std::string path;
};

std::ostream& operator<<(std::ostream& out, const Limit& limit) { return out << limit.label; }

class DriveLimitTest : public testing::TestWithParam<Limit> {};

TEST_P(DriveLimitTest, RefusesWhatMisleadsAndNothingElse) {
  const Limit& limit = GetParam();
  EXPECT_THAT(ProblemsOf(limit.scenario, {limit.beyond}), OneProblem(limit.path));
  EXPECT_TRUE(ProblemsOf(limit.scenario, {limit.within}).empty());
}

const std::string kStereo = "abundance_behaviour_stereo";
const std::string kArray = "perception.cloud_elevations";
const std::string kListed = "terrain.rocks.listed.x_m";
const std::string kSize = "navigation.gestalt.map.rover";

// Closed forms, for cameras at x = 0.40 m, 0.45 m high, range 4 m: level ground ends at
// 0.4 + sqrt(4^2 - 0.45^2) = 4.375 m. 45 deg down with 90 deg of view it begins under the cameras
// at 0.4 m: of rows of (1.56 m - near_m) / 4 the first ends there for near_m = 0.0133 m. An image
// of 128 x 128 pixels holds 1638 points for each of the ten bins of two rows.
INSTANTIATE_TEST_SUITE_P(
    Drives, DriveLimitTest,
    testing::Values(
        Limit{"front_cameras", "abundance", "sensors.stereo.front.ahead_m=-0.53",
              "sensors.stereo.front.ahead_m=-0.51", "sensors.stereo.front.ahead_m"},
        Limit{"rear_cameras", "abundance", "sensors.stereo.rear.ahead_m=1.05",
              "sensors.stereo.rear.ahead_m=1.03", "sensors.stereo.rear.ahead_m"},
        Limit{"array_too_long", kStereo, kArray + ".far_m=4.38", kArray + ".far_m=4.37",
              kArray + ".far_m"},
        Limit{"array_too_near", kStereo, kArray + ".near_m=0.01", kArray + ".near_m=0.02",
              kArray + ".near_m"},
        Limit{"more_points_than_pixels", kStereo, kArray + ".min_points=1639",
              kArray + ".min_points=1638", kArray + ".min_points"},
        Limit{"array_beyond_the_window", kStereo + "_stripe", kArray + ".half_width_m=0.6",
              kArray + ".half_width_m=0.5", kArray},
        // Rocks of 0.4 m at (0.6, 1.8) and (3.8, 0.2) keep 0.8 m from the flank, 1 m from the
        // centre: y = 1.8 - sqrt(1 - 0.6^2) = 1.0 m, x = 3.8 + sqrt(1 - 0.2^2) = 4.780 m.
        Limit{"start_on_a_rock", "narrow_course", "course.start_y_m=1.01", "course.start_y_m=0.99",
              kListed + "[0]"},
        Limit{"goal_on_a_rock", "narrow_course", "course.goal_x_m=4.77", "course.goal_x_m=4.79",
              kListed + "[21]"},
        // The rock at (1.8, -0.2) keeps a waypoint out up to y = -0.2 + 1 m.
        Limit{"waypoint_on_a_rock", "narrow_course",
              R"(course.waypoints={"x_m": [1.8], "y_m": [0.79]})",
              R"(course.waypoints={"x_m": [1.8], "y_m": [0.81]})", kListed + "[17]"},
        Limit{"model_too_short", "abundance", kSize + ".length_m=0.51", kSize + ".length_m=0.53",
              kSize + ".length_m"},
        Limit{"model_too_wide", "abundance", kSize + ".width_m=1.69", kSize + ".width_m=1.67",
              kSize + ".width_m"}),
    [](const auto& tested) { return tested.param.label; });

TEST(StallTest, OfBatteriesThatAreNeverEmptyIsRefusedToRunOn) {
  const std::string run_on = "referee.stuck_rover=run_on";
  const std::string endless = "energy.battery_wh=0";
  EXPECT_TRUE(ProblemsOf("level_sand", {endless}, "pathfinder").empty());
  EXPECT_TRUE(ProblemsOf("level_sand", {run_on, "energy.battery_wh=50"}, "pathfinder").empty());
  EXPECT_THAT(ProblemsOf("level_sand", {run_on, endless}, "pathfinder"),
              OneProblem("referee.stuck_rover"));
}

// Moments about the bogie pivots at x = 0.13 m, one side: half the chassis of 7.2 kg at x, rocker
// 0.8 kg at 0.015 m, rear wheel 0.5 kg at -0.26 m, whose load is L kg:
//   L (-0.39) = 7.2 (x - 0.13) + 0.8 (-0.115) + 0.5 (-0.39).
// Nothing on the rear wheel, L = 0, gives x = 0.1699 m; nothing on the other two, where it carries
// the whole side of 10 kg, x = -0.3718 m.
TEST(CentreOfMassTest, IsRefusedWhereWheelsWouldHaveToHoldTheRoverDown) {
  const std::string path = "rover.mass.chassis_com_x_m";
  for (const std::string within : {"-0.371", "0", "0.169"}) {
    EXPECT_TRUE(ProblemsOf("nominal", {path + "=" + within}, "pathfinder").empty()) << within;
  }
  for (const std::string beyond : {"-0.372", "0.170", "0.5"}) {
    EXPECT_THAT(
        ProblemsOf("nominal", {path + "=" + beyond}, "pathfinder"),
        OneProblem(path,
                   "tips the rover over: on level ground some wheels would have to hold it down",
                   "use a value from -0.371 to 0.169, with which all six wheels carry a part"))
        << beyond;
  }
}

// A rover as high as a lamp post stands as well, if in unstable balance.
TEST(CentreOfMassTest, MayBeAsHighAsItsOwnBounds) {
  EXPECT_TRUE(ProblemsOf("nominal", {"rover.mass.chassis_com_z_m=2"}, "pathfinder").empty());
}

// A rover lighter than its parts has no chassis whose place could matter: one problem, not two.
TEST(CentreOfMassTest, IsNotAskedForWithoutAChassis) {
  EXPECT_THAT(ProblemsOf("nominal", {"rover.mass.total_kg=5"}, "pathfinder"),
              OneProblem("rover.mass.total_kg"));
}

// Bekker's law of sand under a wheel's mean load at 33 deg, 27.4 N: T_max / N = 0.653 = tan 33.15
// deg.
TEST(SteepGroundTest, IsRefusedWhereTheSoilDoesNotHoldTheRover) {
  const std::string slope = "terrain.ground.slope_deg=";
  const std::string round = "terrain.rocks.pointedness=0";  // pointed ones want level ground
  const std::string bekker = "terrain.ground.soil.law=bekker";
  EXPECT_TRUE(ProblemsOf("nominal", {round, bekker, slope + "33.1"}, "pathfinder").empty());
  for (const std::string steep : {"33.2", "45"}) {
    EXPECT_THAT(
        ProblemsOf("nominal", {round, bekker, slope + steep}, "pathfinder"),
        OneProblem("terrain.ground.slope_deg",
                   "is steeper than the 33.1 deg up to which this soil holds this rover, braked",
                   "use at most 33.1 deg, or a soil of more friction or cohesion"));
  }
  const std::string hard = "terrain.ground.soil.preset=hard_ground";
  EXPECT_TRUE(ProblemsOf("nominal", {round, bekker, slope + "38", hard}, "pathfinder").empty());
  const std::string drift = "terrain.ground.soil.preset=mars_drift";
  EXPECT_FALSE(ProblemsOf("nominal", {round, bekker, slope + "30", drift}, "pathfinder").empty());
}

// Inertia tells from 0.2 m/s on for wheels of 65 mm on Earth; only the multibody has all of it.
TEST(FastRoverTest, IsRefusedWhereInertiaIsLeftOut) {
  const auto problems = [](const std::string& fidelity, const std::string& speed) {
    return ProblemsOf("nominal", {"rover.fidelity=" + fidelity, "rover.drive.speed_m_s=" + speed},
                      "pathfinder");
  };
  EXPECT_TRUE(problems("quasi_static", "0.199").empty());
  EXPECT_TRUE(problems("multibody", "0.5").empty());
  ASSERT_EQ(problems("quasi_static", "0.201").size(), 1u);
  EXPECT_EQ(problems("quasi_static", "0.201")[0].path, "rover.drive.speed_m_s");
}

// A measurement moves no rover over the ground; other conditions may ask for level ground.
TEST(SteepGroundTest, IsNoMatterWhereTheRoverDoesNotDrive) {
  for (const core::Problem& problem :
       ProblemsOf("detection", {"terrain.ground.slope_deg=45"}, "hazard_detection")) {
    EXPECT_EQ(problem.reason.find("holds"), std::string::npos);
  }
}

TEST(DriveChecksTest, GroupsThatDoNothingMayHoldAnything) {
  const Overrides odd = {"sensors.stereo.front.ahead_m=-2", kArray + ".far_m=15",
                         kArray + ".min_points=90000"};
  EXPECT_TRUE(ProblemsOf("abundance_behaviour", odd).empty());
  EXPECT_TRUE(ProblemsOf("abundance", {kArray + ".far_m=15"}).empty());
  EXPECT_TRUE(ProblemsOf("abundance_behaviour", {kSize + ".length_m=3"}).empty());
  EXPECT_TRUE(ProblemsOf("abundance", {kSize + ".length_m=3", kSize + ".modelled=false"}).empty());
  EXPECT_TRUE(
      ProblemsOf("narrow_course", {"course.start_y_m=1.4", "terrain.rocks.kind=none"}).empty());
}

// An answer to slip needs somebody who gives it.
TEST(SlipReactionTest, IsRefusedWhereNobodyReacts) {
  const auto problems = [](Overrides overrides) {
    overrides.insert(overrides.end(), {"sensors.visual_odometry.enabled=true",
                                       "localization.estimator=visual_odometry",
                                       "perception.visual_odometry.slip_check.enabled=true"});
    return ProblemsOf("nominal", overrides, "pathfinder");
  };
  const std::string as_stuck = "navigation.on_slip.reaction=as_stuck";
  const std::string replan = "navigation.on_slip.reaction=replan";
  const std::string route = "navigation.navigator=route";
  EXPECT_TRUE(problems({}).empty());
  EXPECT_TRUE(problems({route}).empty());
  EXPECT_TRUE(problems({replan}).empty());
  EXPECT_TRUE(problems({as_stuck, "navigation.on_board_stuck.reaction=give_up"}).empty());
  for (const Overrides& overrides : {Overrides{as_stuck}, Overrides{replan, route}}) {
    EXPECT_THAT(problems(overrides), OneProblem("navigation.on_slip.reaction"));
  }
  // Nobody asks where slip is not checked.
  EXPECT_TRUE(ProblemsOf("nominal", {as_stuck}, "pathfinder").empty());
}

// A route has one who follows it, and the map of a lander has a lander.
TEST(RouteMapTest, IsRefusedWhereItMisleads) {
  const std::string use = "course.route_map.use";
  const std::string source = "course.route_map.source";
  const std::string corners = use + "=waypoints";
  const std::string lander = source + "=lander";
  const std::string route = "navigation.navigator=route";
  const std::string designated = "course.designation.enabled=true";
  const auto problems = [](const Overrides& overrides) {
    return ProblemsOf("nominal", overrides, "pathfinder");
  };
  for (const Overrides& sound : {Overrides{corners}, Overrides{corners, lander, designated},
                                 Overrides{route}, Overrides{route, lander, designated}}) {
    EXPECT_TRUE(problems(sound).empty());
  }
  struct Case {
    Overrides overrides;
    std::string path;
    std::string reason;
  };
  const std::vector<Case> cases{
      {{corners, route}, use, "follows the whole route"},
      {{corners, R"(course.waypoints={"x_m": [4], "y_m": [0.5]})"}, use, "names others"},
      {{corners, "course.tracking.enabled=true"}, use, "course.tracking.enabled"},
      {{lander, designated}, source, "nobody uses a route"},
      {{lander, route}, source, "course.designation.enabled is false"},
      {{lander, corners}, source, "course.designation.enabled is false"}};
  for (const Case& tested : cases) {
    EXPECT_THAT(problems(tested.overrides), OneProblem(tested.path, tested.reason));
  }
}

// An oracle plans one way to one goal, and targets stay between mirror lines.
TEST(CourseTest, WhatANavigatorOrAnArenaCannotDoIsRefused) {
  const std::string waypoints = R"(course.waypoints={"x_m": [4], "y_m": [0.5]})";
  const std::string tracking = "course.tracking.enabled=true";
  const std::string moving = "course.target_speed_m_s=0.01";
  const std::string route = "navigation.navigator=route";
  const std::string unfolded = "terrain.arena.kind=virtual_unfolded";
  EXPECT_TRUE(ProblemsOf("nominal", {waypoints, tracking}, "pathfinder").empty());
  EXPECT_TRUE(ProblemsOf("nominal", {route}, "pathfinder").empty());
  EXPECT_TRUE(ProblemsOf("nominal", {unfolded, moving}, "pathfinder").empty());
  struct Case {
    Overrides overrides;
    std::string path, reason;
  };
  for (const Case& tested :
       {Case{{route, waypoints}, "course.waypoints.x_m", "navigation.navigator is route"},
        Case{{route, tracking}, "course.tracking.enabled", "navigation.navigator is route"},
        Case{{moving}, "course.target_speed_m_s", "virtual_reflected"}}) {
    EXPECT_THAT(ProblemsOf("nominal", tested.overrides, "pathfinder"),
                OneProblem(tested.path, tested.reason));
  }
}

std::vector<core::Problem> DesignatedGoals(const Overrides& overrides) {
  Overrides all{"course.designation.enabled=true"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return ProblemsOf("nominal", all, "pathfinder");
}

// By the paper's errors at 7.6 m: sigma_downrange = 0.0001 (7.6 m)^2 / 0.15 m = 0.0385 m, one
// degree of pan is 0.1326 m. Five deviations and the pan reach 0.325 m, of 1.1 m up to the mirror
// line.
TEST(DesignatedGoalsTest, AreRefusedWhereTheyMayLieBeyondAMirrorLine) {
  EXPECT_TRUE(DesignatedGoals({}).empty());
  EXPECT_TRUE(DesignatedGoals({"course.goal_y_m=0.77"}).empty());
  EXPECT_TRUE(DesignatedGoals({R"(course.waypoints={"x_m": [3], "y_m": [-0.9]})"}).empty());
  for (const Overrides& beyond :
       {Overrides{"course.goal_y_m=0.78"}, Overrides{"course.goal_y_m=-0.78"},
        Overrides{"course.designation.lander_ahead_m=-25"},
        Overrides{"course.designation.pan_error_deg=-8"},
        Overrides{"course.designation.pan_error_deg=8", "course.designation.pan_kind=uniform"},
        Overrides{"course.designation.disparity_sd_px=1"},
        Overrides{R"(course.waypoints={"x_m": [7.6], "y_m": [0.78]})"},
        Overrides{R"(course.waypoints={"x_m": [3], "y_m": [-1.09]})"}}) {
    EXPECT_THAT(DesignatedGoals(beyond), OneProblem("course.designation.enabled", "mirror lines"))
        << beyond.front();
  }
}

TEST(DesignatedGoalsTest, MayLieAnywhereWithoutMirrorLinesOrErrors) {
  const std::string far = "course.designation.lander_ahead_m=-100";
  EXPECT_FALSE(DesignatedGoals({far}).empty());
  EXPECT_TRUE(DesignatedGoals({far, "terrain.arena.kind=open"}).empty());
  EXPECT_TRUE(DesignatedGoals({far, "terrain.arena.kind=virtual_unfolded"}).empty());
  EXPECT_TRUE(DesignatedGoals({far, "course.designation.enabled=false"}).empty());
}

// What a scenario of driving without stopping is refused for, and with what words.

std::vector<core::Problem> Continuous(const std::string& name, const Overrides& overrides) {
  return ProblemsOf(name, overrides, "continuous");
}

struct Case {
  std::string scenario;
  Overrides beyond;
  std::string path;
  std::string reason;
};

TEST(ContinuousChecks, WhatCannotBeDrivenIsRefusedWithPathReasonAndSuggestion) {
  const std::string cycle = "navigation.gestalt.continuous.cycle";
  const std::vector<Case> cases{
      {"csod",
       {"clock.overlap.imaging=false", "clock.overlap.computing=false"},
       cycle,
       "stop for each look"},
      {"csad", {"clock.overlap.steering=false"}, cycle, "stand to steer"},
      {"csad",
       {"navigation.gestalt.continuous.motion_m=3.5"},
       "navigation.gestalt.continuous.motion_m",
       "blindly past what it judged"},
      {"csad",
       {"navigation.gestalt.splines.length_m=0.5", "navigation.gestalt.splines.waypoint_m=0.5"},
       "navigation.gestalt.continuous.motion_m",
       "beyond the end of the splines"},
      {"csad",
       {"navigation.gestalt.splines.max_curvature_rate_per_m_s=0.001"},
       "navigation.gestalt.splines.max_curvature_rate_per_m_s",
       "leaves no spline"},
      {"csad", {"clock.compute.acquisition_s=-1"}, "clock.compute.acquisition_s", ""},
      {"csad",
       {"navigation.gestalt.speed.min_speed_share=1.5"},
       "navigation.gestalt.speed.min_speed_share",
       ""},
      {"csod",
       {"navigation.gestalt.continuous.replan_fraction=0"},
       "navigation.gestalt.continuous.replan_fraction",
       ""},
      {"csad",
       {"navigation.gestalt.splines.waypoint_m=3.5"},
       "navigation.gestalt.splines.waypoint_m",
       "beyond the end"},
  };
  for (const Case& tested : cases) {
    SCOPED_TRACE(tested.beyond.front());
    const std::vector<core::Problem> found = Continuous(tested.scenario, tested.beyond);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].path, tested.path);
    EXPECT_NE(found[0].reason.find(tested.reason), std::string::npos) << found[0].reason;
    EXPECT_FALSE(found[0].suggestion.empty());
  }
}

// What is not used misleads nobody.
TEST(ContinuousChecks, WhatIsNotInUseIsNotAsked) {
  for (const char* name : {"stop_and_look", "csod", "csad"}) {
    EXPECT_TRUE(Continuous(name, {}).empty()) << name;
  }
  EXPECT_TRUE(
      Continuous("stop_and_look", {"clock.overlap.imaging=false", "clock.overlap.computing=false"})
          .empty());
  EXPECT_TRUE(Continuous("stop_and_look", {"navigation.gestalt.continuous.motion_m=3.5"}).empty());
  EXPECT_TRUE(Continuous("csod", {"clock.overlap.imaging=false"}).empty());
  EXPECT_TRUE(Continuous("csod", {"navigation.gestalt.splines.length_m=0.5",
                                  "navigation.gestalt.splines.waypoint_m=0.5"})
                  .empty());
}

}  // namespace
}  // namespace rockyard::scenario

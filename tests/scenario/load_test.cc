#include "scenario/load.h"

#include <fstream>

#include "core/error.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "core/test_folder.h"
#include "navigation/pathfinder/pathfinder_params.h"

namespace rockyard::scenario {
namespace {

namespace fs = std::filesystem;
using core::Problem;

Scenario Parse(std::string_view text, std::vector<std::string> overrides = {}) {
  return ParseScenario(text, overrides);
}

std::vector<Problem> ProblemsOf(std::string_view text, std::vector<std::string> overrides = {}) {
  return core::ProblemsIn([&] { Parse(text, std::move(overrides)); });
}

TEST(LoadTest, DefaultsAreAValidScenario) {
  EXPECT_EQ(DefaultsJson(), ResolvedJson(Parse("{}")));
  EXPECT_EQ(ResolvedJson(Parse(DefaultsJson())), DefaultsJson());
}

TEST(LoadTest, ReadsEveryPart) {
  const Scenario scenario = Parse(R"({
    "name": "n", "trials": 12, "seed": 99,
    "terrain": {"rocks": {"kind": "uniform_count", "count": 10}},
    "sensors": {"gyro": {"scale": 1.0}},
    "localization": {"estimator": "oracle"},
    "perception": {"dead_reckoning": {}},
    "navigation": {"pathfinder": {"turn_direction": "each_scan", "turn_increment_deg": 20}},
    "course": {"goal_x_m": 5}})");
  EXPECT_EQ(scenario.name, "n");
  EXPECT_EQ(scenario.trials, 12);
  EXPECT_EQ(scenario.seed, 99);
  EXPECT_EQ(scenario.drive.terrain.rocks.kind, terrain::RockFieldKind::kUniformCount);
  EXPECT_EQ(scenario.drive.terrain.rocks.count, 10);
  EXPECT_EQ(scenario.drive.localization.estimators.chosen().name(), "oracle");
  EXPECT_EQ(scenario.drive.sensors.gyro.scale, 1.0);
  EXPECT_EQ(
      scenario.drive.navigation.navigators.params<navigation::PathfinderParams>().turn_direction,
      navigation::TurnDirection::kEachScan);
  EXPECT_EQ(scenario.drive.navigation.navigators.params<navigation::PathfinderParams>()
                .turn_increment_rad,
            math::DegToRad(20.0));
  EXPECT_EQ(scenario.drive.course.goal_x_m, 5.0);
}

TEST(LoadTest, OverridesComeLastAndInOrder) {
  const Scenario scenario = Parse(R"({"seed": 1, "name": "x"})",
                                  {"seed=2", "seed=3", "terrain.rocks.kind=none", "name=a name"});
  EXPECT_EQ(scenario.seed, 3);
  EXPECT_EQ(scenario.drive.terrain.rocks.kind, terrain::RockFieldKind::kNone);
  EXPECT_EQ(scenario.name, "a name");
}

using BadScenario = core::BadInput;

class BadScenarioTest : public testing::TestWithParam<BadScenario> {};

TEST_P(BadScenarioTest, NamesPathReasonAndSuggestion) {
  EXPECT_THAT(ProblemsOf(GetParam().json), IsProblemOf(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(
    Scenarios, BadScenarioTest,
    testing::Values(
        BadScenario{"truncated", R"({"course": {)", "scenario", "line 1, column 13", "strict JSON"},
        BadScenario{"nan", R"({"course": {"goal_x_m": NaN}})", "scenario", "line 1", "finite"},
        BadScenario{"overflow", R"({"course": {"goal_x_m": 1e999}})", "scenario", "overflow",
                    "finite"},
        BadScenario{"duplicate", R"({"seed": 1, "seed": 2})", "scenario: seed", "twice",
                    "keep one"},
        BadScenario{"version", R"({"schema_version": 2})", "schema_version",
                    "above the largest allowed value 1", "from 1 to 1"},
        BadScenario{"unknown", R"({"terain": {}})", "terain", "not a known key",
                    "did you mean \"terrain\"?"},
        BadScenario{"unknown_deep", R"({"terrain": {"rocks": {"knd": "none"}}})",
                    "terrain.rocks.knd", "not a known key", "did you mean \"kind\"?"},
        BadScenario{"name_of_choice", R"({"terrain": {"rocks": {"kind": "more"}}})",
                    "terrain.rocks.kind", "not a known name", "did you mean \"moore\"?"},
        BadScenario{"trials", R"({"trials": 0})", "trials", "is 0, below", "from 1 to"},
        BadScenario{"huge_trials", R"({"trials": 1e18})", "trials", "is 1e+18, above",
                    "from 1 to 1"},
        BadScenario{"negative_seed", R"({"seed": -1})", "seed", "is -1, below", "from 0"},
        BadScenario{"goal_outside", R"({"course": {"goal_x_m": 50}})", "course.goal_x_m",
                    "outside of terrain.arena", "move the goal or enlarge the arena"},
        BadScenario{"goal_beyond_mirror", R"({"course": {"goal_y_m": 1.5}})", "course.goal_x_m",
                    "mirror lines", "move the goal"},
        BadScenario{"start_outside", R"({"course": {"start_x_m": -3}})", "course.start_x_m",
                    "outside of terrain.arena", "move the start"},
        BadScenario{"goal_at_start", R"({"course": {"goal_x_m": 0}})", "course.goal_x_m",
                    "within 0.1 m of the start", "7.6"},
        BadScenario{"waypoint_lists", R"({"course": {"waypoints": {"x_m": [2, 4], "y_m": [0.5]}}})",
                    "course.waypoints.x_m", "names another number of waypoints than y_m",
                    "one entry of each list"},
        BadScenario{"waypoint_without_y", R"({"course": {"waypoints": {"x_m": [2]}}})",
                    "course.waypoints.x_m", "names another number of waypoints than y_m",
                    "one entry of each list"},
        BadScenario{"waypoint_outside",
                    R"({"course": {"waypoints": {"x_m": [2, 50], "y_m": [0, 0]}}})",
                    "course.waypoints.x_m", "puts waypoint 2 outside of terrain.arena",
                    "move the waypoint or enlarge the arena"},
        BadScenario{"waypoint_beyond_mirror",
                    R"({"course": {"waypoints": {"x_m": [2], "y_m": [1.5]}}})",
                    "course.waypoints.x_m", "mirror lines", "move the waypoint"},
        BadScenario{"waypoint_twice",
                    R"({"course": {"waypoints": {"x_m": [2, 2], "y_m": [0, 0.09]}}})",
                    "course.waypoints.x_m", "within 0.1 m of the one before", "leave it out"},
        BadScenario{"waypoint_at_start",
                    R"({"course": {"waypoints": {"x_m": [0.05], "y_m": [0]}}})",
                    "course.waypoints.x_m", "of the start or of the goal", "leave it out"},
        BadScenario{"waypoint_at_goal",
                    R"({"course": {"waypoints": {"x_m": [2, 7.6], "y_m": [0, 0]}}})",
                    "course.waypoints.x_m", "of the start or of the goal", "leave it out"},
        BadScenario{"waypoint_number",
                    R"({"course": {"waypoints": {"x_m": [2, "far"], "y_m": [0, 0]}}})",
                    "course.waypoints.x_m[1]", "not a number", ""},
        BadScenario{"tracking_period", R"({"course": {"tracking": {"period_s": 0}}})",
                    "course.tracking.period_s", "below the smallest allowed value", "from 0.01"},
        BadScenario{"tracking_view", R"({"course": {"tracking": {"half_field_of_view_deg": 181}}})",
                    "course.tracking.half_field_of_view_deg", "above the largest allowed value",
                    "to 180"},
        BadScenario{"tolerance", R"({"course": {"goal_radius_m": 0.05}})", "course.goal_radius_m",
                    "below navigation.pathfinder.goal_tolerance_m", "at least"},
        BadScenario{"control_rate", R"({"clock": {"control_rate_hz": 500}})",
                    "clock.control_rate_hz", "more than one control step", "shorter physics step"},
        BadScenario{"control_rate_quasi_static",
                    R"({"rover": {"fidelity": "quasi_static"}, "clock": {"control_rate_hz": 30}})",
                    "clock.control_rate_hz", "rover.quasi_static.step_s", "shorter physics step"},
        BadScenario{"quasi_static_movable",
                    R"({"rover": {"fidelity": "quasi_static"},
                        "terrain": {"rocks": {"mobility": "movable"}}})",
                    "rover.fidelity", "pushes no rocks", "multibody or fixed rocks"},
        BadScenario{"stereo_pointed",
                    R"({"sensors": {"terrain_sensor": "stereo"},
                        "terrain": {"rocks": {"pointedness": 0.5}}})",
                    "terrain.rocks.pointedness", "stereo, whose rays see ellipsoids only",
                    "use 0, sensors.stereo.fidelity image, or terrain_sensor light_stripe"},
        BadScenario{"diameters",
                    R"({"terrain": {"rocks": {"min_diameter_m": 0.5, "max_diameter_m": 0.4}}})",
                    "terrain.rocks.max_diameter_m", "", ""},
        BadScenario{"noise", R"({"sensors": {"encoders": {"physics_variance_m2_per_m": 0.01}}})",
                    "sensors.encoders.physics_variance_m2_per_m",
                    "larger than distance_variance_m2_per_m", "up to"},
        BadScenario{"wheel_radius",
                    R"({"perception": {"calibration": {"drive": {"wheel_radius_percent": 50}}}})",
                    "perception.calibration.drive.wheel_radius_percent",
                    "is 50, above the largest allowed value 20", "from -20 to 20"},
        BadScenario{"camera_pitch",
                    R"({"perception": {"calibration": {"left_camera": {"pitch_deg": "low"}}}})",
                    "perception.calibration.left_camera.pitch_deg", "not a number", ""},
        BadScenario{"laser", R"({"perception": {"calibration": {"lasers": {"center_deg": 1}}}})",
                    "perception.calibration.lasers.center_deg", "not a known key",
                    "did you mean \"centre_deg\"?"},
        BadScenario{"stripes", R"({"navigation": {"pathfinder": {"left_stripes": [0, 2]}}})",
                    "navigation.pathfinder.left_stripes", "", ""},
        BadScenario{"lines",
                    R"({"sensors": {"light_stripe": {"fidelity": "image",
                                                     "imager": {"averaging_rows": 3}}}})",
                    "perception.stripe_finder.averaging_px", "image lines", "averaging_rows"},
        BadScenario{"hidden",
                    R"({"sensors": {"light_stripe": {"fidelity": "image", "camera_height_m": 0.4,
                                                     "emitter_height_m": 0.35}}})",
                    "sensors.light_stripe.fidelity", "solar panel hide a point",
                    "camera_height_m"}),
    [](const auto& tested) { return std::string(tested.param.label); });

TEST(LoadTest, UnknownOverridePathsAreErrors) {
  EXPECT_THAT(ProblemsOf("{}", {"terrain.rock.kind=none"}),
              core::OneProblem("terrain.rock", "", "did you mean \"rocks\"?"));
  EXPECT_EQ(ProblemsOf("{}", {"seed.x=1"})[0].path, "seed");
}

TEST(LoadTest, FingerprintSeesWhatDecidesATrialAndNothingElse) {
  const std::uint64_t plain = Fingerprint(Parse("{}"));
  EXPECT_EQ(Fingerprint(Parse(R"({"name": "x", "description": "y", "trials": 7})")), plain);
  EXPECT_NE(Fingerprint(Parse(R"({"seed": 2})")), plain);
  EXPECT_NE(Fingerprint(Parse(R"({"terrain": {"rocks": {"kind": "none"}}})")), plain);
  EXPECT_NE(Fingerprint(Parse(R"({"energy": {"battery_wh": 51}})")), plain);
}

class LoadFileTest : public testing::Test {
 protected:
  core::TestFolder own_;
  const fs::path& folder_ = own_.path();
};

TEST_F(LoadFileTest, FilesExtendFiles) {
  std::ofstream(folder_ / "base.json") << R"({"seed": 5, "course": {"goal_x_m": 6}})";
  std::ofstream(folder_ / "top.json") << R"({"extends": "base.json", "course": {"goal_y_m": 1}})";
  const Scenario scenario = LoadScenario(folder_ / "top.json");
  EXPECT_EQ(scenario.seed, 5);
  EXPECT_EQ(scenario.drive.course.goal_x_m, 6.0);
  EXPECT_EQ(scenario.drive.course.goal_y_m, 1.0);
  // Text extends relative to a folder.
  EXPECT_EQ(ParseScenario(R"({"extends": "base.json"})", {}, folder_).seed, 5);
}

TEST_F(LoadFileTest, GroupsExtendFiles) {
  fs::create_directories(folder_ / "rovers");
  std::ofstream(folder_ / "rovers" / "small.json")
      << R"({"mass": {"total_kg": 12, "wheel_kg": 0.4}})";
  std::ofstream(folder_ / "top.json")
      << R"({"rover": {"extends": "rovers/small.json", "mass": {"wheel_kg": 0.3}}})";
  const Scenario scenario = LoadScenario(folder_ / "top.json");
  EXPECT_EQ(scenario.drive.rover.mass.total_kg, 12.0);
  EXPECT_EQ(scenario.drive.rover.mass.wheel_kg, 0.3);
}

// Every object of the schema that has properties allows it, every other one does not.
void ExpectExtends(const core::JsonValue& schema, const std::string& path) {
  const core::JsonValue* properties = schema.Find("properties");
  if (properties == nullptr) return;
  const core::JsonValue* extends = properties->Find("extends");
  ASSERT_NE(extends, nullptr) << path;
  ASSERT_EQ(extends->Find("type")->list().size(), 2U);
  EXPECT_EQ(extends->Find("type")->list()[0].text(), "string");
  EXPECT_EQ(extends->Find("type")->list()[1].text(), "array");
  for (const core::JsonMember& member : properties->members()) {
    ExpectExtends(member.value, path + "." + member.key);
  }
}

TEST(SchemaTest, EveryGroupMayExtend) {
  const core::JsonValue schema = core::ParseJson(SchemaJson(), "schema");
  ExpectExtends(schema, "");
  EXPECT_NE(schema.Find("properties")->Find("rover")->Find("properties")->Find("extends"), nullptr);
}

TEST_F(LoadFileTest, ResolvedScenariosStandAlone) {
  std::ofstream(folder_ / "a.json") << R"({"seed": 5, "sensors": {"gyro": {"scale": 0.97}}})";
  const Scenario scenario = LoadScenario(folder_ / "a.json");
  std::ofstream(folder_ / "resolved.json") << ResolvedJson(scenario);
  const Scenario again = LoadScenario(folder_ / "resolved.json");
  EXPECT_EQ(ResolvedJson(again), ResolvedJson(scenario));
  EXPECT_EQ(Fingerprint(again), Fingerprint(scenario));
}

}  // namespace
}  // namespace rockyard::scenario

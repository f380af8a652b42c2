// The committed scenarios of the map-based navigator hold what Goldberg 2002 states, and pairs of
// them meet the same rocks.

#include "core/archive.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "navigation/gestalt/gestalt_params.h"
#include "scenario/load.h"

namespace rockyard::scenario {
namespace {

using Overrides = std::vector<std::string>;

const std::filesystem::path kFolder =
    std::filesystem::path(ROCKYARD_SOURCE_DIR) / "scenarios" / "gestalt";

Scenario Load(const std::string& name, const Overrides& overrides = {}) {
  return LoadScenario(kFolder / (name + ".json"), overrides);
}

// What is said to be wrong, one problem after the other; empty if nothing is.
std::string ProblemsOf(const std::string& name, const Overrides& overrides) {
  return core::RefusalOf([&] { Load(name, overrides); });
}

bool Complains(const std::string& name, const Overrides& overrides, const std::string& path) {
  return ProblemsOf(name, overrides).find(path) != std::string::npos;
}

std::string GroupText(const Scenario& scenario, const std::string& group) {
  return core::DumpJson(*WriteScenario(scenario).Find(group));
}

TEST(GestaltFilesTest, EveryFileDrivesAPublishedOrNamedPair) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    if (entry.path().extension() != ".json") continue;
    ++files;
    const std::string name = entry.path().stem().string();
    const Scenario scenario = Load(name);
    const bool behaviour = name.find("_behaviour") != std::string::npos;
    const bool light_stripe = name.ends_with("_behaviour");
    EXPECT_EQ(scenario.name, "gestalt_" + name);
    EXPECT_EQ(scenario.drive.navigation.navigators.chosen().name(),
              behaviour ? "pathfinder" : "gestalt")
        << name;
    EXPECT_EQ(scenario.drive.sensors.terrain_sensors.chosen().name(),
              light_stripe ? "light_stripe" : "stereo")
        << name;
    EXPECT_EQ(scenario.drive.rover.fidelity, rover::Fidelity::kQuasiStatic) << name;
    // The stereo of Matthies 1995 ran on its own computer.
    const bool matthies = name == "abundance_rocky_3_2_images";
    EXPECT_EQ(scenario.drive.clock.compute.computer,
              matthies ? trial::Computer::kSparc10 : trial::Computer::kR3000)
        << name;
  }
  EXPECT_EQ(files, 15);
}

TEST(GestaltFilesTest, RunsAreThoseOfTheFigures) {
  const Scenario vl2 = Load("viking_lander_2");
  EXPECT_EQ(vl2.drive.course.goal_x_m - vl2.drive.course.start_x_m, 17.5);  // Goldberg 2002 fig. 4
  EXPECT_EQ(vl2.drive.terrain.rocks.k_per_m2, 0.013);                       // Matthies 1995 sec. 7
  const Scenario narrow = Load("narrow_course");
  EXPECT_EQ(narrow.drive.course.goal_x_m - narrow.drive.course.start_x_m,
            5.0);  // Goldberg 2002 fig. 3
  EXPECT_EQ(narrow.drive.terrain.rocks.kind, terrain::RockFieldKind::kListed);
  const Scenario ditch = Load("ditch");
  EXPECT_EQ(ditch.drive.terrain.rocks.kind, terrain::RockFieldKind::kNone);
  EXPECT_TRUE(ditch.drive.terrain.ground.HasDepressions());
}

// Through the gates of the narrow course from waypoint to waypoint, and nothing else.
TEST(GestaltFilesTest, WaypointsAreAllThatTheirFileAdds) {
  const Scenario narrow = Load("narrow_course");
  Scenario waypoints = Load("waypoints");
  ASSERT_EQ(waypoints.drive.course.waypoints.Places().size(), 2u);
  EXPECT_GT(waypoints.drive.course.waypoints.y_m[0], 0.0) << "the first gate is on the left";
  EXPECT_LT(waypoints.drive.course.waypoints.y_m[1], 0.0);
  waypoints.drive.course.waypoints = {};
  for (const char* group : {"terrain", "rover", "sensors", "perception", "navigation", "course",
                            "referee", "clock", "energy"}) {
    EXPECT_EQ(GroupText(waypoints, group), GroupText(narrow, group)) << group;
  }
}

TEST(GestaltFilesTest, EveryPublishedValueHasItsScenario) {
  const core::JsonValue reference = core::LoadJsonFile(
      std::filesystem::path(ROCKYARD_SOURCE_DIR) / "results" / "reference" / "goldberg2002.json");
  for (const core::JsonValue& value : reference.Find("values")->list()) {
    const std::string scenario = value.Find("scenario")->text();
    const std::string stem = scenario.substr(std::string("gestalt_").size());
    EXPECT_TRUE(std::filesystem::exists(kFolder / (stem + ".json"))) << scenario;
  }
}

// Table 1 as it stands for the Athena SDM, whatever else a scenario changes, where the choices that
// it makes beside the letter are undone.
TEST(GestaltFilesTest, TheAthenaSdmKeepsTable1) {
  const std::string published = GroupText(Scenario{}, "navigation");
  for (const char* name : {"viking_lander_2", "narrow_course", "abundance", "localization_error"}) {
    Scenario scenario = Load(name);
    scenario.drive.navigation.navigators.Choose("pathfinder");  // the default
    navigation::GestaltParams& gestalt =
        scenario.drive.navigation.navigators.params<navigation::GestaltParams>();
    gestalt.map.step_reference = navigation::StepReference::kLevel;
    gestalt.map.tests.pitch = false;
    gestalt.drive.backward_arcs = navigation::BackwardArcs::kBelowThreshold;
    gestalt.drive.point_turns = navigation::PointTurns::kBelowMinVote;
    EXPECT_EQ(GroupText(scenario, "navigation"), published) << name;
  }
}

TEST(GestaltFilesTest, Rocky32IsModelledAtItsSize) {
  const Scenario scenario = Load("abundance_rocky_3_2");
  const navigation::GestaltRoverParams& model =
      scenario.drive.navigation.navigators.params<navigation::GestaltParams>().map.rover;
  const rover::RoverGeometryParams& geometry = scenario.drive.rover.geometry;
  EXPECT_EQ(model.length_m, geometry.length_m);
  EXPECT_EQ(model.width_m, geometry.width_m);
  EXPECT_EQ(model.wheel_radius_m, geometry.wheel_radius_m);
  EXPECT_EQ(model.clearance_m, geometry.belly_clearance_m);
  EXPECT_EQ(GroupText(scenario, "rover"),
            GroupText(Load("abundance_rocky_3_2_behaviour"), "rover"));
  Scenario plain;
  plain.drive.rover.fidelity = rover::Fidelity::kQuasiStatic;
  EXPECT_EQ(GroupText(scenario, "rover"), GroupText(plain, "rover"));
}

// What table 2 of Goldberg 2002 leaves for a move beyond the motion of its wheels was measured with
// GESTALT: the behaviour controller keeps the times of Matthies 1995, which leave no room for it.
Scenario WithoutOverhead(Scenario scenario) {
  scenario.drive.clock.compute.move_overhead_s = 0.0;
  return scenario;
}

TEST(GestaltFilesTest, PairsDifferInNavigatorAndSensorAlone) {
  for (const std::string name : {"abundance", "abundance_rocky_3_2"}) {
    EXPECT_GT(Load(name).drive.clock.compute.move_overhead_s, 0.0);
    const Scenario map = WithoutOverhead(Load(name));
    const Scenario behaviour = Load(name + "_behaviour");
    for (const char* group : {"terrain", "rover", "course", "referee", "clock", "energy"}) {
      EXPECT_EQ(GroupText(map, group), GroupText(behaviour, group)) << name << " " << group;
    }
    EXPECT_EQ(map.seed, behaviour.seed);
    EXPECT_EQ(map.trials, behaviour.trials);
  }
  for (const char* name : {"abundance_rocky_3_2", "localization_error"}) {
    EXPECT_EQ(GroupText(Load("abundance"), "terrain"), GroupText(Load(name), "terrain")) << name;
  }
}

// With the same sensor the two navigators see the same, and what the behaviour controller takes for
// a hazard is what its vehicle cannot straddle.
TEST(GestaltFilesTest, NavigatorsAreComparedWithTheSameStereo) {
  for (const std::string name : {"abundance", "abundance_rocky_3_2"}) {
    const Scenario map = WithoutOverhead(Load(name));
    const Scenario behaviour = Load(name + "_behaviour_stereo");
    for (const char* group : {"terrain", "rover", "course", "referee", "clock", "energy"}) {
      EXPECT_EQ(GroupText(map, group), GroupText(behaviour, group)) << name << " " << group;
    }
    EXPECT_EQ(core::DumpJson(core::WriteParams(map.drive.sensors.stereo)),
              core::DumpJson(core::WriteParams(behaviour.drive.sensors.stereo)))
        << name;
    const rover::RoverGeometryParams& rover = behaviour.drive.rover.geometry;
    const perception::HazardParams& hazard = behaviour.drive.perception.hazard;
    EXPECT_EQ(hazard.neighbour_threshold_m, rover.belly_clearance_m) << name;
    EXPECT_EQ(hazard.range_threshold_m, rover.belly_clearance_m) << name;
    EXPECT_EQ(hazard.agreement, perception::ScanAgreement::kSingleScan) << name;
    // One vehicle length of ground from the front on, a bin around each stripe of the array.
    const perception::CloudElevationParams& array = behaviour.drive.perception.cloud_elevations;
    EXPECT_DOUBLE_EQ(array.near_m, 0.5 * rover.length_m) << name;
    EXPECT_DOUBLE_EQ(array.far_m, 1.5 * rover.length_m) << name;
    EXPECT_DOUBLE_EQ(array.half_width_m,
                     2.5 * behaviour.drive.sensors.light_stripe.inner_stripe_y_m)
        << name;
  }
}

TEST(GestaltFilesTest, TheCroppedViewIsThatOfTheRoversOwnStripes) {
  for (const std::string name : {"abundance", "abundance_rocky_3_2"}) {
    const Scenario cropped = Load(name + "_behaviour_stereo_stripe");
    Scenario full = Load(name + "_behaviour_stereo");
    EXPECT_EQ(cropped.drive.sensors.stereo.field_of_view, sensing::StereoFieldOfView::kStripe)
        << name;
    const sensing::StripeWindowParams& window = cropped.drive.sensors.stereo.stripe_window;
    const sensing::LightStripeParams& stripes = cropped.drive.sensors.light_stripe;
    EXPECT_DOUBLE_EQ(window.near_m, stripes.front_x_m + stripes.row_ahead_m.front()) << name;
    EXPECT_DOUBLE_EQ(window.far_m, stripes.front_x_m + stripes.row_ahead_m.back()) << name;
    EXPECT_DOUBLE_EQ(window.half_width_m, stripes.outer_stripe_y_m) << name;
    const perception::CloudElevationParams& array = cropped.drive.perception.cloud_elevations;
    EXPECT_EQ(array.near_m, window.near_m) << name;
    EXPECT_EQ(array.far_m, window.far_m) << name;
    EXPECT_EQ(array.half_width_m, window.half_width_m) << name;
    // Nothing else differs from the full view.
    full.drive.sensors.stereo.field_of_view = sensing::StereoFieldOfView::kStripe;
    full.drive.perception.cloud_elevations = array;
    for (const char* group :
         {"terrain", "rover", "sensors", "perception", "navigation", "course"}) {
      EXPECT_EQ(GroupText(cropped, group), GroupText(full, group)) << name << " " << group;
    }
  }
}

TEST(GestaltChecksTest, TheSelectedNavigatorsToleranceCounts) {
  EXPECT_TRUE(Complains("abundance", {"course.goal_radius_m=0.2"},
                        "navigation.gestalt.waypoints.goal_tolerance_m"));
  EXPECT_EQ(ProblemsOf("abundance", {"navigation.pathfinder.goal_tolerance_m=2"}), "");
  EXPECT_EQ(ProblemsOf("abundance_behaviour", {"navigation.gestalt.waypoints.goal_tolerance_m=2"}),
            "");
  EXPECT_TRUE(Complains("abundance_behaviour", {"navigation.pathfinder.goal_tolerance_m=2"},
                        "navigation.pathfinder.goal_tolerance_m"));
}

TEST(GestaltChecksTest, GroupsThatDoNothingAreNotHeldAgainstEachOther) {
  const Overrides seven = {"perception.cloud_elevations.stripes=7"};
  EXPECT_EQ(ProblemsOf("abundance", seven), "");
  EXPECT_EQ(ProblemsOf("abundance_behaviour", seven), "");
  EXPECT_TRUE(Complains("abundance_behaviour",
                        {"perception.cloud_elevations.stripes=7", "sensors.terrain_sensor=stereo"},
                        "perception.cloud_elevations.stripes"));
  EXPECT_EQ(ProblemsOf("abundance", {"sensors.light_stripe.stripe_subdivision=2"}), "");
  EXPECT_TRUE(Complains("abundance_behaviour", {"sensors.light_stripe.stripe_subdivision=2"},
                        "sensors.light_stripe has"));
}

TEST(GestaltChecksTest, TheHazardStudiesMeasureTheLightStripe) {
  EXPECT_TRUE(Complains("../hazard_detection/detection", {"sensors.terrain_sensor=stereo"},
                        "sensors.terrain_sensor"));
  // Its own conditions hold, not those of the sensor that the scenario names.
  EXPECT_FALSE(Complains("../hazard_detection/detection",
                         {"sensors.terrain_sensor=stereo", "perception.cloud_elevations.stripes=7"},
                         "cloud_elevations"));
}

// Half of the ditch's 0.5 m and half of the rover's diagonal: 0.918 m.
TEST(GestaltChecksTest, NoDitchReachesUnderTheStart) {
  EXPECT_FALSE(Complains("ditch", {"terrain.ground.ditches.x_m=[0.93]"}, "terrain.ground"));
  EXPECT_TRUE(
      Complains("ditch", {"terrain.ground.ditches.x_m=[0.91]"}, "terrain.ground.ditches.x_m[0]"));
}

TEST(GestaltChecksTest, ListedRocksNeedEveryColumn) {
  EXPECT_TRUE(
      Complains("narrow_course", {"terrain.rocks.listed.y_m=[0.5]"}, "terrain.rocks.listed.y_m"));
}

}  // namespace
}  // namespace rockyard::scenario

// What the replay page is given of trials that are unusual in one way or another.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "campaign/replay_payloads.h"
#include "campaign/trial_source.h"
#include "core/refusals.h"
#include "math/angles.h"

namespace rockyard::campaign {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

TEST(ReplayPayload, SaysWhetherTheStoredRecordIsRepeated) {
  TrialSource source = SourceOf("pathfinder/nominal", {"referee.time_limit_s=60"});
  EXPECT_TRUE(PayloadOf(source, 1)["repeats_stored"].is_null());
  source.stored = ReplayTrial(source, 1).data.record;
  EXPECT_EQ(PayloadOf(source, 1)["repeats_stored"], true);
  source.stored->values[0] += 1e-12;
  EXPECT_EQ(PayloadOf(source, 1)["repeats_stored"], false);
}

TEST(ReplayPayload, RocksThatThePushedRoverMoves) {
  const Json payload = PayloadOf(SourceOf("pathfinder/nominal", {"terrain.rocks.mobility=movable",
                                                                 "terrain.rocks.pointedness=0"}),
                                 10);
  ASSERT_FALSE(payload["rock_moves"].empty());
  for (const Json& move : payload["rock_moves"]) {
    const Json& rock = payload["rocks"][move["rock"].get<std::size_t>()];
    const double moved_m = std::hypot(move["x"].get<double>() - rock["x"].get<double>(),
                                      move["y"].get<double>() - rock["y"].get<double>());
    EXPECT_LT(moved_m, 1.0);
  }
}

TEST(ReplayPayload, SaysWhichWorldItIs) {
  const std::vector<std::string> sun{"sensors.sun.elevation_deg=20", "sensors.sun.azimuth_deg=-60",
                                     "referee.time_limit_s=60"};
  const Json arena = PayloadOf(SourceOf("pathfinder/nominal", sun), 0)["world"];
  EXPECT_EQ(arena["gravity"], 9.81);
  EXPECT_NEAR(arena["sun"]["elevation"].get<double>(), math::DegToRad(20.0), 1e-5);
  EXPECT_NEAR(arena["sun"]["azimuth"].get<double>(), math::DegToRad(-60.0), 1e-5);
  EXPECT_EQ(arena["arena"]["kind"], "virtual_reflected");
  EXPECT_EQ(arena["arena"]["y_max"], 2.0);
  EXPECT_EQ(arena["arena"]["mirror_line"], 1.1);
  const Json mars =
      PayloadOf(SourceOf("mars/mfex_nominal", {"referee.time_limit_s=60"}), 0)["world"];
  EXPECT_EQ(mars["gravity"], 3.72);
  EXPECT_EQ(mars["arena"]["kind"], "open");
  EXPECT_EQ(mars["arena"]["mirror_line"], 0.0);
}

math::Vector3 VectorOf(const Json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

// From the middle of the left edge of a camera's image to that of its right edge, rad.
double SeenAcross(const Json& camera) {
  const std::size_t side = camera["rim"].size() / 4;
  const math::Vector3 right = VectorOf(camera["rim"][side + side / 2]);
  const math::Vector3 left = VectorOf(camera["rim"][3 * side + side / 2]);
  return std::acos(left.dot(right));
}

TEST(ReplayPayload, LightPlanesAndCamerasOfTheLightStripe) {
  const Json sensor =
      PayloadOf(SourceOf("pathfinder/nominal", {"referee.time_limit_s=60"}), 0)["sensor"];
  EXPECT_EQ(sensor["name"], "light_stripe");
  EXPECT_EQ(sensor["reach"], 1.0);
  ASSERT_THAT(sensor["lasers"], SizeIs(5));
  for (const Json& laser : sensor["lasers"]) {
    EXPECT_NEAR(VectorOf(laser["normal"]).dot(VectorOf(laser["axis"])), 0.0, 1e-4);
    EXPECT_EQ(laser["emitter"][0], 0.27);
    EXPECT_EQ(laser["emitter"][2], 0.25);
    EXPECT_EQ(laser["half_fan"], 0.5);
  }
  EXPECT_EQ(sensor["lasers"][0]["emitter"][1], 0.14);
  EXPECT_EQ(sensor["lasers"][4]["emitter"][1], -0.14);
  ASSERT_THAT(sensor["cameras"], SizeIs(2));
  EXPECT_EQ(sensor["cameras"][0]["eye"][1], 0.06);
  // An equidistant row of 8.9 mm behind a lens of 4.8 mm.
  EXPECT_NEAR(SeenAcross(sensor["cameras"][1]), 8.9 / 4.8, 1e-4);
}

TEST(ReplayPayload, CamerasOfStereoLookAheadAndBehind) {
  const TrialSource source = SourceOf("gestalt/narrow_course", {"referee.time_limit_s=60"});
  const Json sensor = PayloadOf(source, 0)["sensor"];
  const sensing::StereoParams& stereo = source.scenario.drive.sensors.stereo;
  EXPECT_THAT(sensor["lasers"], SizeIs(0));
  ASSERT_THAT(sensor["cameras"], SizeIs(4));
  for (const Json& camera : sensor["cameras"]) {
    EXPECT_NEAR(SeenAcross(camera), stereo.horizontal_fov_rad, 1e-4);
    const bool behind = camera["name"].get<std::string>().starts_with("behind");
    EXPECT_EQ(camera["eye"][0].get<double>() < 0.0, behind);
    const Json& top_left = camera["rim"][0];
    EXPECT_EQ(top_left[0].get<double>() < 0.0, behind);
    EXPECT_EQ(top_left[1].get<double>() < 0.0, behind);
  }
}

TEST(ReplayPayload, WaypointsInTheOrderOfDriving) {
  const Json course = PayloadOf(SourceOf("gestalt/waypoints"), 0)["course"];
  ASSERT_THAT(course["waypoints"], SizeIs(2));
  EXPECT_EQ(course["waypoints"][0]["x"], 1.8);
  EXPECT_EQ(course["waypoints"][0]["y"], 0.82);
  EXPECT_EQ(course["waypoints"][1]["x"], 3.9);
  EXPECT_TRUE(PayloadOf(SourceOf("gestalt/narrow_course"), 0)["course"]["waypoints"].empty());
}

TEST(ReplayPayload, StepsOfAMapBasedNavigator) {
  const Json payload = PayloadOf(SourceOf("gestalt/narrow_course"), 0);
  ASSERT_FALSE(payload["steps"].empty());
  for (const Json& step : payload["steps"]) {
    const Json& map = step["map"];
    const std::size_t cells = map["nx"].get<std::size_t>() * map["ny"].get<std::size_t>();
    EXPECT_THAT(map["goodness"], SizeIs(cells));
    EXPECT_THAT(map["elevation"], SizeIs(cells));
    EXPECT_EQ(std::count_if(step["votes"].begin(), step["votes"].end(),
                            [](const Json& vote) { return vote["chosen"] == true; }),
              1);
    EXPECT_THAT(step["points"], SizeIs(kMaxStepPoints));
  }
}

// The rover is found stuck before the drive ends, whether or not it runs on.
TEST(ReplayPayload, AStuckRoverIsMarkedWhereItIsFound) {
  for (const std::string stuck_rover : {"end", "run_on"}) {
    const Json payload =
        PayloadOf(SourceOf("pathfinder/level_sand",
                           {"terrain.arena.kind=walled", "terrain.ground.soil.preset=hard_ground",
                            "course.start_y_m=1.2", "course.start_heading_deg=90",
                            "energy.battery_wh=50", "referee.stuck_rover=" + stuck_rover}),
                  0);
    const Json& events = payload["events"];
    const auto stall = std::find_if(events.begin(), events.end(),
                                    [](const Json& event) { return event["kind"] == "stall"; });
    ASSERT_NE(stall, events.end()) << stuck_rover;
    EXPECT_NEAR((*stall)["t"].get<double>(), ValueOf(payload, "active_time_s"), 1e-6);
    EXPECT_EQ(events.back()["kind"], "end") << stuck_rover;
    EXPECT_EQ(std::count_if(events.begin(), events.end(),
                            [](const Json& event) { return event["kind"] == "stall"; }),
              1);
  }
}

// Of many steps only some keep what takes room. Steps of a real drive, over and over.
TEST(ReplayPayload, ManyStepsStaySmall) {
  ReplayedTrial replayed = ReplayTrial(SourceOf("gestalt/narrow_course"), 0);
  std::vector<replay::ReplayStep>& steps = replayed.data.steps;
  const std::vector<replay::ReplayStep> few = steps;
  while (steps.size() <= 2 * replay::kMaxDetailedSteps) {
    steps.insert(steps.end(), few.begin(), few.end());
  }
  const Json payload = Json::parse(ReplayPayload(replayed));
  std::size_t detailed = 0;
  for (const Json& step : payload["steps"]) {
    const Json& heights = step["map"]["elevation"];
    const bool any = std::any_of(heights.begin(), heights.end(),
                                 [](const Json& height) { return !height.is_null(); });
    EXPECT_EQ(any, !step["points"].empty());
    detailed += any;
  }
  EXPECT_EQ(detailed, (steps.size() + 2) / 3);
}

// Four hours of simulated time, and rough ground in the arena.
TEST(ReplayPayload, TheLongestTrialStaysSmall) {
  const std::string text = ReplayPayload(
      ReplayTrial(SourceOf("pathfinder/obstacles_2.0",
                           {"terrain.ground.roughness_rms_m=0.02", "terrain.ground.slope_deg=3",
                            "terrain.rocks.pointedness=0"}),
                  1));
  // Compressed and in base64 a fifth of it; the page itself has some 0.8 MB.
  EXPECT_LT(text.size(), 6'000'000U);
}

// A rover that slides until its speed leaves the model's range.
TEST(ReplayPayload, ASimulatorFaultIsShownUpToWhereItHappens) {
  // Scenarios refuse a slope that the soil does not hold the rover on.
  TrialSource source = SourceOf(
      "pathfinder/level_sand",
      {"terrain.ground.slope_direction_deg=90", "terrain.ground.soil.friction_angle_deg=5"});
  source.scenario.drive.terrain.ground.slope_rad = math::DegToRad(40.0);
  const Json payload = PayloadOf(source, 0);
  EXPECT_EQ(payload["outcome"], "simulator_fault");
  EXPECT_TRUE(payload["record"].empty());
  EXPECT_LT(Channel(payload, "y").back(), -1.0);
  EXPECT_EQ(payload["events"].back()["kind"], "end");
  EXPECT_NEAR(payload["events"].back()["t"].get<double>(), Channel(payload, "t").back(), 1e-4);
  EXPECT_EQ(payload["events"].back()["detail"], payload["detail"]);
}

// No place for every rock of an exact count.
TEST(ReplayPayload, ATrialWithoutATerrainIsSaid) {
  const TrialSource source =
      SourceOf("pathfinder/obstacles_0.85",
               {"terrain.rocks.clear_radius_m=3.3", "terrain.rocks.mirror_line=keep_off",
                "referee.time_limit_s=1"});
  int told = 0;
  for (std::uint64_t trial = 0; trial < 8; ++trial) {
    const std::string refusal = core::RefusalOf([&] { ReplayTrial(source, trial); });
    if (refusal.empty()) continue;
    EXPECT_THAT(refusal, HasSubstr("has no terrain to show"));
    ++told;
  }
  EXPECT_GE(told, 1);
}

TEST(ReplayPayload, AMeasurementHasNoCourse) {
  EXPECT_THAT(core::RefusalOf([] { ReplayTrial(SourceOf("hazard_detection/false_alarm"), 0); }),
              HasSubstr("--list"));
}

TEST(ReplayPayload, NamesAreTextWhateverTheyHold) {
  TrialSource source = SourceOf("pathfinder/nominal", {"referee.time_limit_s=1"});
  source.scenario.name = "</script><b>\"\\\n\xff";
  const Json payload = PayloadOf(source, 0);
  EXPECT_EQ(payload["scenario"], "</script><b>\"\\\n\xef\xbf\xbd");
}

TEST(ReplayPayload, OnlyAReflectedArenaHasMirrorLines) {
  for (const char* kind : {"virtual_unfolded", "open", "walled"}) {
    const Json payload =
        PayloadOf(SourceOf("pathfinder/nominal",
                           {"referee.time_limit_s=1", std::string("terrain.arena.kind=") + kind}),
                  0);
    EXPECT_EQ(payload["course"]["mirror_lines"], Json::array()) << kind;
  }
}

}  // namespace
}  // namespace rockyard::campaign

// The messages between the command and a navigator's process. Processes that are written depend on
// every name and unit, so that whole messages are kept here as text.
#include "plugin/messages_json.h"

#include <gmock/gmock.h>

#include <array>
#include <string>

#include "asking.h"
#include "core/json_text.h"
#include "core/numbers.h"
#include "whole_messages.h"

namespace rockyard::plugin {
namespace {

using core::CompactJson;
using core::ParseJson;
using navigation::FaultKind;
using testing::ElementsAre;
using testing::IsEmpty;

// A change of these texts is another version of the protocol, unless it adds a member.
constexpr const char* kWholeInput =
    R"({"time_s":12.5,"events":["start","look","hazard"],)"
    R"("estimate":{"x_m":1.5,"y_m":2.5,"heading_rad":0.25,"distance_m":3.5},)"
    R"("odometry":{"x_m":4.5,"y_m":5.5,"heading_rad":0.75,"distance_m":6.5},)"
    R"("attitude":{"roll_rad":0.125,"pitch_rad":-0.125,"z_m":0.0625},)"
    R"("touches_behind":true,"notices_stuck":false,)"
    R"("report":{"scan_number":7,"hazards":[true,false,false,true,true]},)"
    R"("cloud":{"number":8,"direction":"behind",)"
    R"("points_R":[10.25,11.25,12.25,13.25,14.25,15.25]},)"
    R"("look":{"number":9,"time_s":11.5,)"
    R"("estimate":{"x_m":16.5,"y_m":17.5,"heading_rad":1.25,"distance_m":18.5},)"
    R"("odometry":{"x_m":19.5,"y_m":20.5,"heading_rad":-1.25,"distance_m":21.5},)"
    R"("attitude":{"roll_rad":0.375,"pitch_rad":-0.375,"z_m":0.1875}},)"
    R"("hazard":{"kind":"motor_current","side":"right"},)"
    R"("felt":{"articulation_rad":[22.5,23.5,24.5,25.5],"specific_force_R":[26.5,27.5,28.5],)"
    R"("motor_current_A":[29.5,30.5,31.5,32.5,33.5,34.5],)"
    R"("contact":[true,false,true,false,false,true,true]},)"
    R"("covariance":[100.5,101.5,102.5,103.5,104.5,105.5,)"
    R"(101.5,111.5,112.5,113.5,114.5,115.5,)"
    R"(102.5,112.5,122.5,123.5,124.5,125.5,)"
    R"(103.5,113.5,123.5,133.5,134.5,135.5,)"
    R"(104.5,114.5,124.5,134.5,144.5,145.5,)"
    R"(105.5,115.5,125.5,135.5,145.5,155.5],)"
    R"("images":{"number":10,"direction":"behind",)"
    R"("left":{"width":5,"height":4,"C_R":[1.75,2.75,3.75],"A_R":[4.75,5.75,6.75],)"
    R"("H_R":[7.75,8.75,9.75],"V_R":[0.875,-1.75,-2.75],)"
    R"("grey":"yMnKy8zNzs/Q0dLT1NXW19jZ2ts="},)"
    R"("right":{"width":11,"height":6,"C_R":[-3.75,-4.75,-5.75],"A_R":[-6.75,-7.75,-8.75],)"
    R"("H_R":[-9.75,35.5,36.5],"V_R":[37.5,38.5,39.5],)"
    R"("grey":"ZGVmZ2hpamtsbW5vcHFyc3R1dnd4eXp7fH1+f4CBgoOE)"
    R"(hYaHiImKi4yNjo+QkZKTlJWWl5iZmpucnZ6foKGio6Sl"}}})";

TEST(RequestTest, HoldsAWholeInput) {
  const WholeInput whole;
  EXPECT_EQ(CompactJson(InputToJson(whole.input)), kWholeInput);
}

TEST(RequestTest, LeavesOutWhatIsNotThere) {
  EXPECT_EQ(CompactJson(InputToJson({})),
            R"({"time_s":0.0,"events":[],)"
            R"("estimate":{"x_m":0.0,"y_m":0.0,"heading_rad":0.0,"distance_m":0.0},)"
            R"("odometry":{"x_m":0.0,"y_m":0.0,"heading_rad":0.0,"distance_m":0.0},)"
            R"("attitude":{"roll_rad":0.0,"pitch_rad":0.0,"z_m":0.0},)"
            R"("touches_behind":false,"notices_stuck":false})");
  // A rover without any sensor of these, and a look that shows nothing, are something else.
  const messages::VehicleState felt;
  const messages::PointCloud cloud;
  const core::JsonValue empty = InputToJson({.cloud = &cloud, .felt = &felt});
  EXPECT_EQ(CompactJson(*empty.Find("felt")), "{}");
  EXPECT_EQ(CompactJson(*empty.Find("cloud")), R"({"number":0,"direction":"ahead","points_R":[]})");
}

TEST(RequestTest, NamesEveryEventInTheOrderOfTheBits) {
  EXPECT_EQ(CompactJson(*InputToJson({.events = navigation::Events(0x1fffu)}).Find("events")),
            R"(["tick","start","look","manoeuvre","period","near_goal","end_of_plan",)"
            R"("pose_update","correction","goal","hazard","touch_behind","stuck"])");
  using navigation::Event;
  navigation::Events events;
  events.Add(Event::kStuck);
  events.Add(Event::kTick);
  EXPECT_EQ(CompactJson(*InputToJson({.events = events}).Find("events")), R"(["tick","stuck"])");
}

TEST(RequestTest, NamesEveryHazardAndSide) {
  constexpr std::array<const char*, messages::kVehicleHazardKindCount> kKinds{
      "contact", "tilt", "articulation", "motor_current", "slip"};
  constexpr std::array<const char*, 4> kSides{"left", "ahead", "right", "behind"};
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    for (std::size_t side = 0; side < kSides.size(); ++side) {
      const messages::VehicleHazard hazard{static_cast<messages::VehicleHazardKind>(kind),
                                           static_cast<messages::HazardSide>(side)};
      EXPECT_EQ(
          CompactJson(*InputToJson({.vehicle_hazard = &hazard}).Find("hazard")),
          std::string(R"({"kind":")") + kKinds[kind] + R"(","side":")" + kSides[side] + "\"}");
    }
  }
}

TEST(RequestTest, HoldsAWholeSetup) {
  EXPECT_EQ(CompactJson(SetupToJson(WholeSetup())),
            R"({"goal":{"x_m":41.5,"y_m":42.5},)"
            R"("places":[{"x_m":41.5,"y_m":42.5},{"x_m":43.5,"y_m":44.5}],)"
            R"("judges_hazards":false,"full_speed_m_s":0.09375,"control_period_s":0.046875,)"
            R"("operations_per_s":2500000.5,"random_seed":"18446744073709551557",)"
            R"("rover":{"length_m":0.65625,"width_m":0.46875,"belly_clearance_m":0.15625,)"
            R"("wheel_width_m":0.078125,"max_rocker_rad":0.28125,"max_bogie_rad":0.59375,)"
            R"("max_tilt_rad":0.71875,"wheel_radius_m":0.109375,"max_wheel_speed_m_s":0.140625,)"
            R"("max_steer_rad":0.84375,"steering_offset_rad":-0.03125,)"
            R"("wheel_x_m":[51.5,52.5,53.5,54.5,55.5,56.5],)"
            R"("wheel_y_m":[61.5,62.5,63.5,64.5,65.5,66.5],)"
            R"("radius_ratio":[71.5,72.5,73.5,74.5,75.5,76.5],)"
            R"("steered":[true,false,true,true,false,false]},)"
            R"("site_map":{"x0_m":-1.5,"y0_m":-2.5,"step_m":0.5,"nx":2,"ny":1,)"
            R"("height_sd_m":0.53125,"height_m":[3.25,4.25],"rock_share":[0.34375,0.40625]}})");
}

TEST(RequestTest, AMapMayLackALayerOrNotBeThere) {
  navigation::NavigatorSetup setup = WholeSetup();
  auto map = std::make_shared<messages::SiteMap>(*setup.site_map);
  map->rock_share.clear();
  setup.site_map = map;
  EXPECT_EQ(SetupToJson(setup).Find("site_map")->Find("rock_share"), nullptr);
  EXPECT_NE(SetupToJson(setup).Find("site_map")->Find("height_m"), nullptr);
  map->height_m.swap(map->rock_share);
  EXPECT_EQ(SetupToJson(setup).Find("site_map")->Find("height_m"), nullptr);
  EXPECT_EQ(SetupToJson({}).Find("site_map"), nullptr);
}

navigation::NavigatorDecision Decided(const std::string& json) {
  return DecisionFromJson(ParseJson(json, "test"));
}

TEST(AnswerTest, HoldsAWholeDecision) {
  EXPECT_EQ(MembersOf(Decided(
                R"({"status": "driving", "look": "behind", "looks_on_the_move": true,
                    "motion": {"kind": "arc", "curvature_per_m": 0.125, "direction": -1,
                               "curvature_rate_per_m2": 0.25, "speed_share": 0.5, "end_m": 7.5,
                               "move": 11},
                    "until": {"period_s": 1.5, "distance_m": 2.5, "turn_rad": 3.5,
                              "near_goal_m": 4.5},
                    "work_ops": 6.5, "own_values": [1], "of another version": true})")),
            MembersOf(WholeDecision()));
}

// It stands, looks at nothing and is asked at events alone.
TEST(AnswerTest, WhatIsLeftOutHasADefault) {
  const auto silent = MembersOf({.until = navigation::AtEvents()});
  EXPECT_EQ(MembersOf(Decided("{}")), silent);
  EXPECT_EQ(MembersOf(Decided(R"({"motion": {}, "until": {}})")), silent);
  // JSON has no infinity: null is none.
  EXPECT_EQ(MembersOf(Decided(R"({"look": null, "work_ops": null,
    "motion": {"end_m": null, "speed_share": null, "curvature_per_m": null,
               "curvature_rate_per_m2": null},
    "until": {"period_s": null, "distance_m": null, "turn_rad": null, "near_goal_m": null}})")),
            silent);
  EXPECT_EQ(Decided("{}").motion, messages::MotionCommand{});
  EXPECT_EQ(Decided(R"({"until": {"period_s": 0}})").until.period_s, 0.0);
}

TEST(AnswerTest, KnowsEveryName) {
  using navigation::NavigatorStatus;
  EXPECT_EQ(Decided(R"({"status": "driving"})").status, NavigatorStatus::kDriving);
  EXPECT_EQ(Decided(R"({"status": "arrived"})").status, NavigatorStatus::kArrived);
  EXPECT_EQ(Decided(R"({"status": "gave_up"})").status, NavigatorStatus::kGaveUp);
  EXPECT_EQ(Decided(R"({"status": "stuck"})").status, NavigatorStatus::kStuck);
  EXPECT_EQ(Decided(R"({"look": "ahead"})").look, messages::LookDirection::kAhead);
  EXPECT_EQ(Decided(R"({"look": "behind"})").look, messages::LookDirection::kBehind);
  using messages::MotionKind;
  EXPECT_EQ(Decided(R"({"motion": {"kind": "stop"}})").motion.kind, MotionKind::kStop);
  EXPECT_EQ(Decided(R"({"motion": {"kind": "arc"}})").motion.kind, MotionKind::kArc);
  EXPECT_EQ(Decided(R"({"motion": {"kind": "turn"}})").motion.kind, MotionKind::kTurnInPlace);
}

// Directions that are none stay none, so that CheckDecision finds them, whatever their size.
TEST(AnswerTest, DirectionsAreNotMadeRight) {
  EXPECT_EQ(Decided(R"({"motion": {"direction": 0}})").motion.direction, 0);
  EXPECT_EQ(Decided(R"({"motion": {"direction": 4294967297}})").motion.direction, 2);
  EXPECT_EQ(Decided(R"({"motion": {"direction": -4294967295}})").motion.direction, -2);
}

TEST(AnswerTest, WrongTypesAndNamesAreFaults) {
  const std::pair<const char*, const char*> kWrong[] = {
      {R"({"status": 3})", "status is no text"},
      {R"({"status": null})", "status is no text"},
      {R"({"status": "flying"})", "status is \"flying\", not one of driving, arrived"},
      {R"({"look": "up"})", "look is \"up\", not one of ahead, behind"},
      {R"({"look": true})", "look is no text"},
      {R"({"looks_on_the_move": 1})", "looks_on_the_move is neither true nor false"},
      {R"({"motion": "stop"})", "motion is no object"},
      {R"({"motion": {"kind": "spin"}})", "kind is \"spin\", not one of stop, arc, turn"},
      {R"({"motion": {"curvature_per_m": "1"}})", "curvature_per_m is no number"},
      {R"({"motion": {"curvature_rate_per_m2": []}})", "curvature_rate_per_m2 is no number"},
      {R"({"motion": {"speed_share": true}})", "speed_share is no number"},
      {R"({"motion": {"end_m": {}}})", "end_m is no number"},
      {R"({"motion": {"direction": 0.5}})", "direction is no integer"},
      {R"({"motion": {"move": "1"}})", "move is no integer"},
      {R"({"until": 3})", "until is no object"},
      {R"({"until": {"period_s": "1"}})", "period_s is no number"},
      {R"({"until": {"distance_m": true}})", "distance_m is no number"},
      {R"({"until": {"turn_rad": []}})", "turn_rad is no number"},
      {R"({"until": {"near_goal_m": {}}})", "near_goal_m is no number"},
      {R"({"work_ops": "many"})", "work_ops is no number"}};
  for (const auto& [json, words] : kWrong) {
    EXPECT_THAT(FaultOf([&] { Decided(json); }), IsFault(FaultKind::kMessage, words)) << json;
  }
}

messages::Overlay Overlaid(const std::string& json) {
  return OverlayFromJson(ParseJson(json, "test"));
}

TEST(AnswerTest, HoldsAnOverlay) {
  const messages::Overlay overlay = Overlaid(
      R"({"lines": [{"name": "path", "points": [[1.5, 2.5], [3, -4]]}, {"name": "wall"}],
          "grids": [{"name": "cost", "x0_m": 1.5, "y0_m": 2.5, "step_m": 0.25, "nx": 3, "ny": 1,
                     "values": [0, null, 0.75]}]})");
  ASSERT_EQ(overlay.lines.size(), 2U);
  EXPECT_EQ(overlay.lines[0].name, "path");
  ASSERT_EQ(overlay.lines[0].points.size(), 2U);
  EXPECT_EQ(overlay.lines[0].points[0].y_m, 2.5);
  EXPECT_EQ(overlay.lines[0].points[1].x_m, 3.0);
  EXPECT_EQ(overlay.lines[0].points[1].y_m, -4.0);
  EXPECT_THAT(overlay.lines[1].points, IsEmpty());
  ASSERT_EQ(overlay.grids.size(), 1U);
  const auto& [name, x0_m, y0_m, step_m, nx, ny, values] = overlay.grids[0];
  EXPECT_EQ(name, "cost");
  EXPECT_EQ(x0_m, 1.5);
  EXPECT_EQ(y0_m, 2.5);
  EXPECT_EQ(step_m, 0.25);
  EXPECT_EQ(nx, 3);
  EXPECT_EQ(ny, 1);
  EXPECT_THAT(values, ElementsAre(0.0, testing::IsNan(), 0.75));
  EXPECT_EQ(FaultOf([&] { CheckOverlay(overlay); }), "");
  const messages::Overlay none = Overlaid("{}");
  EXPECT_TRUE(none.lines.empty() && none.grids.empty());
}

TEST(AnswerTest, OverlaysOfAnotherShapeAreFaults) {
  const std::pair<const char*, const char*> kWrong[] = {
      {R"({"lines": {}})", "lines is no list"},
      {R"({"lines": [{"points": []}]})", "name is no text"},
      {R"({"lines": [{"name": "a", "points": [[1]]}]})", "no pair [x, y]"},
      {R"({"lines": [{"name": "a", "points": [[1, 2, 3]]}]})", "no pair [x, y]"},
      {R"({"lines": [{"name": "a", "points": [3]}]})", "no pair [x, y]"},
      {R"({"lines": [{"name": "a", "points": [[1, "2"]]}]})", "no number"},
      {R"({"grids": [{"name": "a", "nx": 1.5}]})", "nx is no integer"},
      {R"({"grids": [{"name": "a", "values": ["0"]}]})", "no number"},
      {R"({"grids": [{"name": "a", "step_m": "1"}]})", "step_m is no number"}};
  for (const auto& [json, words] : kWrong) {
    EXPECT_THAT(FaultOf([&] { Overlaid(json); }), IsFault(FaultKind::kMessage, words)) << json;
  }
  const char* const kNone[] = {
      R"({"name": "a", "step_m": 1, "nx": 2, "ny": 2, "values": [1, 2, 3]})",
      R"({"name": "a", "step_m": 1, "nx": -1, "ny": -3, "values": [1, 2, 3]})",
      R"({"name": "a", "step_m": 0, "nx": 1, "ny": 1, "values": [1]})",
      R"({"name": "a", "step_m": -1, "nx": 1, "ny": 1, "values": [1]})",
      R"({"name": "a", "step_m": 1, "nx": 4294967297, "ny": 1, "values": [1]})"};
  for (const char* const grid : kNone) {
    const messages::Overlay overlay = Overlaid(std::string(R"({"grids": [)") + grid + "]}");
    EXPECT_THAT(FaultOf([&] { CheckOverlay(overlay); }), IsFault(FaultKind::kNonsense, "\"a\""))
        << grid;
  }
}

TEST(AnswerTest, AnOverlayIsNotTooLarge) {
  messages::Overlay overlay;
  overlay.lines.push_back({"path", std::vector<messages::Goal>(600'000)});
  overlay.grids.push_back({"cost", 0.0, 0.0, 1.0, 400'000, 1, std::vector<double>(400'000)});
  EXPECT_EQ(FaultOf([&] { CheckOverlay(overlay); }), "");
  overlay.lines[0].points.emplace_back();
  EXPECT_THAT(FaultOf([&] { CheckOverlay(overlay); }),
              IsFault(FaultKind::kNonsense, "1000001 values"));
}

TEST(AnswerTest, OwnValuesAreAsManyAsDeclared) {
  std::array<double, 3> values{9.0, 9.0, 9.0};
  const auto read = [&](const char* json) { OwnValuesFromJson(ParseJson(json, "test"), values); };
  read("[1, null, 2.5]");
  EXPECT_THAT(values, ElementsAre(1.0, testing::IsNan(), 2.5));
  EXPECT_THAT(FaultOf([&] { read("[1, 2]"); }),
              IsFault(FaultKind::kMessage, "has 2 values, and its description declares 3"));
  EXPECT_THAT(FaultOf([&] { read("[1, 2, 3, 4]"); }), IsFault(FaultKind::kMessage, "4 values"));
  EXPECT_THAT(FaultOf([&] { read("[1, 2, true]"); }), IsFault(FaultKind::kMessage, "no number"));
  EXPECT_THAT(FaultOf([&] { read("{}"); }), IsFault(FaultKind::kMessage, "own_values is no list"));
}

TEST(FaultTest, OnlyWhatTheMachineMayHaveDoneIsTriedAgain) {
  using navigation::NavigatorFault;
  for (const FaultKind kind : {FaultKind::kThrew, FaultKind::kNonsense, FaultKind::kMessage}) {
    EXPECT_FALSE(NavigatorFault(kind, "").may_be_the_machine());
  }
  for (const FaultKind kind :
       {FaultKind::kEnded, FaultKind::kCpuTime, FaultKind::kMemory, FaultKind::kSilent}) {
    EXPECT_TRUE(NavigatorFault(kind, "").may_be_the_machine());
  }
}

// What a program could take for a command.
TEST(CheckDecisionTest, FindsWhatCannotBeDone) {
  using navigation::NavigatorDecision;
  const auto fault = [](const std::function<void(NavigatorDecision&)>& change) {
    NavigatorDecision decision = WholeDecision();
    change(decision);
    return FaultOf([&] { CheckDecision(decision); });
  };
  EXPECT_EQ(fault([](NavigatorDecision&) {}), "");
  EXPECT_EQ(fault([](NavigatorDecision& d) { d = {.until = navigation::AtEvents()}; }), "");
  EXPECT_EQ(fault([](NavigatorDecision& d) { d.motion.end_m = core::kInfinity; }), "");
  EXPECT_EQ(fault([](NavigatorDecision& d) { d.motion.curvature_per_m = -1e3; }), "");
  const double kNaN = core::kNaN;
  const double kInf = core::kInfinity;
  const std::pair<std::function<void(NavigatorDecision&)>, const char*> kWrong[] = {
      {[=](NavigatorDecision& d) { d.motion.curvature_per_m = kNaN; }, "curvature_per_m"},
      {[=](NavigatorDecision& d) { d.motion.curvature_per_m = -kInf; }, "curvature_per_m"},
      {[=](NavigatorDecision& d) { d.motion.curvature_per_m = 1.1e3; }, "curvature_per_m"},
      {[=](NavigatorDecision& d) { d.motion.curvature_rate_per_m2 = kNaN; }, "curvature_rate"},
      {[=](NavigatorDecision& d) { d.motion.curvature_rate_per_m2 = kInf; }, "curvature_rate"},
      {[=](NavigatorDecision& d) { d.motion.direction = 0; }, "direction"},
      {[=](NavigatorDecision& d) { d.motion.direction = -2; }, "direction"},
      {[=](NavigatorDecision& d) { d.motion.speed_share = 0.0; }, "speed_share"},
      {[=](NavigatorDecision& d) { d.motion.speed_share = 1.01; }, "speed_share"},
      {[=](NavigatorDecision& d) { d.motion.speed_share = kNaN; }, "speed_share"},
      {[=](NavigatorDecision& d) { d.motion.end_m = kNaN; }, "end_m"},
      {[=](NavigatorDecision& d) { d.until.period_s = kNaN; }, "period_s"},
      {[=](NavigatorDecision& d) { d.until.distance_m = kNaN; }, "distance_m"},
      {[=](NavigatorDecision& d) { d.until.distance_m = -1.0; }, "distance_m"},
      {[=](NavigatorDecision& d) { d.until.turn_rad = -1.0; }, "turn_rad"},
      {[=](NavigatorDecision& d) { d.until.turn_rad = kNaN; }, "turn_rad"},
      {[=](NavigatorDecision& d) { d.until.near_goal_m = kNaN; }, "near_goal_m"},
      {[=](NavigatorDecision& d) { d.work_ops = -1.0; }, "work_ops"},
      {[=](NavigatorDecision& d) { d.work_ops = kInf; }, "work_ops"},
      {[=](NavigatorDecision& d) { d.work_ops = kNaN; }, "work_ops"}};
  for (const auto& [change, words] : kWrong) {
    EXPECT_THAT(fault(change), IsFault(FaultKind::kNonsense, words));
  }
}

}  // namespace
}  // namespace rockyard::plugin

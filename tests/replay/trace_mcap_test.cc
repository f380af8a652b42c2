// Messages of traces as MCAP, of drives that are made up; trace_mcap.test.mjs reads real ones.
#include "replay/trace_mcap.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "replay/mcap_records.h"

namespace rockyard::replay {
namespace {

using Json = nlohmann::json;
using math::Vector3;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(TraceMcap, FramesOfLinksLieWherePivotsAxesAndJointsPutThem) {
  const std::vector<ReadMessage> messages = Of(SmallDrive(), "/tf");
  ASSERT_THAT(messages, SizeIs(2));
  Vector3 p(1.0, 2.0, 3.0);  // in the frame of the arm
  const Json transforms = messages[1].json()["transforms"];
  const auto into_parent = [&](std::size_t i, const char* child, const char* parent) {
    EXPECT_EQ(transforms[i]["child_frame_id"], child);
    EXPECT_EQ(transforms[i]["parent_frame_id"], parent);
    p = VectorOf(transforms[i]["translation"]) + TurnOf(transforms[i]["rotation"]) * p;
  };
  into_parent(3, "rover/arm", "rover/rocker");
  into_parent(2, "rover/rocker", "rover");
  // About x by 0.6 rad, then about y by 0.3 rad, written out.
  const double c = std::cos(0.6);
  const double s = std::sin(0.6);
  const Vector3 q(0.6, 2.0 * c - 3.0 * s, 0.1 + 2.0 * s + 3.0 * c);
  EXPECT_THAT(p, IsNear(Vector3(0.1 + std::cos(0.3) * q.x() + std::sin(0.3) * q.z(), 0.2 + q.y(),
                                0.3 - std::sin(0.3) * q.x() + std::cos(0.3) * q.z())));
  EXPECT_EQ(transforms[1]["child_frame_id"], "believed_rover");
  EXPECT_THAT(VectorOf(transforms[1]["translation"]), IsNear(Vector3(1.5, 0.5, 1.25)));
}

TEST(TraceMcap, ShapesAreInTheFramesOfTheirLinksFromEndToEnd) {
  ReplayData data = SmallDrive();
  data.links[2].shapes = {{ShapeKind::kCapsule, "hub", {1, 2, 3}, {1, 2, 1}, 0.1, 0.0},
                          {ShapeKind::kWheel, "wheel", {1, 0, 0}, {0, 0, 0}, 0.2, 0.5},
                          {ShapeKind::kBox, "panel", {0, 0, 1}, {3, 2, 1}, 0.0, 0.0},
                          {ShapeKind::kSphere, "hub", {0, 0, 2}, {0, 0, 0}, 0.3, 0.0}};
  const Json entity = EntityOf(data, "/scene/rover");
  EXPECT_EQ(entity["frame_id"], "rover/arm");
  const auto end = [&](std::size_t i) -> Vector3 {
    const Json& rod = entity["cylinders"][i];
    return VectorOf(rod["pose"]["position"]) +
           TurnOf(rod["pose"]["orientation"]) * Vector3(0, 0, 0.5 * Real(rod["size"]["z"]));
  };
  EXPECT_THAT(end(0), IsNear(Vector3(1, 2, 1)));
  EXPECT_THAT(end(1), IsNear(Vector3(1, 0.25, 0)));
  const std::vector<Vector3> balls = PlacesOf(entity["spheres"]);
  EXPECT_THAT(balls, ElementsAre(Vector3(1, 2, 3), Vector3(1, 2, 1), Vector3(0, 0, 2)));
  EXPECT_EQ(VectorOf(entity["cubes"][0]["size"]), Vector3(3, 2, 1));
}

TEST(TraceMcap, WhatTheNavigatorShowsIsASceneAndGridsAsHighAsTheRoverStood) {
  ReplayData data = SmallDrive();
  const messages::Overlay both{{{"path", {{0, 0}, {kNan, 1}, {1, 2}}}, {"tree", {{3, 4}}}},
                               {{"cost", -1, 2, 0.5, 2, 1, {0.25, kNan}}}};
  const messages::Overlay tree{{{"tree", {{5, 6}}}}, {}};
  data.overlays = {{2.5, {}, {}, both}, {3.0, {}, {}, tree}, {3.5, {}, {}, {}}};
  std::vector<std::string> names;
  std::vector<Json> colours;
  for (const ReadMessage& message : Of(data, "/scene/overlay")) {
    const Json update = message.json();
    EXPECT_EQ(update["deletions"][0]["type"], 1);
    names.emplace_back();
    for (const Json& entity : update["entities"]) {
      names.back() += entity["id"].get<std::string>() + " ";
      colours.push_back(entity["lines"][0]["color"]);
    }
  }
  EXPECT_THAT(names, ElementsAre("path tree ", "tree ", ""));
  EXPECT_EQ(colours[1], colours[2]);
  EXPECT_NE(colours[0], colours[1]);
  const Json line = EntityOf(data, "/scene/overlay")["lines"][0];
  EXPECT_THAT(line["points"], SizeIs(2));
  EXPECT_EQ(line["pose"]["position"]["z"], 1.25 + 0.015);
  const Json grid = Of(data, "/overlay/cost").at(0).json();
  EXPECT_EQ(VectorOf(grid["pose"]["position"]), Vector3(-1, 2, 1.25));
  EXPECT_EQ(grid["row_stride"], 8);
  EXPECT_EQ(grid["data"], "AACAPgAAwH8=");  // 0.25 and NaN as floats, little-endian
}

TEST(TraceMcap, WithoutLinesThereIsNoScene) {
  ReplayData data = SmallDrive();
  data.overlays = {{2.5, {}, {}, {{}, {{"cost", 0, 0, 1, 1, 1, {0.5}}}}}};
  EXPECT_THAT(Of(data, "/scene/overlay"), IsEmpty());
  EXPECT_THAT(Of(data, "/overlay/cost"), SizeIs(1));
}

TEST(TraceMcap, MapsTellWhatIsKnownAndWhatHasHeights) {
  ReplayData data = SmallDrive();
  ReplayStep step;
  step.view.looked_behind = true;
  step.view.map = {
      1.0, 2.0, 0.5, 0.25, 2, 1, {{true, 0.5, false, 9, 9}, {false, 7.0, true, 200, 100}}};
  data.steps = {step};
  const Json map = Of(data, "/map").at(0).json();
  EXPECT_EQ(VectorOf(map["pose"]["position"]), Vector3(1, 2, 1));
  EXPECT_EQ(map["cell_size"], Json({{"x", 0.5}, {"y", 0.25}}));
  EXPECT_EQ(map["data"], "AACAvwAAgL8AAAA/AABIQwAAyEIAAMB/");  // -1, -1, 0.5, 200, 100, NaN
  EXPECT_EQ(Of(data, "/votes").at(0).json()["behind"], true);
  EXPECT_THAT(Of(data, "/look"), IsEmpty());
  data.steps[0].points_W = {{1.0, 2.0, 3.0}};
  EXPECT_EQ(Of(data, "/look").at(0).json()["data"], "AACAPwAAAEAAAEBA");
}

TEST(TraceMcap, TroubleIsAWarningAndAnEndElsewhereAnError) {
  const auto levels = [](truth::TrialOutcome outcome) {
    ReplayData data = SmallDrive();
    data.record.outcome = outcome;
    data.events = {{1.0, {}, "scrape", "belly"}, {1.0, {}, "look", ""}, {2.0, {}, "end", "why"}};
    std::vector<int> told;
    for (const ReadMessage& event : Of(data, "/events")) told.push_back(event.json()["level"]);
    return told;
  };
  EXPECT_THAT(levels(truth::TrialOutcome::kGoalReached), ElementsAre(3, 2, 2));
  EXPECT_THAT(levels(truth::TrialOutcome::kTimeLimit), ElementsAre(3, 2, 4));
}

TEST(TraceMcap, NamesAreText) {
  const std::string name = "\"<b>\x1b[31m\n\\'}] \xf0\x9f\x9a\x80";
  ReplayData data = SmallDrive();
  data.links[1].name = name;
  data.events = {{1.0, {}, name, name}};
  EXPECT_EQ(Of(data, "/events").at(0).json()["message"], name);
  EXPECT_EQ(Of(data, "/joints").at(0).json()["joints"][0]["name"], name);
}

TEST(TraceMcap, ADriveThatEndsBeforeItsFirstMomentHasItsScene) {
  ReplayData data = SmallDrive();
  data.poses.clear();
  data.overlays = {{0.0, {}, {}, {{{"path", {{0, 0}}}}, {}}}};
  EXPECT_THAT(Of(data, "/scene/course"), SizeIs(1));
  EXPECT_THAT(Of(data, "/scene/overlay"), SizeIs(1));
  EXPECT_THAT(Of(data, "/tf"), IsEmpty());
}

}  // namespace
}  // namespace rockyard::replay

// Scenes of traces as MCAP, of drives that are made up.
#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "replay/mcap_records.h"

namespace rockyard::replay {
namespace {

using Json = nlohmann::json;
using math::Vector3;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(McapScene, GroundGoalsAndWallsStandOnTheGround) {
  ReplayData data = SmallDrive();
  data.course.goal = {3.0, 1.0};
  data.course.goal_radius_m = 0.25;
  data.course.walls = {{.normal_W = {0, 1, 0}, .offset_m = 1.5},
                       {.normal_W = {1, 0, 0}, .offset_m = 1e4},
                       {.normal_W = {0.6, 0.8, 0}, .offset_m = 1e4}};
  data.course.told_goal = {1.0, 2.0};
  data.ground.z_m = {1, 1, 1, 1, 1.25, 1.5};
  const Json ground = EntityOf(data, "/scene/course", 0)["triangles"][0];
  EXPECT_THAT(ground["points"], SizeIs(6));
  EXPECT_EQ(VectorOf(ground["points"][4]), Vector3(2, 2, 1.25));
  EXPECT_EQ(ground["indices"], Json({0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}));
  const Json goal = EntityOf(data, "/scene/course", 1)["cylinders"];
  EXPECT_THAT(PlacesOf(goal), ElementsAre(Vector3(3, 1, 1.5)));
  EXPECT_EQ(goal[0]["size"]["x"], 0.5);
  const Json told = EntityOf(data, "/scene/course", 2)["cylinders"];
  EXPECT_THAT(PlacesOf(told), ElementsAre(Vector3(1, 2, 1.25)));
  const Json walls = EntityOf(data, "/scene/course", 3)["cubes"];
  ASSERT_THAT(PlacesOf(walls), ElementsAre(IsNear(Vector3(2, 1.5, 1.425))));
  EXPECT_NEAR(walls[0]["size"]["x"], 4.0, 0.5);
}

TEST(McapScene, RocksThatArePushedAreToldAnewAtEachPush) {
  ReplayData data = SmallDrive();
  data.rocks = {{.center_W = {1, 0, 1}, .semi_axes_m = {0.3, 0.2, 0.1}, .yaw_rad = 0.2},
                {.center_W = {2, 0, 1}},
                {.center_W = {3, 0, 1}}};
  data.rock_moves = {{.time_s = 1.0, .rock = 2, .center_W = {3.5, 0, 1}},
                     {.time_s = 2.0, .rock = 1, .center_W = {2.5, 0, 1}}};
  const Json still = EntityOf(data, "/scene/rocks")["spheres"];
  EXPECT_THAT(PlacesOf(still), ElementsAre(Vector3(1, 0, 1)));
  EXPECT_EQ(VectorOf(still[0]["size"]), Vector3(0.6, 0.4, 0.2));
  EXPECT_NEAR(still[0]["pose"]["orientation"]["z"], std::sin(0.1), 1e-12);
  const std::vector<ReadMessage> told = Of(data, "/scene/pushed_rocks");
  ASSERT_THAT(told, SizeIs(3));
  const auto at = [&](std::size_t i) { return PlacesOf(told[i].json()["entities"][0]["spheres"]); };
  EXPECT_THAT(at(0), ElementsAre(Vector3(2, 0, 1), Vector3(3, 0, 1)));
  EXPECT_THAT(at(1), ElementsAre(Vector3(2, 0, 1), Vector3(3.5, 0, 1)));
  EXPECT_THAT(at(2), ElementsAre(Vector3(2.5, 0, 1), Vector3(3.5, 0, 1)));
  EXPECT_EQ(told[2].time_s, 2.0);
}

// The top first: each frustum begins where the one above it ends, as wide as it, and as wide as the
// outline of terrain/rock.h there.
TEST(McapScene, PointedRocksAreStacksOfFrusta) {
  ReplayData data = SmallDrive();
  const double growth = 0.4;
  data.rocks = {{.center_W = {1, 2, 3}, .semi_axes_m = {0.4, 0.2, 0.5}, .cap_growth = growth}};
  const Json entity = EntityOf(data, "/scene/rocks");
  EXPECT_THAT(entity["spheres"], IsEmpty());
  double top_m = 3.5;
  double width_m = 0.0;
  for (const Json& frustum : entity["cylinders"]) {
    const Vector3 size = VectorOf(frustum["size"]);
    const double middle_m = frustum["pose"]["position"]["z"];
    EXPECT_NEAR(middle_m + 0.5 * size.z(), top_m, 1e-12);
    EXPECT_NEAR(Real(frustum["top_scale"]) * size.x(), width_m, 1e-12);
    EXPECT_NEAR(size.y(), 0.5 * size.x(), 1e-12);
    top_m = middle_m - 0.5 * size.z();
    width_m = size.x();
    const double depth = (3.5 - top_m) / 0.5;
    EXPECT_NEAR(width_m, 0.8 * std::sqrt(growth * depth + (1.0 - growth) * depth * depth), 1e-12);
  }
  EXPECT_NEAR(top_m, 3.0, 1e-12);
  EXPECT_NEAR(width_m, 0.8, 1e-12);
}

TEST(McapScene, PathsBreakWhereTheRoverWasSetBack) {
  ReplayData data = SmallDrive();
  data.poses.push_back(MomentAt(2.5, {9.0, 0.0, 1.0}, 0.0));
  data.poses.back().set_back = true;
  data.poses.push_back(MomentAt(3.0, {9.5, 0.0, 1.0}, 0.0));
  for (std::size_t entity = 0; entity < 2; ++entity) {
    const Json lines = EntityOf(data, "/scene/paths", entity)["lines"];
    ASSERT_THAT(lines, SizeIs(2));
    EXPECT_THAT(lines[0]["points"], SizeIs(2));
    EXPECT_EQ(lines[1]["points"][0]["x"], entity == 0 ? 9.0 : 9.5);
    const Json& colour = lines[1]["color"];  // truly blue, believed orange
    EXPECT_EQ(Real(colour["b"]) > Real(colour["r"]), entity == 0);
  }
}

}  // namespace
}  // namespace rockyard::replay

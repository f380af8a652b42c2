// What is wrong with lists of ditches, pits and rocks, by path.
#include "terrain/depression_params.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "core/archive.h"
#include "core/params_text.h"
#include "core/says.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {
namespace {

constexpr auto& Read = core::ReadText<TerrainParams>;
constexpr auto& Problems = core::ProblemsOf<TerrainParams>;

std::string Ditch(const std::string& more) {
  return R"({"ground": {"ditches": {"x_m": [2, 4], "y_m": [0, 0], "direction_deg": [90, 80],
             "length_m": [0, 3], "width_m": [0.5, 0.4], "depth_m": [0.3, 0.1])" +
         more + "}}}";
}

TEST(DepressionParamsTest, ReadsDitchesAndPits) {
  const TerrainParams params = Read(R"({"ground": {
      "ditches": {"x_m": [2], "y_m": [1], "direction_deg": [90], "length_m": [3], "width_m": [0.5],
                  "depth_m": [0.3], "flank_m": [0.1]},
      "pits": {"x_m": [5], "y_m": [6], "diameter_m": [1], "depth_m": [0.2]}}})");
  const auto all = ListDepressions(params.ground.ditches, params.ground.pits);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].half_length_m, 1.25);  // round ends of 0.25 m
  EXPECT_EQ(all[0].half_width_m, 0.25);
  EXPECT_EQ(all[0].flank_m, 0.1);
  EXPECT_NEAR(all[0].direction_rad, std::acos(0.0), 1e-15);
  EXPECT_EQ(all[1].x_m, 5.0);
  EXPECT_EQ(all[1].half_length_m, 0.0);
  EXPECT_EQ(all[1].flank_m, 0.5);
  EXPECT_EQ(all[1].depth_m, 0.2);
  EXPECT_FALSE(params.ground.IsLevel());
}

TEST(DepressionParamsTest, ListsOfOtherLengthsSayWhich) {
  EXPECT_EQ(Problems(Ditch("")), "");
  EXPECT_THAT(Problems(Ditch(R"(, "flank_m": [0.1])")),
              core::Says("ground.ditches.flank_m", "has 1 entries", "has 2"));
  EXPECT_THAT(Problems(R"({"ground": {"pits": {"x_m": [1], "y_m": [1], "diameter_m": [1]}}})"),
              core::Says("ground.pits.depth_m", "has 0 entries"));
}

TEST(DepressionParamsTest, FlanksAndLengthsFitTheWidth) {
  EXPECT_EQ(Problems(Ditch(R"(, "flank_m": [0.25, 0.2])")), "");
  EXPECT_THAT(Problems(Ditch(R"(, "flank_m": [0.25, 0.21])")),
              core::Says("ground.ditches.flank_m[1]", "at most half"));
  EXPECT_THAT(Problems(R"({"ground": {"ditches": {"x_m": [2], "y_m": [0], "direction_deg": [0],
                           "length_m": [0.4], "width_m": [0.5], "depth_m": [0.3]}}})"),
              core::Says("ground.ditches.length_m[0]", "less than the width"));
}

std::string RockAt(const char* x_m) {
  return std::string(R"({"rocks": {"kind": "listed", "listed": {"x_m": [0, )") + x_m +
         R"(], "y_m": [3, 3], "diameter_m": [0.2, 0.2], "height_m": [0.1, 0.1]}},
         "ground": {"ditches": {"x_m": [2], "y_m": [0], "direction_deg": [90], "length_m": [0],
                    "width_m": [1], "depth_m": [0.3], "flank_m": [0.2]}}})";
}

TEST(DepressionParamsTest, ListedRocksStandBesideOrOnTheFloor) {
  for (const char* x_m : {"1.39", "2.61", "2.0", "2.19"}) EXPECT_EQ(Problems(RockAt(x_m)), "");
  for (const char* x_m : {"1.41", "2.59", "2.21", "1.7"}) {
    EXPECT_THAT(Problems(RockAt(x_m)), core::Says("rocks.listed.x_m[1]", "flank")) << x_m;
  }
}

TEST(DepressionParamsTest, PointedRocksStandOnLevelGround) {
  EXPECT_THAT(Problems(R"({"rocks": {"pointedness": 0.5, "burial_mean": 0.3},
                           "ground": {"pits": {"x_m": [9], "y_m": [0], "diameter_m": [1],
                                               "depth_m": [0.2]}}})"),
              core::Says("rocks.pointedness", "no ditches or pits"));
}

}  // namespace
}  // namespace rockyard::terrain

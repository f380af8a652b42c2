#include "terrain/terrain_params.h"

#include <cmath>

#include "core/params_text.h"
#include "core/says.h"
#include "terrain/arena.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

using testing::HasSubstr;

constexpr auto& Problems = core::ProblemsOf<TerrainParams>;

TEST(TerrainParamsTest, EveryArenaAndFieldKindIsValidWithDefaults) {
  for (const char* arena : {"open", "walled", "virtual_unfolded", "virtual_reflected"}) {
    for (const char* rocks : {"none", "moore", "golombek", "uniform_count"}) {
      const std::string json = std::string(R"({"arena": {"kind": ")") + arena +
                               R"("}, "rocks": {"kind": ")" + rocks + R"("}})";
      EXPECT_EQ(Problems(json), "") << json;
    }
  }
}

TEST(TerrainParamsTest, LayoutAreaMatchesTheRectangle) {
  for (const ArenaKind arena : {ArenaKind::kOpen, ArenaKind::kWalled, ArenaKind::kVirtualUnfolded,
                                ArenaKind::kVirtualReflected}) {
    for (const RockFieldKind rocks : {RockFieldKind::kMoore, RockFieldKind::kUniformCount}) {
      TerrainParams params{.rocks = {.kind = rocks}, .arena = {.kind = arena}};
      EXPECT_NEAR(params.LayoutArea(), LayoutBounds(params).Area(), 1e-12);
    }
  }
}

TEST(TerrainParamsTest, PublishedCountsGiveThePublishedDensities) {
  EXPECT_NEAR(ExactCount(5, ArenaKind::kOpen).rocks.RocksPerM2(), 0.28, 0.005);
  EXPECT_NEAR(ExactCount(10, ArenaKind::kOpen).rocks.RocksPerM2(), 0.57, 0.005);
  EXPECT_NEAR(ExactCount(15, ArenaKind::kOpen).rocks.RocksPerM2(), 0.85, 0.005);
}

struct BadInput {
  const char* json;
  const char* path;    // named in the message
  const char* reason;  // part of the message
};

class BadTerrainTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadTerrainTest, IsRejectedWithPathAndReason) {
  const std::string problems = Problems(GetParam().json);
  EXPECT_THAT(problems, HasSubstr(GetParam().path));
  EXPECT_THAT(problems, HasSubstr(GetParam().reason));
}

INSTANTIATE_TEST_SUITE_P(
    Inputs, BadTerrainTest,
    testing::Values(
        BadInput{R"({"rocks": {"k_per_m2": 0.03}})", "rocks.k_per_m2", "k_reference_per_m2"},
        BadInput{R"({"rocks": {"clusters_per_m2": 0.03}})", "rocks.clusters_per_m2",
                 "less than one cluster"},
        BadInput{R"({"rocks": {"clusters_per_m2": 1, "cluster_radius_m": 0.1}})",
                 "rocks.cluster_radius_m", "more rocks into a cluster"},
        BadInput{R"({"rocks": {"cover": 0.41}})", "rocks.cover", "cover_reference"},
        BadInput{R"({"rocks": {"kind": "golombek", "min_diameter_m": 0.02, "cover": 0.001},
                     "arena": {"kind": "walled", "length_m": 200, "width_m": 200}})",
                 "rocks.cover_reference", "million"},
        BadInput{R"({"rocks": {"kind": "listed", "max_diameter_m": 0.4, "listed": {
                     "rest": "golombek", "x_m": [3, 4], "y_m": [1, 1], "diameter_m": [0.5, 0.3],
                     "height_m": [0.2, 0.2]}}})",
                 "rocks.max_diameter_m", "use at most 0.3"},
        BadInput{R"({"rocks": {"kind": "listed", "pointedness": 0.5, "burial_mean": 0.3,
                     "listed": {"x_m": [3], "y_m": [1], "diameter_m": [0.5], "height_m": [0.2],
                     "buried_share": [0.6]}}})",
                 "rocks.listed.buried_share", "more than half"},
        BadInput{R"({"rocks": {"kind": "listed", "listed": {"x_m": [3], "y_m": [1],
                     "diameter_m": [0.5], "height_m": [0.2], "yaw_deg": [1, 2]}}})",
                 "rocks.listed.yaw_deg", "has 2 entries where x_m has 1"},
        BadInput{R"({"rocks": {"min_diameter_m": 0.5, "max_diameter_m": 0.4}})",
                 "rocks.max_diameter_m", "not larger"},
        BadInput{R"({"rocks": {"min_diameter_m": 0.02}, "arena": {"kind": "open",
                     "length_m": 200, "width_m": 200}})",
                 "rocks.min_diameter_m", "more than 50000 rocks"},
        BadInput{R"({"arena": {"kind": "open", "length_m": 1000, "width_m": 1000}})",
                 "rocks.min_diameter_m", "more than 50000 rocks"},
        BadInput{R"({"arena": {"length_m": 1001}})", "arena.length_m", "1000"},
        BadInput{R"({"arena": {"width_m": 1001}})", "arena.width_m", "1000"},
        BadInput{R"({"rocks": {"min_diameter_m": 0.02, "k_per_m2": 1e-6, "k_reference_per_m2": 0.1},
                     "arena": {"kind": "walled", "length_m": 100, "width_m": 100}})",
                 "rocks.k_reference_per_m2", "million"},
        BadInput{R"({"rocks": {"kind": "uniform_count", "count": 100}})", "rocks.count", "quarter"},
        BadInput{R"({"rocks": {"kind": "uniform_count", "count": 1000000000}})", "rocks.count",
                 "10000"},
        BadInput{R"({"rocks": {"kind": "uniform_count", "count_area_width_m": 2.3}})",
                 "rocks.count_area_length_m", "outside the arena"},
        BadInput{R"({"rocks": {"kind": "uniform_count", "overlap": "reject"}})", "rocks.overlap",
                 "exact count"},
        BadInput{R"({"rocks": {"burial_mean": 0.05}})", "rocks.burial_spread", "buried fraction"},
        BadInput{R"({"rocks": {"min_width_ratio": 0.9, "max_width_ratio": 0.8}})",
                 "rocks.max_width_ratio", "smaller"},
        BadInput{R"({"rocks": {"min_height_ratio": 1.3}})", "rocks.max_height_ratio", "smaller"},
        BadInput{R"({"rocks": {"pointedness": 1.0}})", "rocks.pointedness", "0.99"},
        BadInput{R"({"rocks": {"pointedness": 0.5, "burial_mean": 0.45}})", "rocks.burial_spread",
                 "more than half of some rocks"},
        BadInput{R"({"rocks": {"pointedness": 0.01}, "ground": {"slope_deg": 1}})",
                 "rocks.pointedness", "not level"},
        BadInput{R"({"rocks": {"pointedness": 0.01}, "ground": {"roughness_rms_m": 0.01}})",
                 "rocks.pointedness", "not level"},
        BadInput{R"({"rocks": {"pointedness": 0.01, "mobility": "movable"}})", "rocks.pointedness",
                 "movable"},
        BadInput{R"({"arena": {"mirror_margin_m": 1.9}})", "arena.mirror_margin_m", "0.5 m"},
        BadInput{R"({"arena": {"mirror_margin_m": 1.5}})", "arena.mirror_margin_m", "wider"},
        BadInput{R"({"ground": {"slope_deg": 46}})", "ground.slope_deg", "45"},
        BadInput{R"({"ground": {"elevation": {"heights_m": [1]}}})", "ground.elevation.columns",
                 "is 0"},
        BadInput{R"({"ground": {"elevation": {"columns": 4, "heights_m": [0,0,0,0, 0,0,0,0,
                     0,0,0,0, 0,0,0]}}})",
                 "ground.elevation.heights_m", "full rows"},
        BadInput{R"({"ground": {"elevation": {"columns": 4, "heights_m": [0,0,0,0, 0,0,0,0,
                     0,0,0,0]}}})",
                 "ground.elevation.heights_m", "4 x 4"},
        BadInput{R"({"ground": {"elevation": {"columns": 4, "origin_row": 4, "heights_m":
                     [0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,0]}}})",
                 "ground.elevation.origin_row", "beyond the last row"},
        BadInput{R"({"ground": {"elevation": {"columns": 4, "origin_column": 4, "heights_m":
                     [0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,0]}}})",
                 "ground.elevation.origin_column", "beyond the last column"},
        BadInput{R"({"ground": {"pits": {"x_m": [1], "y_m": [1], "diameter_m": [1]}}})",
                 "ground.pits.depth_m", "has 0 entries"},
        BadInput{R"({"ground": {"ditches": {"x_m": [2], "y_m": [0], "direction_deg": [0],
                     "length_m": [0.4], "width_m": [0.5], "depth_m": [0.3]}}})",
                 "ground.ditches.length_m[0]", "less than the width"},
        BadInput{R"({"rocks": {"pointedness": 0.5, "burial_mean": 0.3}, "ground": {"pits":
                     {"x_m": [9], "y_m": [0], "diameter_m": [1], "depth_m": [0.2]}}})",
                 "rocks.pointedness", "no ditches or pits"}));

TEST(TerrainParamsTest, KilometresAreValidWhereTheirRocksAreNotTooMany) {
  EXPECT_EQ(Problems(R"({"arena": {"kind": "open", "length_m": 1000}})"), "");
  EXPECT_EQ(Problems(R"({"arena": {"kind": "walled", "length_m": 1000, "width_m": 1000},
                         "rocks": {"min_diameter_m": 0.5, "max_diameter_m": 2.0}})"),
            "");
  EXPECT_EQ(Problems(R"({"arena": {"length_m": 1000},
                         "rocks": {"kind": "uniform_count", "count": 1000, "count_area_x_m": 0,
                                   "count_area_length_m": 900}})"),
            "");
}

// A level model of 25 x 13 nodes, 1 m apart, with the origin at (4, 6), and what is asked of it.
std::string OnModel(const std::string& ground, const std::string& rest) {
  std::string heights = "0";
  for (int i = 1; i < 25 * 13; ++i) heights += ",0";
  return R"({"ground": {"elevation": {"columns": 25, "origin_column": 4, "origin_row": 6,
             "heights_m": [)" +
         heights + "]}" + ground + "}" + rest + "}";
}

TEST(TerrainParamsTest, AModelHoldsTheArenaWithItsMargin) {
  const std::string open = R"(, "arena": {"kind": "open", "length_m": 12, "width_m": 4)";
  EXPECT_EQ(Problems(OnModel("", open + R"(, "open_margin_m": 2})")), "");
  // Rocks are laid on the margin, too: 2.1 m of it reach to x = -4.1 m.
  EXPECT_THAT(Problems(OnModel("", open + R"(, "open_margin_m": 2.1})")),
              HasSubstr("arena: reaches from (-4.1, -4.1) to (12.1, 4.1) m, beyond the "
                        "elevation model, which has heights from (-4, -6) to (20, 6) m"));
  EXPECT_EQ(Problems(OnModel("", R"(, "arena": {"width_m": 12, "mirror_margin_m": 4})")), "");
  EXPECT_THAT(Problems(OnModel("", R"(, "arena": {"width_m": 12.1, "mirror_margin_m": 4})")),
              HasSubstr("beyond the elevation model"));
  EXPECT_THAT(
      Problems(OnModel("", R"(, "arena": {"kind": "virtual_unfolded", "unfolded_strips": 3})")),
      HasSubstr("beyond the elevation model"));
}

TEST(TerrainParamsTest, RoughnessNestsWithTheCellsOfAModel) {
  for (const char* wavelength_m : {"0.25", "1", "4"}) {
    EXPECT_EQ(
        Problems(OnModel(
            std::string(R"(, "roughness_rms_m": 0.01, "roughness_wavelength_m": )") + wavelength_m,
            "")),
        "");
  }
  EXPECT_THAT(Problems(OnModel(R"(, "roughness_rms_m": 0.01, "roughness_wavelength_m": 1.5)", "")),
              HasSubstr("power of two"));
  // Without roughness its wavelength says nothing.
  EXPECT_EQ(Problems(OnModel(R"(, "roughness_wavelength_m": 1.5)", "")), "");
}

TEST(TerrainParamsTest, PointedRocksNeedLevelGroundAndFixedRocksOnlyWhereTheyStand) {
  EXPECT_EQ(Problems(R"({"rocks": {"pointedness": 0.87}})"), "");
  EXPECT_EQ(Problems(R"({"rocks": {"pointedness": 0.87, "kind": "none", "mobility": "movable"},
                         "ground": {"slope_deg": 10, "roughness_rms_m": 0.01}})"),
            "");
  EXPECT_EQ(Problems(R"({"rocks": {"mobility": "movable"}, "ground": {"slope_deg": 10}})"), "");
}

TEST(TerrainParamsTest, ClustersThatHoldTheirRocksAreValid) {
  // 4.7 % of the ground under rocks: 0.047 m2 a cluster, which fill a quarter of 4 pi (0.123 m)^2.
  EXPECT_EQ(Problems(R"({"rocks": {"clusters_per_m2": 1, "cluster_radius_m": 0.124}})"), "");
  EXPECT_NE(Problems(R"({"rocks": {"clusters_per_m2": 1, "cluster_radius_m": 0.121}})"), "");
  EXPECT_EQ(Problems(R"({"rocks": {"clusters_per_m2": 1, "cluster_radius_m": 0.1,
                                   "overlap": "allow"}})"),
            "");
  EXPECT_EQ(Problems(R"({"rocks": {"kind": "uniform_count", "clusters_per_m2": 0.01}})"), "");
}

TEST(TerrainParamsTest, LawCoverIsThatOfTheLaws) {
  EXPECT_NEAR(PlainMoore(kVikingLander2K).rocks.LawCover(),
              MooreCoveredFraction(kVikingLander2K, 0.1, 1.0), 1e-12);
  const double q = 1.79 + 0.152 / 0.069;
  EXPECT_NEAR(PlainGolombek(0.069).rocks.LawCover(), 0.069 * (std::exp(-0.1 * q) - std::exp(-q)),
              1e-15);
  EXPECT_EQ(ExactCount(5, ArenaKind::kOpen).rocks.LawCover(), 0.0);
}

TEST(TerrainParamsTest, UnusedCountAreaDoesNotHinderMooreFields) {
  EXPECT_EQ(Problems(R"({"arena": {"length_m": 9.7, "x_min_m": -1}})"), "");
}

std::string Ditch(const std::string& more) {
  return R"({"ground": {"ditches": {"x_m": [2, 4], "y_m": [0, 0], "direction_deg": [90, 80],
             "length_m": [0, 3], "width_m": [0.5, 0.4], "depth_m": [0.3, 0.1])" +
         more + "}}}";
}

TEST(DepressionParamsTest, ReadsDitchesAndPits) {
  const TerrainParams params = core::ReadText<TerrainParams>(R"({"ground": {
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
}

TEST(DepressionParamsTest, FlanksAndLengthsFitTheWidth) {
  EXPECT_EQ(Problems(Ditch(R"(, "flank_m": [0.25, 0.2])")), "");
  EXPECT_THAT(Problems(Ditch(R"(, "flank_m": [0.25, 0.21])")),
              core::Says("ground.ditches.flank_m[1]", "at most half"));
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

}  // namespace
}  // namespace rockyard::terrain

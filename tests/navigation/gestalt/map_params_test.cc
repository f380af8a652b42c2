// Names and defaults of table 1, and what a user may not set.
#include "navigation/gestalt/map_params.h"

#include <gmock/gmock.h>

#include "core/params_text.h"
#include "core/refusals.h"
#include "navigation/gestalt/clouds.h"
#include "navigation/gestalt/gestalt_params.h"

namespace rockyard::navigation {
namespace {

constexpr auto& Read = core::ReadText<GestaltMapParams>;
constexpr auto& Problems = core::ProblemsOf<GestaltMapParams>;

// Goldberg 2002, table 1, but for arcs, waypoints and votes.
TEST(GestaltMapParamsTest, DefaultsAreThoseOfTable1) {
  core::ExpectPublished<GestaltMapParams>({
      {"grid.x0_m", "0.0"},
      {"grid.y0_m", "0.0"},
      {"grid.xN_m", "10.0"},
      {"grid.yN_m", "10.0"},
      {"grid.xstep_m", "0.2"},
      {"grid.ystep_m", "0.2"},
      {"max_idles", "2000"},
      {"grid_dist_timeout_m", "3.0"},
      {"tests.step", "true"},
      {"tests.rough", "true"},
      {"tests.pitch", "false"},
      {"tests.border", "true"},
      {"outliers_per_cell", "0"},
      {"eigen_ratio", "2.0"},
      {"min_cell_coverage", "0.5"},
      {"pairs.unknown.goodness", "11"},
      {"pairs.unknown.certainty", "0"},
      {"pairs.unknown_rovers.goodness", "0"},
      {"pairs.unknown_rovers.certainty", "0"},
      {"pairs.border.goodness", "250"},
      {"pairs.border.certainty", "128"},
      {"pairs.step_obst.goodness", "0"},
      {"pairs.step_obst.certainty", "255"},
      {"pairs.pitch_obst.goodness", "0"},
      {"pairs.pitch_obst.certainty", "255"},
      {"pairs.rough_obst.goodness", "0"},
      {"pairs.rough_obst.certainty", "255"},
      {"rover.length_m", "1.04"},
      {"rover.width_m", "0.84"},
      {"rover.obst_height_m", "0.2"},
      {"rover.wheel_radius_m", "0.1"},
      {"rover.max_pitch_deg", "25.0"},
  });
  const GestaltGridParams grid;
  EXPECT_EQ(grid.nx(), 50);  // xelts
  EXPECT_EQ(grid.ny(), 50);  // yelts
}

TEST(GestaltMapParamsTest, RefusesWhatMakesNoMap) {
  using testing::HasSubstr;
  EXPECT_THAT(Problems(R"({"grid": {"xN_m": -1}})"), HasSubstr("less than two cells in x"));
  EXPECT_THAT(Problems(R"({"grid": {"yN_m": 0.3}})"), HasSubstr("less than two cells in y"));
  EXPECT_THAT(Problems(R"({"grid": {"xstep_m": 0.05, "xN_m": 50}})"),
              HasSubstr("more than 40000 cells"));
  EXPECT_THAT(Problems(R"({"grid": {"xstep_m": 0.0}})"), HasSubstr("smallest allowed value"));
  EXPECT_THAT(Problems(R"({"pairs": {"unknown": {"goodness": 256}}})"),
              HasSubstr("largest allowed value"));
  EXPECT_THAT(Problems(R"({"rover": {"width_m": -0.84}})"), HasSubstr("smallest allowed value"));
  EXPECT_THAT(Problems(R"({"max_idles": 0})"), HasSubstr("smallest allowed value"));
  EXPECT_NE(Problems(R"({"failed_fit": "guess"})"), "");
  EXPECT_NE(Problems(R"({"roughness_fraction": 0})"), "");
}

// A map that ends within the vehicle's 1.04 m of the rover.
TEST(GestaltMapParamsTest, RefusesMapsThatEndAtTheVehicle) {
  using testing::HasSubstr;
  const auto too_near = HasSubstr("within a vehicle's length of the rover");
  EXPECT_THAT(Problems(R"({"grid": {"xN_m": 0.4, "yN_m": 0.4}})"), too_near);
  EXPECT_THAT(Problems(R"({"grid": {"yN_m": 2.07}})"), too_near);
  EXPECT_EQ(Problems(R"({"grid": {"xN_m": 2.09, "yN_m": 2.09}})"), "");
  EXPECT_THAT(Problems(R"({"grid_dist_timeout_m": 1.03})"), too_near);
  EXPECT_EQ(Problems(R"({"grid_dist_timeout_m": 1.04})"), "");
  EXPECT_THAT(Problems(R"({"rover": {"width_m": 3}, "grid_dist_timeout_m": 2.9})"), too_near);
}

TEST(GestaltMapParamsTest, PathsBeginWithinTheMap) {
  constexpr auto& problems = core::ProblemsOf<GestaltParams>;
  const auto beyond = testing::HasSubstr("where the map ends or beyond");
  EXPECT_THAT(problems(R"({"plan": {"plan_min_dist_m": 3.0, "plan_max_dist_m": 4}})"), beyond);
  EXPECT_EQ(problems(R"({"plan": {"plan_min_dist_m": 2.9, "plan_max_dist_m": 4}})"), "");
  EXPECT_THAT(problems(R"({"map": {"grid": {"yN_m": 3}}, "plan": {"plan_min_dist_m": 1.6}})"),
              beyond);
}

TEST(GestaltMapParamsTest, RefusesOutliersThatTakeSeconds) {
  using testing::HasSubstr;
  EXPECT_THAT(
      Problems(
          R"({"grid": {"xstep_m": 0.05, "ystep_m": 0.05}, "rover": {"width_m": 3}, "outliers_per_cell": 8})"),
      HasSubstr("2e7 distances"));
  EXPECT_EQ(Problems(R"({"grid": {"xstep_m": 0.1, "ystep_m": 0.1}, "outliers_per_cell": 8})"), "");
}

TEST(GestaltMapParamsTest, CellsCoverTheBounds) {
  EXPECT_EQ(Read(R"({"grid": {"xN_m": 9, "xstep_m": 0.1}})").grid.nx(), 90);
  EXPECT_EQ(Read(R"({"grid": {"xN_m": 9.05, "xstep_m": 0.5}})").grid.nx(), 19);
}

TEST(GestaltMapParamsTest, HeightOfTheFormulas) {
  GestaltMapParams params;
  params.rover.obst_height_m = 0.21;
  params.rover.clearance_m = 0.31;
  params.rover.wheel_radius_m = 0.125;
  EXPECT_EQ(params.HazardHeight_m(), 0.21);
  params.hazard_height = HazardHeight::kClearance;
  EXPECT_EQ(params.HazardHeight_m(), 0.31);
  params.hazard_height = HazardHeight::kWheelDiameter;
  EXPECT_EQ(params.HazardHeight_m(), 0.25);
}

// A patch has every cell that a square of the vehicle's size touches: of 84 cm 5 cells of 20 cm,
// 9 of 10 cm, 3 of 50 cm; of 104 cm 7 of 20 cm.
TEST(GestaltMapParamsTest, PatchesAreNotSmallerThanTheVehicle) {
  GestaltMapParams params;
  EXPECT_EQ(ReachOf(params).x, 2);
  params.grid.xstep_m = 0.1;
  params.grid.ystep_m = 0.5;
  EXPECT_EQ(ReachOf(params).x, 4);
  EXPECT_EQ(ReachOf(params).y, 1);
  params.grid.xstep_m = 0.2;
  params.grid.ystep_m = 0.84;
  params.patch = PatchSize::kLength;
  EXPECT_EQ(ReachOf(params).x, 3);
  params.patch = PatchSize::kWidth;
  EXPECT_EQ(ReachOf(params).y, 0);
}

// The smallest, the largest and the oddest maps that may be set can be evaluated.
TEST(GestaltMapParamsTest, ExtremesWork) {
  for (const char* json :
       {R"({"grid": {"xN_m": 4, "yN_m": 4, "xstep_m": 2, "ystep_m": 2}})",
        R"({"grid": {"xstep_m": 0.05, "ystep_m": 0.05}, "outliers_per_cell": 1})",
        R"({"grid": {"xN_m": 1000, "xstep_m": 2}, "grid_dist_timeout_m": 1000})",
        R"({"min_patch_share": 0, "min_cell_coverage": 0, "eigen_ratio": 1, "max_idles": 1})",
        R"({"outliers_per_cell": 8, "min_patch_share": 0, "min_cell_points": 1})",
        R"({"rover": {"width_m": 3}, "patch": "width", "tests": {"pitch": true}})",
        R"({"grid": {"xN_m": 2.08, "yN_m": 2.08}, "grid_dist_timeout_m": 1.04})"}) {
    const GestaltMapParams params = Read(json);
    GestaltMap map = MapOf(params, PointsOn(kWholeWindow, Level));
    map.MarkObstacle(0.5, 0.5, 0.2);
    const GoodnessGrid& grid = map.Evaluate();
    EXPECT_EQ(grid.cells.size(), static_cast<std::size_t>(params.grid.nx() * params.grid.ny()));
    EXPECT_EQ(map.View().cells.size(), grid.cells.size());
  }
}

}  // namespace
}  // namespace rockyard::navigation

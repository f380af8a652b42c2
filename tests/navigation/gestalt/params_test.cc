// Names and published defaults of the parameters of GESTALT, and what a user may not set.

#include "core/params_text.h"
#include "core/says.h"
#include "drive.h"
#include "math/angles.h"
#include "navigation/gestalt/clouds.h"

namespace rockyard::navigation {
namespace {

using testing::HasSubstr;

constexpr auto& Problems = core::ProblemsOf<GestaltParams>;
constexpr auto& MapProblems = core::ProblemsOf<GestaltMapParams>;
constexpr auto& ReadMap = core::ReadText<GestaltMapParams>;

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
  EXPECT_THAT(MapProblems(R"({"grid": {"xN_m": -1}})"), HasSubstr("less than two cells in x"));
  EXPECT_THAT(MapProblems(R"({"grid": {"yN_m": 0.3}})"), HasSubstr("less than two cells in y"));
  EXPECT_THAT(MapProblems(R"({"grid": {"xstep_m": 0.05, "xN_m": 50}})"),
              HasSubstr("more than 40000 cells"));
  EXPECT_THAT(MapProblems(R"({"grid": {"xstep_m": 0.0}})"), HasSubstr("smallest allowed value"));
  EXPECT_THAT(MapProblems(R"({"pairs": {"unknown": {"goodness": 256}}})"),
              HasSubstr("largest allowed value"));
  EXPECT_THAT(MapProblems(R"({"rover": {"width_m": -0.84}})"), HasSubstr("smallest allowed value"));
  EXPECT_THAT(MapProblems(R"({"max_idles": 0})"), HasSubstr("smallest allowed value"));
  EXPECT_NE(MapProblems(R"({"failed_fit": "guess"})"), "");
  EXPECT_NE(MapProblems(R"({"roughness_fraction": 0})"), "");
}

// A map that ends within the vehicle's 1.04 m of the rover.
TEST(GestaltMapParamsTest, RefusesMapsThatEndAtTheVehicle) {
  const auto too_near = HasSubstr("within a vehicle's length of the rover");
  EXPECT_THAT(MapProblems(R"({"grid": {"xN_m": 0.4, "yN_m": 0.4}})"), too_near);
  EXPECT_THAT(MapProblems(R"({"grid": {"yN_m": 2.07}})"), too_near);
  EXPECT_EQ(MapProblems(R"({"grid": {"xN_m": 2.09, "yN_m": 2.09}})"), "");
  EXPECT_THAT(MapProblems(R"({"grid_dist_timeout_m": 1.03})"), too_near);
  EXPECT_EQ(MapProblems(R"({"grid_dist_timeout_m": 1.04})"), "");
  EXPECT_THAT(MapProblems(R"({"rover": {"width_m": 3}, "grid_dist_timeout_m": 2.9})"), too_near);
}

TEST(GestaltMapParamsTest, PathsBeginWithinTheMap) {
  const auto beyond = HasSubstr("where the map ends or beyond");
  EXPECT_THAT(Problems(R"({"plan": {"plan_min_dist_m": 3.0, "plan_max_dist_m": 4}})"), beyond);
  EXPECT_EQ(Problems(R"({"plan": {"plan_min_dist_m": 2.9, "plan_max_dist_m": 4}})"), "");
  EXPECT_THAT(Problems(R"({"map": {"grid": {"yN_m": 3}}, "plan": {"plan_min_dist_m": 1.6}})"),
              beyond);
}

TEST(GestaltMapParamsTest, RefusesOutliersThatTakeSeconds) {
  EXPECT_THAT(
      MapProblems(
          R"({"grid": {"xstep_m": 0.05, "ystep_m": 0.05}, "rover": {"width_m": 3}, "outliers_per_cell": 8})"),
      HasSubstr("2e7 distances"));
  EXPECT_EQ(MapProblems(R"({"grid": {"xstep_m": 0.1, "ystep_m": 0.1}, "outliers_per_cell": 8})"),
            "");
}

TEST(GestaltMapParamsTest, CellsCoverTheBounds) {
  EXPECT_EQ(ReadMap(R"({"grid": {"xN_m": 9, "xstep_m": 0.1}})").grid.nx(), 90);
  EXPECT_EQ(ReadMap(R"({"grid": {"xN_m": 9.05, "xstep_m": 0.5}})").grid.nx(), 19);
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
    const GestaltMapParams params = ReadMap(json);
    GestaltMap map = MapOf(params, PointsOn(kWholeWindow, Level));
    map.MarkObstacle(0.5, 0.5, 0.2);
    const GoodnessGrid& grid = map.Evaluate();
    EXPECT_EQ(grid.cells.size(), static_cast<std::size_t>(params.grid.nx() * params.grid.ny()));
    EXPECT_EQ(map.View().cells.size(), grid.cells.size());
  }
}

// Goldberg 2002, table 1, but for the map; and the step of section 4.
TEST(GestaltVoteParams, DefaultsAreThoseOfTable1) {
  core::ExpectPublished<GestaltParams>({
      {"arcs.max_curvature_per_m", "2.0"},
      {"arcs.num_forward_arcs", "23"},
      {"arcs.num_backward_arcs", "23"},
      {"arcs.point_turn_amount_deg", "90.0"},
      {"waypoints.tight_curve_fraction", "1.0"},
      {"waypoints.vote_index_variance", "225.0"},
      {"waypoints.waypoint_certainty", "192.0"},
      {"plan.plan_min_dist_m", "0.3"},
      {"plan.plan_max_dist_m", "3.0"},
      {"votes.min_allowed_goodness", "10.0"},
      {"votes.min_fwd_threshold", "180.0"},
      {"votes.min_vote_goodness", "26.0"},
      {"drive.step_m", "0.35"},
      {"drive.rear_cameras", "true"},
  });
}

TEST(GestaltVoteParams, RefuseWhatCannotBeDriven) {
  EXPECT_THAT(Problems(R"({"plan": {"plan_min_dist_m": 3.0}})"),
              HasSubstr("not larger than plan_min_dist_m"));
  EXPECT_THAT(Problems(R"({"arcs": {"num_forward_arcs": 0}})"),
              HasSubstr("smallest allowed value"));
  EXPECT_THAT(Problems(R"({"arcs": {"point_turn_amount_deg": 180}})"),
              HasSubstr("largest allowed value"));
  EXPECT_THAT(Problems(R"({"waypoints": {"vote_index_variance": 0}})"),
              HasSubstr("smallest allowed value"));
  EXPECT_THAT(Problems(R"({"drive": {"step_m": 0}})"), HasSubstr("smallest allowed value"));
  EXPECT_THAT(Problems(R"({"drive": {"step_m": 3.1}})"), HasSubstr("beyond plan.plan_max_dist_m"));
  EXPECT_THAT(Problems(R"({"arcs": {"point_turn_amount_deg": 3.5}})"),
              HasSubstr("ends a search before"));
  EXPECT_EQ(Problems(R"({"arcs": {"point_turn_amount_deg": 3.7}})"), "");
  EXPECT_NE(Problems(R"({"drive": {"point_turns": "often"}})"), "");
  EXPECT_NE(Problems(R"({"votes": {"whole_numbers": 1}})"), "");
}

// The smallest, the largest and the oddest values that may be set lead to an end, too.
TEST(GestaltVoteParams, ExtremesWork) {
  for (const char* json :
       {R"({"arcs": {"num_forward_arcs": 1, "num_backward_arcs": 0}})",
        R"({"arcs": {"num_forward_arcs": 201, "num_backward_arcs": 201},
            "plan": {"plan_max_dist_m": 20, "samples_per_cell": 4},
            "map": {"grid": {"xstep_m": 0.05, "ystep_m": 0.05}}})",
        R"({"arcs": {"max_curvature_per_m": 20, "point_turn_amount_deg": 1},
            "drive": {"max_fruitless_cycles": 360}})",
        R"({"arcs": {"num_forward_arcs": 2, "max_curvature_per_m": 0.01}})",
        R"({"plan": {"plan_min_dist_m": 0, "plan_max_dist_m": 0.05, "path_weight": "inverse"},
            "drive": {"step_m": 0.05}})",
        R"({"plan": {"max_path_turn_deg": 10, "far_weight": 0.001},
            "map": {"grid": {"xstep_m": 2, "ystep_m": 2}}})",
        R"({"votes": {"min_allowed_goodness": 255}})",
        R"({"votes": {"min_vote_goodness": 256, "min_fwd_threshold": 256}})",
        R"({"waypoints": {"waypoint_certainty": 0, "vote_index_variance": 0.01}})",
        R"({"drive": {"min_drive_goodness": 255, "search_turn_deg": 3600}})",
        R"({"drive": {"point_turns": "candidates", "backward_arcs": "always"}})",
        R"({"plan": {"plan_max_dist_m": 5},
            "drive": {"step_m": 5, "progress_m": 10, "step_time_out_s": 1}})"}) {
    SCOPED_TRACE(json);
    GestaltSetup setup;
    setup.params = core::ReadText<GestaltParams>(json);
    setup.params.drive.max_fruitless_cycles = 5;
    setup.goal = {1.5, 1.0};
    GestaltDrive drive(setup);
    EXPECT_NE(drive.Run(50000), NavigatorStatus::kDriving);
  }
}

TEST(GestaltSplineParams, DefaultsAreThoseOfHoward2012) {
  // Section 3: 225 splines of 3 m, knots within +-1 rad/m.
  core::ExpectPublished<GestaltParams>(
      {{"splines.length_m", "3.0"}, {"splines.max_curvature_per_m", "1.0"}});
  const GestaltSplineParams splines;
  EXPECT_EQ(splines.num_first_knots * splines.num_second_knots, 225);
}

// The limit is what steering motors of 20 deg/s (athena_2012.json) keep up with at the tightest
// knots, d delta / dc of a wheel at (0.42, 0.36) m, less a tenth.
TEST(GestaltSplineParams, RateIsThatOfTheSteeringMotors) {
  const GestaltSplineParams splines;
  const double c = splines.max_curvature_per_m;
  const auto angle = [](double curvature) {
    return std::atan2(0.42 * curvature, 1.0 - 0.36 * curvature);
  };
  const double slope_m = (angle(c + 1e-6) - angle(c - 1e-6)) / 2e-6;
  EXPECT_NEAR(splines.max_curvature_rate_per_m_s, 0.9 * (math::DegToRad(20.0) / slope_m), 0.02);
}

// From knot to knot: 2 / m in 14 spaces, over 1.5 m. A single knot has no next one.
TEST(GestaltSplineParams, LeastRateIsThatFromAKnotToTheNext) {
  GestaltSplineParams splines;
  EXPECT_NEAR(splines.LeastRate_per_m2(), 2.0 / 14.0 / 1.5, 1e-15);
  splines.num_first_knots = 2;
  EXPECT_NEAR(splines.LeastRate_per_m2(), 2.0 / 1.5, 1e-15);
  splines.num_first_knots = 1;
  EXPECT_EQ(splines.LeastRate_per_m2(), 0.0);
}

// Path, reason, and what would be right.
TEST(GestaltSplineParams, RefuseWhatCannotBeDriven) {
  EXPECT_THAT(Problems(R"({"splines": {"waypoint_m": 3.1}})"),
              core::Says("splines.waypoint_m", "beyond the end of the splines",
                         "use a smaller waypoint_m or a larger length_m"));
  EXPECT_EQ(Problems(R"({"splines": {"waypoint_m": 3.1, "length_m": 3.1}})"), "");
  EXPECT_THAT(Problems(R"({"speed": {"full_speed_curvature_per_m": 1.0}})"),
              core::Says("speed.slow_curvature_per_m", "not larger than full_speed_curvature_per_m",
                         "use a larger slow_curvature_per_m"));
  EXPECT_EQ(Problems(R"({"speed": {"full_speed_curvature_per_m": 0.99}})"), "");
  EXPECT_THAT(Problems(R"({"speed": {"min_speed_share": 0}})"),
              core::Says("speed.min_speed_share", "smallest allowed value"));
  EXPECT_THAT(Problems(R"({"speed": {"min_speed_share": 1.1}})"),
              HasSubstr("largest allowed value"));
  EXPECT_THAT(Problems(R"({"splines": {"length_m": 0}})"),
              core::Says("splines.length_m", "smallest allowed value"));
  EXPECT_THAT(Problems(R"({"splines": {"num_first_knots": 0}})"),
              HasSubstr("splines.num_first_knots"));
  EXPECT_THAT(Problems(R"({"splines": {"num_second_knots": 52}})"),
              HasSubstr("splines.num_second_knots"));
  EXPECT_THAT(Problems(R"({"splines": {"max_curvature_per_m": 0}})"),
              HasSubstr("splines.max_curvature_per_m"));
  EXPECT_THAT(Problems(R"({"splines": {"max_curvature_rate_per_m_s": 0}})"),
              HasSubstr("splines.max_curvature_rate_per_m_s"));
  EXPECT_THAT(Problems(R"({"splines": {"law": "curvature"}})"),
              core::Says("splines.law", "distance", "time"));
}

}  // namespace
}  // namespace rockyard::navigation

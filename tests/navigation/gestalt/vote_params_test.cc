// Names and defaults of table 1 for arcs, waypoints and votes, and what a user may not set.
#include <gmock/gmock.h>

#include "core/params_text.h"
#include "drive.h"

namespace rockyard::navigation {
namespace {

constexpr auto& Read = core::ReadText<GestaltParams>;
constexpr auto& Problems = core::ProblemsOf<GestaltParams>;

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
  using testing::HasSubstr;
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
    setup.params = Read(json);
    setup.params.drive.max_fruitless_cycles = 5;
    setup.goal = {1.5, 1.0};
    GestaltDrive drive(setup);
    EXPECT_NE(drive.Run(50000), NavigatorStatus::kDriving);
  }
}

}  // namespace
}  // namespace rockyard::navigation

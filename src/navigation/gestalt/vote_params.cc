#include "navigation/gestalt/vote_params.h"

#include "core/sources.h"

namespace rockyard::navigation {

using core::Origin;

namespace {
using core::kGoldbergTable1;
}

void GestaltArcParams::Visit(core::FieldVisitor& v) {
  v.Real("max_curvature_per_m", max_curvature_per_m,
         {.doc = "curvature of the tightest arcs, close to a point turn",
          .min = 0.01,
          .max = 20.0,
          .origin = Origin::kPublished,
          .source = kGoldbergTable1});
  v.Integer("num_forward_arcs", num_forward_arcs,
            {.doc = "forward arcs to evaluate, spaced evenly in curvature",
             .min = 1,
             .max = 201,
             .origin = Origin::kPublished,
             .source = kGoldbergTable1});
  v.Integer("num_backward_arcs", num_backward_arcs,
            {.doc = "backward arcs to evaluate, spaced evenly in curvature",
             .min = 0,
             .max = 201,
             .origin = Origin::kPublished,
             .source = kGoldbergTable1});
  v.Angle("point_turn_amount_deg", point_turn_amount_rad,
          {.doc = "how far to rotate during a point turn",
           .min = 1.0,
           .max = 170.0,
           .origin = Origin::kPublished,
           .source = kGoldbergTable1});
  v.Integer("num_point_turns", num_point_turns,
            {.doc = "point turns to either side that compete with the arcs, spaced evenly up to "
                    "180 deg; 0: that of point_turn_amount_deg alone",
             .min = 0,
             .max = 36,
             .origin = Origin::kAssumed,
             .source = "Howard 2012 sec. 3: \"different angles followed by a straight drive\"; "
                       "Goldberg 2002 table 1 has the one amount",
             .study_low = 0,
             .study_high = 12});
}

void GestaltWaypointParams::Visit(core::FieldVisitor& v) {
  v.Real("tight_curve_fraction", tight_curve_fraction,
         {.doc = "the best arc's curvature between that of the arc through the goal (0) and that "
                 "which faces the goal after one step (1)",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kPublished,
          .source = kGoldbergTable1});
  v.Real("vote_index_variance", vote_index_variance,
         {.doc = "variance of the waypoint votes about the best arc, in squares of the arc index",
          .min = 0.01,
          .max = 1e6,
          .origin = Origin::kPublished,
          .source = kGoldbergTable1});
  v.Real("waypoint_certainty", waypoint_certainty,
         {.doc = "certainty of the waypoint votes, their weight beside the hazard votes",
          .min = 0.0,
          .max = 255.0,
          .origin = Origin::kPublished,
          .source = kGoldbergTable1});
  v.Real("goal_tolerance_m", goal_tolerance_m,
         {.doc = "believed distance to the goal at which the rover stops as arrived",
          .min = 0.01,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = "\"some tolerance band\" (Goldberg 2002 sec. 4): a quarter of the Athena SDM's "
                    "length",
          .study_low = 0.1,
          .study_high = 1.0});
}

void GestaltPlanParams::Visit(core::FieldVisitor& v) {
  v.Real("plan_min_dist_m", plan_min_dist_m,
         {.doc = "paths are judged from this distance on",
          .min = 0.0,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = kGoldbergTable1});
  v.Real("plan_max_dist_m", plan_max_dist_m,
         {.doc = "paths are judged up to this length, or up to the distance to the goal if that is "
                 "less",
          .min = 0.05,
          .max = 20.0,
          .origin = Origin::kPublished,
          .source = kGoldbergTable1});
  v.Require("plan_max_dist_m", plan_max_dist_m > plan_min_dist_m,
            "is not larger than plan_min_dist_m", "use a larger value");
  v.Angle("max_path_turn_deg", max_path_turn_rad,
          {.doc = "arcs are judged no further than where they have turned this much",
           .min = 10.0,
           .max = 36000.0,
           .origin = Origin::kAssumed,
           .source = "as printed, the whole length counts: the tightest default arc turns 344 deg",
           .study_low = 90.0,
           .study_high = 360.0});
  v.Choice("path_weight", path_weight,
           {.doc = "how the weight of a cell falls with its distance along the path",
            .origin = Origin::kAssumed,
            .source = "Goldberg 2002 step 4 says biased to nearby cells, not how"});
  v.Real("far_weight", far_weight,
         {.doc = "weight at plan_max_dist where path_weight is linear; it is 1 at plan_min_dist",
          .min = 0.001,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "the paper names none",
          .study_low = 0.05,
          .study_high = 1.0});
  v.Choice("unknown_cells", unknown_cells,
           {.doc = "what unknown cells do to the hazard vote of a path: they count with their "
                   "pair at full weight, or every cell counts by its certainty",
            .origin = Origin::kAssumed,
            .source = "Goldberg 2002 step 4 weighs by distance, and its step 6 by certainty"});
  v.Integer("samples_per_cell", samples_per_cell,
            {.doc = "places along a path at which the map is read, in a cell's width",
             .min = 1,
             .max = 4,
             .origin = Origin::kSetting});
}

void GestaltVoteParams::Visit(core::FieldVisitor& v) {
  v.Real("min_allowed_goodness", min_allowed_goodness,
         {.doc = "every cell of a path must be better, or its hazard vote is 0",
          .min = 0.0,
          .max = 255.0,
          .origin = Origin::kPublished,
          .source = kGoldbergTable1});
  v.Real("min_fwd_threshold", min_fwd_threshold,
         {.doc = "best forward vote from which only the forward cameras are used",
          .min = 0.0,
          .max = 256.0,
          .origin = Origin::kPublished,
          .source = kGoldbergTable1});
  v.Real("min_vote_goodness", min_vote_goodness,
         {.doc = "where the hazard or the waypoint vote is below, the merged vote is the lower one",
          .min = 0.0,
          .max = 256.0,
          .origin = Origin::kPublished,
          .source = kGoldbergTable1});
  v.Boolean("whole_numbers", whole_numbers,
            {.doc = "votes are rounded to whole numbers, as the 8 bits of a cell; this makes ties",
             .origin = Origin::kAssumed,
             .source = "the rule for multiple peaks has little to do among real numbers"});
}

}  // namespace rockyard::navigation

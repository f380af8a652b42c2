#include "navigation/gestalt/vote_params.h"

#include "core/sources.h"

namespace rockyard::navigation {

using core::Assumed;
using core::kGoldbergTable1;
using core::Published;
using core::Setting;

namespace {}

void GestaltArcParams::Visit(core::FieldVisitor& v) {
  v.Real("max_curvature_per_m", max_curvature_per_m,
         Published("curvature of the tightest arcs, close to a point turn", kGoldbergTable1,
                   {0.01, 20.0}));
  v.Integer(
      "num_forward_arcs", num_forward_arcs,
      Published("forward arcs to evaluate, spaced evenly in curvature", kGoldbergTable1, {1, 201}));
  v.Integer("num_backward_arcs", num_backward_arcs,
            Published("backward arcs to evaluate, spaced evenly in curvature", kGoldbergTable1,
                      {0, 201}));
  v.Angle("point_turn_amount_deg", point_turn_amount_rad,
          Published("how far to rotate during a point turn", kGoldbergTable1, {1.0, 170.0}));
  v.Integer("num_point_turns", num_point_turns,
            Assumed("point turns to either side that compete with the arcs, spaced evenly up to "
                    "180 deg; 0: that of point_turn_amount_deg alone",
                    "Howard 2012 sec. 3: \"different angles followed by a straight drive\"; "
                    "Goldberg 2002 table 1 has the one amount",
                    {0, 36}, {0, 12}));
}

void GestaltWaypointParams::Visit(core::FieldVisitor& v) {
  v.Real("tight_curve_fraction", tight_curve_fraction,
         Published("the best arc's curvature between that of the arc through the goal (0) and that "
                   "which faces the goal after one step (1)",
                   kGoldbergTable1, {0.0, 1.0}));
  v.Real("vote_index_variance", vote_index_variance,
         Published("variance of the waypoint votes about the best arc, in squares of the arc index",
                   kGoldbergTable1, {0.01, 1e6}));
  v.Real("waypoint_certainty", waypoint_certainty,
         Published("certainty of the waypoint votes, their weight beside the hazard votes",
                   kGoldbergTable1, {0.0, 255.0}));
  v.Real("goal_tolerance_m", goal_tolerance_m,
         Assumed(
             "believed distance to the goal at which the rover stops as arrived",
             "\"some tolerance band\" (Goldberg 2002 sec. 4): a quarter of the Athena SDM's length",
             {0.01, 5.0}, {0.1, 1.0}));
}

void GestaltPlanParams::Visit(core::FieldVisitor& v) {
  v.Real("plan_min_dist_m", plan_min_dist_m,
         Published("paths are judged from this distance on", kGoldbergTable1, {0.0, 10.0}));
  v.Real(
      "plan_max_dist_m", plan_max_dist_m,
      Published(
          "paths are judged up to this length, or up to the distance to the goal if that is less",
          kGoldbergTable1, {0.05, 20.0}));
  v.Require("plan_max_dist_m", plan_max_dist_m > plan_min_dist_m,
            "is not larger than plan_min_dist_m", "use a larger value");
  v.Angle("max_path_turn_deg", max_path_turn_rad,
          Assumed("arcs are judged no further than where they have turned this much",
                  "as printed, the whole length counts: the tightest default arc turns 344 deg",
                  {10.0, 36000.0}, {90.0, 360.0}));
  v.Choice("path_weight", path_weight,
           Assumed("how the weight of a cell falls with its distance along the path",
                   "Goldberg 2002 step 4 says biased to nearby cells, not how"));
  v.Real("far_weight", far_weight,
         Assumed("weight at plan_max_dist where path_weight is linear; it is 1 at plan_min_dist",
                 "the paper names none", {0.001, 1.0}, {0.05, 1.0}));
  v.Choice("unknown_cells", unknown_cells,
           Assumed("what unknown cells do to the hazard vote of a path: they count with their pair "
                   "at full weight, or every cell counts by its certainty",
                   "Goldberg 2002 step 4 weighs by distance, and its step 6 by certainty"));
  v.Integer("samples_per_cell", samples_per_cell,
            Setting("places along a path at which the map is read, in a cell's width", {1, 4}));
}

void GestaltVoteParams::Visit(core::FieldVisitor& v) {
  v.Real("min_allowed_goodness", min_allowed_goodness,
         Published("every cell of a path must be better, or its hazard vote is 0", kGoldbergTable1,
                   {0.0, 255.0}));
  v.Real("min_fwd_threshold", min_fwd_threshold,
         Published("best forward vote from which only the forward cameras are used",
                   kGoldbergTable1, {0.0, 256.0}));
  v.Real(
      "min_vote_goodness", min_vote_goodness,
      Published("where the hazard or the waypoint vote is below, the merged vote is the lower one",
                kGoldbergTable1, {0.0, 256.0}));
  v.Boolean("whole_numbers", whole_numbers,
            Assumed("votes are rounded to whole numbers, as the 8 bits of a cell; this makes ties",
                    "the rule for multiple peaks has little to do among real numbers"));
}

}  // namespace rockyard::navigation

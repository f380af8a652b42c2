#include "navigation/gestalt/gestalt_params.h"

#include "core/sources.h"

namespace rockyard::navigation {

using core::Assumed;
using core::Published;
using core::Setting;

void GestaltContinuousParams::Visit(core::FieldVisitor& v) {
  v.Choice("cycle", cycle,
           Setting("whether the rover stops to look (stop_and_look), looks and plans while it "
                   "drives arcs and stands to steer (csod), or drives clothoid splines and stands "
                   "for nothing (csad); the last two need clock.overlap"));
  v.Real("motion_m", motion_m,
         Assumed("length of the motion that is driven of a plan, as measured on board, where no "
                 "later plan replaces it; with csod or csad",
                 "Howard 2012 sec. 2: it \"does not execute the entire path that was selected\", 3 "
                 "m; about a vehicle's length",
                 {0.05, 5.0}, {0.35, 3.0}));
  v.Real("replan_fraction", replan_fraction,
         Assumed("share of motion_m after which the rover looks for its next plan",
                 "Howard 2012 sec. 2: \"once a fraction of the executed motion is complete\"; "
                 "which is not told",
                 {0.01, 1.0}, {0.1, 1.0}));
  v.Choice("plan_start", plan_start,
           Assumed("where a plan that is made on the move begins",
                   "Howard 2012 sec. 2: curvature matches \"at the point where the command is "
                   "executed\", which is ahead of where the rover looked"));
  v.Choice("no_safe_plan", no_safe_plan,
           Assumed("what the rover does on the move where no new plan is safe",
                   "Howard 2012 does not tell; what was seen last says that the way is not safe"));
  v.Choice("late_plan", late_plan,
           Assumed("what the rover does at the end of its motion where the next plan is not ready",
                   "Howard 2012 does not tell; what was seen is still true of a rover that waits"));
}

namespace {

void VisitChoices(GestaltDriveParams& p, core::FieldVisitor& v) {
  v.Real("step_m", p.step_m,
         Published("drive along the chosen arc before looking again, as measured on board",
                   "Goldberg 2002 sec. 4, \"e.g., 35 cm\"", {0.01, 5.0}));
  v.Boolean(
      "rear_cameras", p.rear_cameras,
      Published("look behind too where the best forward vote is below min_fwd_threshold; without "
                "backward arcs this can only show forward ones what they would turn into",
                "Goldberg 2002 sec. 5"));
  v.Choice(
      "backward_arcs", p.backward_arcs,
      Assumed(
          "when a backward arc may be chosen",
          "Goldberg 2002 step 7: the highest vote of all arcs, but backward ones merge to 200 on "
          "seen ground and would win over forward votes that are good enough not to look behind"));
  v.Choice("point_turns", p.point_turns,
           Assumed("when turning in place is chosen over an arc",
                   "below min_vote_goodness an arc is blocked or unseen: a turn shows more"));
  v.Real("point_turn_margin", p.point_turn_margin,
         Assumed("votes by which a turn in place has to be better than every arc where point_turns "
                 "is candidates",
                 "a turn takes time and brings the rover no nearer; Howard 2012 sec. 3 names no "
                 "price of it",
                 {0.0, 255.0}, {0.0, 40.0}));
  v.Real("min_drive_goodness", p.min_drive_goodness,
         Assumed("an arc whose hazard vote is not above is never driven",
                 "as min_allowed_goodness for cells: unknown ground, 11, is the last resort",
                 {0.0, 255.0}, {0.0, 26.0}));
  v.Choice("arrival_check", p.arrival_check,
           Assumed("when the rover asks whether it is at the goal",
                   "Goldberg 2002 sec. 4: \"first checks\" when invoked, between steps"));
}

void VisitEndings(GestaltDriveParams& p, core::FieldVisitor& v) {
  v.Real("step_time_out_s", p.step_time_out_s,
         Assumed("time after which a drive or turn that is not measured as done ends all the same",
                 "twenty times the 15 s of a step (Goldberg 2002 table 2): keeps a rover that "
                 "measures no motion from waiting for ever",
                 {1.0, 1e6}, {60.0, 600.0}));
  v.Angle("search_turn_deg", p.search_turn_rad,
          Assumed("measured turning in place, look by look, after which no more is to be seen",
                  "a full turn shows all there is", {90.0, 3600.0}, {180.0, 720.0}));
  v.Integer("max_fruitless_cycles", p.max_fruitless_cycles,
            Assumed("cycles in a row without progress_m of progress before the rover gives up",
                    "35 m of steps, twice round an obstacle of 5 m; the paper names none",
                    {1, 100000}, {25, 400}));
  v.Real("progress_m", p.progress_m,
         Assumed("gain in the believed distance to the goal that counts as progress",
                 "most of a step", {0.001, 10.0}, {0.1, 0.5}));
  v.Real("time_out_s", p.time_out_s,
         Setting("on-board time after which the rover gives the goal up; 0 is off", {0.0, 1e7}));
}

void VisitFeltHazards(GestaltDriveParams& p, core::FieldVisitor& v) {
  v.Real("back_off_m", p.back_off_m,
         Assumed("after a felt hazard the rover drives back along its arc, up to this far",
                 "a whole step: back to where it last looked", {0.0, 5.0}, {0.1, 0.5}));
  v.Real("felt_radius_m", p.felt_radius_m,
         Assumed("radius of the obstacle that a felt hazard leaves in the map, at the end of the "
                 "vehicle that was driven into it; 0 marks one cell",
                 "a wheel radius: smaller rocks are climbed", {0.0, 5.0}, {0.0, 0.4}));
  v.Real("felt_again_m", p.felt_again_m,
         Assumed("drive after which a hazard that was felt already when the step began counts",
                 "a wheel radius: the rover may have to drive to get rid of a tilt", {0.0, 5.0},
                 {0.05, 0.35}));
  v.Boolean("veto_felt", p.veto_felt,
            Assumed("an arc on which the rover felt a hazard is not chosen again until the rover "
                    "has driven or turned as far as it meant to",
                    "it would end where it ended before; the paper has no rule"));
  v.Integer(
      "max_felt", p.max_felt,
      Assumed("felt hazards in a row without progress_m of progress before the rover gives up",
              "as for the behaviour controller", {1, 1000}, {2, 20}));
}

}  // namespace

void GestaltDriveParams::Visit(core::FieldVisitor& v) {
  VisitChoices(*this, v);
  VisitEndings(*this, v);
  VisitFeltHazards(*this, v);
}

void GestaltParams::Visit(core::FieldVisitor& v) {
  v.Group("map", map, "the local map and the traversability of its cells");
  v.Group("arcs", arcs, "candidate motions");
  v.Group("waypoints", waypoints, "votes for the goal, and arrival");
  v.Group("plan", plan, "how far and how densely paths are judged");
  v.Group("votes", votes, "thresholds of the votes");
  v.Group("drive", drive, "the drive cycle, and what ends it");
  v.Group("continuous", continuous, "looking and planning on the move");
  v.Group("splines", splines, "splines, of a rover that steers while it drives");
  v.Group("speed", speed, "how fast curves are driven by a rover that steers while it drives");
  v.Group("remedies", remedies, "what is done otherwise than the papers do it, off by default");
  v.Require("plan.plan_min_dist_m", plan.plan_min_dist_m < map.Reach_m(),
            "is where the map ends or beyond (half of its grid, or grid_dist_timeout_m): nothing "
            "of any path could be known",
            "use a smaller plan_min_dist_m or a larger map");
  v.Require("drive.step_m", drive.step_m <= plan.plan_max_dist_m,
            "is beyond plan.plan_max_dist_m: the rover would drive blindly past what it judged",
            "use a smaller step_m or a larger plan.plan_max_dist_m");
  const bool on_the_move = continuous.cycle != DriveCycle::kStopAndLook;
  v.Require("continuous.motion_m", !on_the_move || continuous.motion_m <= plan.plan_max_dist_m,
            "is beyond plan.plan_max_dist_m: the rover would drive blindly past what it judged",
            "use a smaller motion_m or a larger plan.plan_max_dist_m");
  v.Require("continuous.motion_m",
            continuous.cycle != DriveCycle::kCsad || continuous.motion_m <= splines.length_m,
            "is beyond the end of the splines (splines.length_m)",
            "use a smaller motion_m or a larger splines.length_m");
  v.Require("remedies.cost_to_go.enabled",
            !remedies.cost_to_go.enabled || map.grid.xstep_m == map.grid.ystep_m,
            "needs cells as long as wide", "make map.grid.xstep_m and ystep_m equal");
  v.Require("drive.max_fruitless_cycles",
            static_cast<double>(drive.max_fruitless_cycles) * arcs.point_turn_amount_rad >=
                drive.search_turn_rad,
            "ends a search before it has turned search_turn_deg: each look is one of "
            "max_fruitless_cycles",
            "use at least search_turn_deg / point_turn_amount_deg cycles");
}

using core::Assumed;
using core::kGoldbergTable1;
using core::Published;
using core::Setting;

namespace {}

void GestaltArcParams::Visit(core::FieldVisitor& v) {
  v.Real("max_curvature_per_m", max_curvature_per_m,
         Published("curvature of the tightest arcs, close to a turn in place", kGoldbergTable1,
                   {0.01, 20.0}));
  v.Integer(
      "num_forward_arcs", num_forward_arcs,
      Published("forward arcs to evaluate, spaced evenly in curvature", kGoldbergTable1, {1, 201}));
  v.Integer("num_backward_arcs", num_backward_arcs,
            Published("backward arcs to evaluate, spaced evenly in curvature", kGoldbergTable1,
                      {0, 201}));
  v.Angle("point_turn_amount_deg", point_turn_amount_rad,
          Published("how far to rotate during a turn in place", kGoldbergTable1, {1.0, 170.0}));
  v.Integer("num_point_turns", num_point_turns,
            Assumed("turns in place to either side that compete with the arcs, spaced evenly up to "
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

using core::Assumed;
using core::Published;

void SpeedLawParams::Visit(core::FieldVisitor& v) {
  v.Real(
      "full_speed_curvature_per_m", full_speed_curvature_per_m,
      Assumed(
          "curvature up to which the rover drives at full speed",
          "Howard 2012 sec. 3: speed \"is reduced only for high-curvature maneuvers\"; half of the "
          "largest knot, where the outer wheels have to be a fifth faster than the rover's centre",
          {0.0, 20.0}, {0.25, 0.9}));
  v.Real("slow_curvature_per_m", slow_curvature_per_m,
         Assumed("curvature from which the rover drives at min_speed_share; between the two the "
                 "share is linear in the curvature",
                 "the largest knot of Howard 2012 sec. 3", {0.001, 20.0}, {1.0, 2.0}));
  v.Require("slow_curvature_per_m", slow_curvature_per_m > full_speed_curvature_per_m,
            "is not larger than full_speed_curvature_per_m, so that there is no curvature between "
            "the two over which the rover could slow down",
            "use a larger slow_curvature_per_m or a smaller full_speed_curvature_per_m");
  v.Real("min_speed_share", min_speed_share,
         Assumed("share of the full speed in the tightest curves; 1 never slows down",
                 "Howard 2012 sec. 3 slows down and does not say by how much; half speed gives the "
                 "steering motors twice the time for the same path",
                 {0.05, 1.0}, {0.25, 1.0}));
}

namespace {

constexpr std::string_view kHowardSection3 = "Howard 2012 sec. 3";

void VisitShape(GestaltSplineParams& p, core::FieldVisitor& v) {
  v.Real("length_m", p.length_m,
         Published("length of a spline; its knots lie after half of it and after all of it",
                   kHowardSection3, {0.1, 20.0}));
  v.Integer(
      "num_first_knots", p.num_first_knots,
      Assumed("curvatures in the middle of a spline, spaced evenly",
              "Howard 2012 sec. 3 has 225 splines, not how many knots each", {1, 51}, {5, 45}));
  v.Integer(
      "num_second_knots", p.num_second_knots,
      Assumed("curvatures at the end of a spline, spaced evenly, for each in the middle",
              "Howard 2012 sec. 3 has 225 splines, not how many knots each", {1, 51}, {5, 45}));
  v.Real("max_curvature_per_m", p.max_curvature_per_m,
         Published("curvature of the tightest knots", kHowardSection3, {0.01, 20.0}));
}

}  // namespace

double GestaltSplineParams::LeastRate_per_m2() const {
  if (num_first_knots < 2) return 0.0;
  const double spacing_per_m = 2.0 * max_curvature_per_m / static_cast<double>(num_first_knots - 1);
  return spacing_per_m / (0.5 * length_m);
}

void GestaltSplineParams::Visit(core::FieldVisitor& v) {
  VisitShape(*this, v);
  v.Real("max_curvature_rate_per_m_s", max_curvature_rate_per_m_s,
         Assumed("change of curvature a second at the commanded speed above which a spline is "
                 "infeasible and never chosen",
                 "steering motors of 20 deg/s turn the wheels of Athena, 0.42 m before and 0.36 m "
                 "beside its centre, by 0.49 / (m s) at 1 / m, and faster in wider curves; less a "
                 "tenth. The study range is that of motors of 2 to 40 deg/s",
                 {0.001, 100.0}, {0.045, 0.9}));
  v.Choice("law", law,
           Assumed("in what the curvature between two knots is linear",
                   "Howard 2012 sec. 2: \"linearly with distance or time\""));
  v.Real("waypoint_m", waypoint_m,
         Assumed("distance along a spline, or that to the goal if it is less, after which its "
                 "heading is compared with the direction of the goal; what it misses that by costs "
                 "as much as of an arc after drive.step_m",
                 "the whole spline", {0.01, 20.0}, {0.35, 3.0}));
  v.Require("waypoint_m", waypoint_m <= length_m,
            "is beyond the end of the splines (length_m): they say nothing of where the rover "
            "would head there",
            "use a smaller waypoint_m or a larger length_m");
}

}  // namespace rockyard::navigation

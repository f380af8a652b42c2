#include "navigation/enav/enav_params.h"

namespace rockyard::navigation {

using core::Assumed;
using core::Published;
using core::Setting;

namespace {

// Read in abstracts and reports of others; the body of the paper was not.
constexpr std::string_view kAbcouwer = "Abcouwer 2020 (arXiv:2011.06022), as others report it";

}  // namespace

void EnavMapParams::Visit(core::FieldVisitor& v) {
  v.Real("height_cell_m", height_cell_m,
         Assumed("side of a cell of the height map, which holds the mean height of its points",
                 "10 cm in ACE's own tests, as others report Otsu 2019; flight's is not published",
                 {0.01, 1.0}, {0.05, 0.2}));
  v.Real("height_side_m", height_side_m,
         Assumed("side of the height map's window, which follows the rover",
                 "reaches beyond the 6 m that paths are long, wherever in it the rover stands",
                 {2.0, 200.0}, {16.0, 30.0}));
  v.Real("stand_lengths", stand_lengths,
         Assumed("unseen cells up to so many rover lengths around the rover's centre take the "
                 "height of the plane on which it stands",
                 "what it sweeps as it turns in place; cameras do not see it, and no paper says "
                 "what stands in for it",
                 {0.0, 5.0}, {0.5, 1.5}));
  v.Real("cost_cell_m", cost_cell_m,
         Assumed("side of a cell of the cost map", "\"coarser\" than the height map", {0.05, 5.0},
                 {0.2, 1.0}));
  v.Real("cost_side_m", cost_side_m,
         Assumed("side of the cost map's window; a goal beyond is reached from its edge, straight "
                 "and over unseen ground",
                 "\"larger\" than the height map", {4.0, 400.0}, {30.0, 100.0}));
  v.Integer("fit_cells", fit_cells,
            Assumed("cells of the cost map to either side whose points a cell's plane is fitted to",
                    "1.5 m, about the rover's body; the window is not published", {0, 10}, {0, 3}));
  v.Integer("min_points", min_points,
            Assumed("points from which a plane is fitted; a cell with fewer is unseen",
                    "three times what a plane needs", {3, 10000}, {3, 100}));
  v.Real("eigen_ratio", eigen_ratio,
         Assumed("middle over smallest eigenvalue of the points' covariance below which a fit has "
                 "failed, so that the cell is not crossed",
                 "that of GESTALT (Goldberg 2002 table 1); the criterion is not published",
                 {1.0, 100.0}, {1.5, 4.0}));
  v.Angle("extreme_tilt_deg", extreme_tilt_rad,
          Assumed("slope of its plane from which a cell is not crossed",
                  "\"extreme tilt\" costs infinitely much; half as much again as ACE allows",
                  {1.0, 80.0}, {16.0, 35.0}));
  v.Real("tilt_weight", tilt_weight,
         Assumed("cost of a metre at extreme_tilt, in times that of a metre of flat ground, beside "
                 "the time",
                 "a weighted sum of tilt, roughness and time; no weight is published", {0.0, 1e4},
                 {0.0, 10.0}));
  v.Real("roughness_weight", roughness_weight,
         Assumed("the same where the mean square distance from the plane is the square of the "
                 "belly's clearance",
                 "as tilt_weight: a third of the clearance, as rms, costs a metre more", {0.0, 1e6},
                 {0.0, 100.0}));
  v.Real("unseen_factor", unseen_factor,
         Assumed("cost of a metre of unseen ground, in times that of flat ground",
                 "finite, and above known flat ground; no value is published", {1.0, 100.0},
                 {1.1, 5.0}));
}

void EnavTreeParams::Visit(core::FieldVisitor& v) {
  v.Integer(
      "num_turns", num_turns,
      Published("turns in place with which paths begin, one of them by 0", kAbcouwer, {1, 360}));
  v.Angle("turn_span_deg", turn_span_rad,
          Assumed("angle over which the turns are spaced evenly; of 360 deg no turn is there twice",
                  "the angles are not published", {0.0, 360.0}, {90.0, 360.0}));
  v.Integer("num_first_arcs", num_first_arcs,
            Published("arcs after each turn, spaced evenly in curvature", kAbcouwer, {1, 101}));
  v.Integer("num_second_arcs", num_second_arcs,
            Published("arcs after each of these; 0: paths have one arc", kAbcouwer, {0, 101}));
  v.Real("arc_m", arc_m, Published("length of an arc", kAbcouwer, {0.1, 20.0}));
  v.Real("max_curvature_per_m", max_curvature_per_m,
         Assumed("curvature of the tightest arcs",
                 "the curvatures are not published; tighter ones would need a second look beside "
                 "the rover, where turns in place lead. Arcs of Ghosh 2018 fig. 6 measure 0.56",
                 {0.01, 20.0}, {0.25, 1.0}));
  v.Real("check_spacing_m", check_spacing_m,
         Published("distance between two poses of an arc that ACE checks", kAbcouwer, {0.01, 5.0}));
  v.Angle("turn_check_deg", turn_check_rad,
          Assumed("angle between two headings of a turn in place that ACE checks; 0: none is",
                  "1,848 arcs of 12 poses are the 22,000 checks that all paths are said to take, "
                  "which leaves none for turns",
                  {0.0, 180.0}, {0.0, 30.0}));
  v.Choice(
      "lengths", lengths,
      Assumed("whether arc_m, check_spacing_m, drive.execute_arc_m and max_curvature_per_m are "
              "this rover's, or those of one with Perseverance's wheelbase, 2.26 m",
              "what is published is Perseverance's"));
}

void EnavContinuousParams::Visit(core::FieldVisitor& v) {
  v.Choice("cycle", cycle,
           Setting("whether the rover stops to look, or looks and plans while it drives arcs "
                   "(csod, which needs clock.overlap)"));
  v.Real("look_fraction", look_fraction,
         Assumed("with csod, share of the motion after which the rover looks for its next plan",
                 "\"thinking while driving\": as early as it can; not published", {0.0, 1.0},
                 {0.0, 0.7}));
}

void EnavDriveParams::Visit(core::FieldVisitor& v) {
  v.Real("execute_arc_m", execute_arc_m,
         Published("drive along the first arc of a path before it plans again", kAbcouwer,
                   {0.02, 20.0}));
  v.Angle("execute_turn_deg", execute_turn_rad,
          Published("part of a turn in place before it plans again", kAbcouwer, {1.0, 360.0}));
  v.Real("map_weight", map_weight,
         Assumed("weight of what the cost map holds along a path, beyond the time, which counts by "
                 "itself",
                 "how samples and time are added is not published", {0.0, 100.0}, {0.1, 10.0}));
  v.Integer("max_checks", max_checks,
            Assumed("checks by ACE in a cycle before it is over",
                    "3 to 4 s a cycle at 10 to 15 ms a check are 200 to 400; the limit is not "
                    "published",
                    {1, 1000000}, {100, 22176}));
  v.Choice("over_budget", over_budget,
           Assumed("what follows where no path has passed by then",
                   "\"stops\" where it finds no path quickly, as others report"));
  v.Real("check_ms", check_ms,
         Published("time of a check on a RAD750 of 266 million instructions a second; the clock "
                   "takes it where clock.compute.operations_per_s is above 0",
                   "10 to 15 ms (Otsu 2019, as others report it); which processor is not told",
                   {0.0, 1e4}, {10.0, 15.0}));
  v.Integer("max_retries", max_retries,
            Assumed("cycles without a path in a row after which the rover gives up",
                    "a whole turn of retry_turn_deg shows all there is; not published", {0, 1000},
                    {0, 24}));
  v.Angle(
      "retry_turn_deg", retry_turn_rad,
      Assumed("turn in place after a cycle without a path, towards the goal's side and then on; "
              "0 looks again as it stands",
              "as far as turns are executed", {0.0, 180.0}, {0.0, 60.0}));
  v.Integer("max_fruitless_cycles", max_fruitless_cycles,
            Assumed("cycles in a row without progress_m of progress before the rover gives up",
                    "60 m of arcs: ten times as far as it plans", {1, 100000}, {20, 200}));
  v.Real("progress_m", progress_m,
         Assumed("gain in the believed distance to the goal that counts as progress",
                 "a quarter of what it drives between two plans", {0.001, 10.0}, {0.1, 1.0}));
  v.Real("felt_radius_m", felt_radius_m,
         Assumed("no path leads the rover's outline nearer to where it felt a hazard",
                 "a wheel radius of a smaller rover; reactions of flight are not published",
                 {0.0, 5.0}, {0.0, 0.4}));
  v.Integer("max_felt", max_felt,
            Assumed("felt hazards without progress after which the rover gives up",
                    "that of GESTALT", {0, 1000}, {1, 20}));
  v.Real("goal_tolerance_m", goal_tolerance_m,
         Assumed("believed distance to the goal at which the rover stops as arrived",
                 "that of GESTALT", {0.01, 5.0}, {0.1, 1.0}));
  v.Real("time_out_s", time_out_s,
         Setting("on-board time after which the rover gives the goal up; 0 is off", {0.0, 1e7}));
}

void EnavParams::Visit(core::FieldVisitor& v) {
  v.Group("ace", ace, "the check of single poses");
  v.Group("map", map, "height map and cost map");
  v.Group("tree", tree, "the paths among which it chooses");
  v.Group("drive", drive, "the drive cycle");
  v.Group("continuous", continuous, "planning on the move");
  v.Require("map.cost_cell_m", map.cost_cell_m >= map.height_cell_m,
            "is smaller than map.height_cell_m", "use a larger one");
}

}  // namespace rockyard::navigation

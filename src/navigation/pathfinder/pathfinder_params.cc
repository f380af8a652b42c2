#include "navigation/pathfinder/pathfinder_params.h"

#include <algorithm>

namespace rockyard::navigation {

using core::Assumed;
using core::Published;
using core::Setting;

void VehicleReactionParams::Visit(core::FieldVisitor& v) {
  v.Real("back_off_m", back_off_m,
         Assumed("measured drive backwards away from a felt hazard",
                 "a rover that touches a rock has to clear it before it turns: about a third of "
                 "its length",
                 {0.01, 2.0}, {0.065, 0.40}));
  v.Angle("turn_deg", turn_rad,
          Assumed("measured turn in place away from the side of the hazard",
                  "turns the front by half a vehicle width at half a vehicle length", {1.0, 170.0},
                  {20.0, 90.0}));
  v.Real("straight_m", straight_m,
         Assumed("straight drive after the turn before steering to the goal again",
                 "half a vehicle length, past the rock: the controller has no memory of it",
                 {0.0, 5.0}, {0.0, 0.65}));
  v.Integer("max_repeats", max_repeats,
            Assumed("reactions in a row without progress_m of progress",
                    "three quarters of a turn's worth of tries", {1, 1000}, {2, 20}));
  v.Real("progress_m", progress_m,
         Assumed("gain in the believed distance to the goal that counts as progress",
                 "half a vehicle width, as for the operator", {0.001, 10.0}, {0.1, 0.5}));
  v.Choice("on_exhausted", on_exhausted,
           Assumed("what follows when max_repeats reactions have brought no progress",
                   "a rover that waits for its operators is safe"));
  v.Real("ignore_m", ignore_m,
         Assumed("measured drive during which felt hazards are ignored where on_exhausted is go_on",
                 "most of a vehicle length", {0.01, 10.0}, {0.2, 1.0}));
}

namespace {

// True if the three groups name every stripe from 0 up exactly once.
bool PartitionsStripes(const PathfinderParams& params) {
  std::vector<std::int64_t> all;
  for (const auto* group : {&params.left_stripes, &params.centre_stripes, &params.right_stripes}) {
    all.insert(all.end(), group->begin(), group->end());
  }
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] != static_cast<std::int64_t>(i)) return false;
  }
  return true;
}

void VisitHazardRules(PathfinderParams& p, core::FieldVisitor& v) {
  v.Integers("left_stripes", p.left_stripes,
             Assumed("stripes whose hazard counts as on the left; 0 is the leftmost",
                     "two of five stripes on either side of the central one", {0, 8}));
  v.Integers(
      "centre_stripes", p.centre_stripes,
      Assumed("stripes whose hazard counts as in the centre", "the stripe straight ahead", {0, 8}));
  v.Integers("right_stripes", p.right_stripes,
             Assumed("stripes whose hazard counts as on the right",
                     "two of five stripes on either side of the central one", {0, 8}));
  v.Require("left_stripes", PartitionsStripes(p),
            "left, centre and right stripes together do not name each stripe from 0 up once",
            "use left [0, 1], centre [2], right [3, 4]");
  v.Choice("turn_direction", p.turn_direction,
           Assumed("whether the side of a turn in place is kept until no hazard is detected",
                   "Matthies 1995 sec. 7 reads as latched: turn until no hazard is detected"));
  v.Choice("both_sides", p.both_sides,
           Assumed("reaction to hazards on the left and on the right in one scan",
                   "Matthies 1995 sec. 7 reads as rule_order: the left rule comes first"));
  v.Choice(
      "right_is_clear", p.right_is_clear,
      Assumed("what lets a centre hazard be passed on the right", "the plain reading of the rule"));
}

void VisitManoeuvres(PathfinderParams& p, core::FieldVisitor& v) {
  v.Real("scan_interval_m", p.scan_interval_m,
         Published("forward motion between hazard scans, as measured on board",
                   "Matthies 1995 sec. 6", {0.01, 10.0}));
  v.Angle("turn_increment_deg", p.turn_increment_rad,
          Assumed("measured turn between scans while turning in place",
                  "about the angle between neighbouring stripes; the paper names none", {1.0, 90.0},
                  {5.0, 30.0}));
  v.Angle("turn_give_up_deg", p.turn_give_up_rad,
          Assumed("measured turn without a clear scan after which the controller gives up",
                  "a controller without memory sees nothing new after a full turn", {90.0, 3600.0},
                  {270.0, 720.0}));
  v.Real("clear_distance_m", p.clear_distance_m,
         Assumed("straight drive after a turn in place before steering to the goal again",
                 "Matthies 1995 sec. 7 names none", {0.0, 5.0}, {0.0, 0.3}));
  v.Real("goal_tolerance_m", p.goal_tolerance_m,
         Assumed("believed distance to the goal at which the rover stops as arrived",
                 "a fraction of the vehicle; the paper names none", {0.01, 5.0}, {0.05, 0.3}));
}

void VisitArcs(PathfinderParams& p, core::FieldVisitor& v) {
  v.Angle("heading_deadband_deg", p.heading_deadband_rad,
          Assumed("bearing to the goal below which the rover drives straight",
                  "finer than the lateral spread at the goal that it causes; the paper names none",
                  {0.0, 45.0}, {2.0, 15.0}));
  v.Real("wide_arc_radius_m", p.wide_arc_radius_m,
         Assumed("turning radius for moderate bearings",
                 "about two vehicle lengths; the paper names no radii", {0.3, 100.0}, {1.0, 3.0}));
  v.Real("tight_arc_radius_m", p.tight_arc_radius_m,
         Assumed("turning radius for large bearings",
                 "about one vehicle length; the paper names no radii", {0.3, 100.0}, {0.5, 1.0}));
  v.Require("tight_arc_radius_m", p.tight_arc_radius_m <= p.wide_arc_radius_m,
            "is larger than wide_arc_radius_m", "use a value up to wide_arc_radius_m");
  v.Angle("tight_arc_bearing_deg", p.tight_arc_bearing_rad,
          Assumed("bearing to the goal above which the tight arc is used",
                  "beyond the width of a rock at a vehicle length; the paper names none",
                  {0.0, 180.0}, {15.0, 60.0}));
  v.Require("tight_arc_bearing_deg", p.tight_arc_bearing_rad >= p.heading_deadband_rad,
            "is smaller than heading_deadband_deg", "use a value from heading_deadband_deg up");
}

void VisitPointTurns(PathfinderParams& p, core::FieldVisitor& v) {
  v.Angle("point_turn_bearing_deg", p.point_turn_bearing_rad,
          Assumed("bearing to the goal above which the rover turns in place towards it; so it does "
                  "where the goal lies inside the tightest turning circle",
                  "Matthies 1995 sec. 7: the rover moves forward while it turns toward the goal; "
                  "only a goal behind it is left",
                  {10.0, 180.0}, {90.0, 180.0}));
  v.Real(
      "point_turn_after_m", p.point_turn_after_m,
      Assumed("drive after an avoided hazard before the rover may turn in place towards the goal",
              "about half a vehicle length; without it a rock beside the goal turns the rover away "
              "and back for ever",
              {0.0, 10.0}, {0.065, 0.65}));
  v.Require("point_turn_bearing_deg", p.point_turn_bearing_rad >= p.tight_arc_bearing_rad,
            "is smaller than tight_arc_bearing_deg", "use a value from tight_arc_bearing_deg up");
}

void VisitExtras(PathfinderParams& p, core::FieldVisitor& v) {
  v.Real("time_out_s", p.time_out_s,
         Setting("on-board time after which the rover gives the goal up; 0 is off", {0.0, 1e6}));
  v.Real(
      "back_off_m", p.back_off_m,
      Setting("drive backwards this far before turning away from hazards on both sides; 0 is off",
              {0.0, 1.0}));
  v.Real("threading_m", p.threading_m,
         Setting("drive straight this far between hazards on both outermost stripes when all inner "
                 "stripes are clear; 0 is off",
                 {0.0, 2.0}));
}

}  // namespace

void PathfinderParams::Visit(core::FieldVisitor& v) {
  VisitHazardRules(*this, v);
  VisitManoeuvres(*this, v);
  VisitArcs(*this, v);
  VisitPointTurns(*this, v);
  VisitExtras(*this, v);
  v.Group("vehicle_reaction", vehicle_reaction, "reaction to hazards that the rover feels");
}

}  // namespace rockyard::navigation

#include "navigation/pathfinder/pathfinder_params.h"

#include <algorithm>

namespace rockyard::navigation {

using core::Origin;

void VehicleReactionParams::Visit(core::FieldVisitor& v) {
  v.Real("back_off_m", back_off_m,
         {.doc = "measured drive backwards away from a felt hazard",
          .min = 0.01,
          .max = 2.0,
          .origin = Origin::kAssumed,
          .source = "a rover that touches a rock has to clear it before it turns: about a third of "
                    "its length",
          .study_low = 0.065,
          .study_high = 0.40});
  v.Angle("turn_deg", turn_rad,
          {.doc = "measured turn in place away from the side of the hazard",
           .min = 1.0,
           .max = 170.0,
           .origin = Origin::kAssumed,
           .source = "turns the front by half a vehicle width at half a vehicle length",
           .study_low = 20.0,
           .study_high = 90.0});
  v.Real("straight_m", straight_m,
         {.doc = "straight drive after the turn before steering to the goal again",
          .min = 0.0,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = "half a vehicle length, past the rock: the controller has no memory of it",
          .study_low = 0.0,
          .study_high = 0.65});
  v.Integer("max_repeats", max_repeats,
            {.doc = "reactions in a row without progress_m of progress",
             .min = 1,
             .max = 1000,
             .origin = Origin::kAssumed,
             .source = "three quarters of a turn's worth of tries",
             .study_low = 2,
             .study_high = 20});
  v.Real("progress_m", progress_m,
         {.doc = "gain in the believed distance to the goal that counts as progress",
          .min = 0.001,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "half a vehicle width, as for the operator",
          .study_low = 0.1,
          .study_high = 0.5});
  v.Choice("on_exhausted", on_exhausted,
           {.doc = "what follows when max_repeats reactions have brought no progress",
            .origin = Origin::kAssumed,
            .source = "a rover that waits for its operators is safe"});
  v.Real("ignore_m", ignore_m,
         {.doc = "measured drive during which felt hazards are ignored where on_exhausted is go_on",
          .min = 0.01,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "most of a vehicle length",
          .study_low = 0.2,
          .study_high = 1.0});
}

namespace {

using core::Origin;

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
             {.doc = "stripes whose hazard counts as on the left; 0 is the leftmost",
              .min = 0,
              .max = 8,
              .origin = Origin::kAssumed,
              .source = "two of five stripes on either side of the central one"});
  v.Integers("centre_stripes", p.centre_stripes,
             {.doc = "stripes whose hazard counts as in the centre",
              .min = 0,
              .max = 8,
              .origin = Origin::kAssumed,
              .source = "the stripe straight ahead"});
  v.Integers("right_stripes", p.right_stripes,
             {.doc = "stripes whose hazard counts as on the right",
              .min = 0,
              .max = 8,
              .origin = Origin::kAssumed,
              .source = "two of five stripes on either side of the central one"});
  v.Require("left_stripes", PartitionsStripes(p),
            "left, centre and right stripes together do not name each stripe from 0 up once",
            "use left [0, 1], centre [2], right [3, 4]");
  v.Choice("turn_direction", p.turn_direction,
           {.doc = "whether the side of a turn in place is kept until no hazard is detected",
            .origin = Origin::kAssumed,
            .source = "Matthies 1995 sec. 7 reads as latched: turn until no hazard is detected"});
  v.Choice("both_sides", p.both_sides,
           {.doc = "reaction to hazards on the left and on the right in one scan",
            .origin = Origin::kAssumed,
            .source = "Matthies 1995 sec. 7 reads as rule_order: the left rule comes first"});
  v.Choice("right_is_clear", p.right_is_clear,
           {.doc = "what lets a centre hazard be passed on the right",
            .origin = Origin::kAssumed,
            .source = "the plain reading of the rule"});
}

void VisitManoeuvres(PathfinderParams& p, core::FieldVisitor& v) {
  v.Real("scan_interval_m", p.scan_interval_m,
         {.doc = "forward motion between hazard scans, as measured on board",
          .min = 0.01,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 6"});
  v.Angle("turn_increment_deg", p.turn_increment_rad,
          {.doc = "measured turn between scans while turning in place",
           .min = 1.0,
           .max = 90.0,
           .origin = Origin::kAssumed,
           .source = "about the angle between neighbouring stripes; the paper names none",
           .study_low = 5.0,
           .study_high = 30.0});
  v.Angle("turn_give_up_deg", p.turn_give_up_rad,
          {.doc = "measured turn without a clear scan after which the controller gives up",
           .min = 90.0,
           .max = 3600.0,
           .origin = Origin::kAssumed,
           .source = "a controller without memory sees nothing new after a full turn",
           .study_low = 270.0,
           .study_high = 720.0});
  v.Real("clear_distance_m", p.clear_distance_m,
         {.doc = "straight drive after a turn in place before steering to the goal again",
          .min = 0.0,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = "Matthies 1995 sec. 7 names none",
          .study_low = 0.0,
          .study_high = 0.3});
  v.Real("goal_tolerance_m", p.goal_tolerance_m,
         {.doc = "believed distance to the goal at which the rover stops as arrived",
          .min = 0.01,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = "a fraction of the vehicle; the paper names none",
          .study_low = 0.05,
          .study_high = 0.3});
}

void VisitArcs(PathfinderParams& p, core::FieldVisitor& v) {
  v.Angle(
      "heading_deadband_deg", p.heading_deadband_rad,
      {.doc = "bearing to the goal below which the rover drives straight",
       .min = 0.0,
       .max = 45.0,
       .origin = Origin::kAssumed,
       .source = "finer than the lateral spread at the goal that it causes; the paper names none",
       .study_low = 2.0,
       .study_high = 15.0});
  v.Real("wide_arc_radius_m", p.wide_arc_radius_m,
         {.doc = "turning radius for moderate bearings",
          .min = 0.3,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "about two vehicle lengths; the paper names no radii",
          .study_low = 1.0,
          .study_high = 3.0});
  v.Real("tight_arc_radius_m", p.tight_arc_radius_m,
         {.doc = "turning radius for large bearings",
          .min = 0.3,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "about one vehicle length; the paper names no radii",
          .study_low = 0.5,
          .study_high = 1.0});
  v.Require("tight_arc_radius_m", p.tight_arc_radius_m <= p.wide_arc_radius_m,
            "is larger than wide_arc_radius_m", "use a value up to wide_arc_radius_m");
  v.Angle("tight_arc_bearing_deg", p.tight_arc_bearing_rad,
          {.doc = "bearing to the goal above which the tight arc is used",
           .min = 0.0,
           .max = 180.0,
           .origin = Origin::kAssumed,
           .source = "beyond the width of a rock at a vehicle length; the paper names none",
           .study_low = 15.0,
           .study_high = 60.0});
  v.Require("tight_arc_bearing_deg", p.tight_arc_bearing_rad >= p.heading_deadband_rad,
            "is smaller than heading_deadband_deg", "use a value from heading_deadband_deg up");
}

void VisitPointTurns(PathfinderParams& p, core::FieldVisitor& v) {
  v.Angle("point_turn_bearing_deg", p.point_turn_bearing_rad,
          {.doc = "bearing to the goal above which the rover turns in place towards it; so it does "
                  "where the goal lies inside the tightest turning circle",
           .min = 10.0,
           .max = 180.0,
           .origin = Origin::kAssumed,
           .source = "Matthies 1995 sec. 7: the rover moves forward while it turns toward the "
                     "goal; only a goal behind it is left",
           .study_low = 90.0,
           .study_high = 180.0});
  v.Real(
      "point_turn_after_m", p.point_turn_after_m,
      {.doc = "drive after an avoided hazard before the rover may turn in place towards the goal",
       .min = 0.0,
       .max = 10.0,
       .origin = Origin::kAssumed,
       .source = "about half a vehicle length; without it a rock beside the goal turns the rover "
                 "away and back for ever",
       .study_low = 0.065,
       .study_high = 0.65});
  v.Require("point_turn_bearing_deg", p.point_turn_bearing_rad >= p.tight_arc_bearing_rad,
            "is smaller than tight_arc_bearing_deg", "use a value from tight_arc_bearing_deg up");
}

void VisitExtras(PathfinderParams& p, core::FieldVisitor& v) {
  v.Real("time_out_s", p.time_out_s,
         {.doc = "on-board time after which the rover gives the goal up; 0 is off",
          .min = 0.0,
          .max = 1e6,
          .origin = Origin::kSetting});
  v.Real("back_off_m", p.back_off_m,
         {.doc = "drive backwards this far before turning away from hazards on both sides; 0 is "
                 "off",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kSetting});
  v.Real("threading_m", p.threading_m,
         {.doc = "drive straight this far between hazards on both outermost stripes when all inner "
                 "stripes are clear; 0 is off",
          .min = 0.0,
          .max = 2.0,
          .origin = Origin::kSetting});
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

// What one drive trial leaves behind: every number that reports and comparisons use. The observer
// of a drive fills it, and experiments that drive make their records of it.
//
// Must stay: the names and the order of kDriveColumns. Stores, metrics and baselines know the
// values by these names, and hashes go over their bits in this order. So columns are appended,
// never moved or renamed, and a new one changes the hash of every drive.
#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "truth/record.h"

namespace rockyard::truth {

// The values of one drive. Must stay: doubles only, each with one column of kDriveColumns, which
// says what it means; a test counts the members by the size of the struct.
struct DriveRecord {
  double true_distance_m = 0.0;
  double dead_reckoned_distance_m = 0.0;
  double straight_distance_m = 0.0;  // start to goal
  double final_x_m = 0.0;            // true, unfolded where the arena folds
  double final_y_m = 0.0;
  double final_heading_rad = 0.0;
  double believed_x_m = 0.0;
  double believed_y_m = 0.0;
  double believed_heading_rad = 0.0;
  double distance_error_percent = 0.0;  // 100 (dead-reckoned - true) / true
  double heading_error_deg = 0.0;       // |believed - true|
  double position_error_m = 0.0;        // |believed - true| position
  double true_goal_distance_m = 0.0;    // true final position to goal
  double sim_time_s = 0.0;
  double drive_time_s = 0.0;
  double turn_time_s = 0.0;
  double scan_time_s = 0.0;
  double energy_wh = 0.0;
  double scans = 0.0;
  double rescans = 0.0;
  double hazards_believed = 0.0;
  double turns_in_place = 0.0;
  double turned_in_place_rad = 0.0;
  double scrapes = 0.0;  // scrape episodes: hub, belly, rocker or panel against a rock
  double reflections = 0.0;
  double max_tilt_deg = 0.0;
  double max_bogie_deg = 0.0;
  double min_clearance_m = 0.0;
  double layout = 0.0;                // index of the rock field; trials may share one
  double rocks = 0.0;                 // in the field
  double rock_cover = 0.0;            // covered fraction of the field's area
  double scrape_heading_rad = 0.0;    // sum of the injected scrape jumps
  double net_rate_m_s = 0.0;          // true distance over simulated time
  double single_scan_rate_m_s = 0.0;  // the same without the time of rescans
  double scan_energy_wh = 0.0;
  double hazards_met = 0.0;  // rocks of hazard_height_m or more within reach of the array
  // Rocks met and driven onto, with no hazard (of whatever rock) believed while within reach.
  double hazards_missed = 0.0;
  double contact_hazards = 0.0;  // times that the rover felt a hazard of that kind appear
  double tilt_hazards = 0.0;
  double articulation_hazards = 0.0;
  double current_hazards = 0.0;
  double moves = 0.0;            // motion commands between looks or other commands
  double point_turns = 0.0;      // moves that are turns in place
  double image_sets = 0.0;       // pairs of stereo images
  double rear_image_sets = 0.0;  // pairs from rear cameras
  double safeguard_stops = 0.0;  // times that there came to be a felt hazard to get away from
  double imaging_time_s = 0.0;   // taking stereo images
  double compute_time_s = 0.0;   // stereo, map and votes
  double imaging_energy_wh = 0.0;
  double compute_energy_wh = 0.0;
  double steer_time_s = 0.0;          // wheels steering at rest
  double move_overhead_time_s = 0.0;  // at rest about moves
  // From the verdict of being stuck until the batteries are empty. It counts in sim_time_s and
  // energy_wh only where the rover runs on (referee.stuck_rover).
  double stall_time_s = 0.0;
  double active_time_s = 0.0;     // simulated time up to the verdict, whatever a stuck rover does
  double active_energy_wh = 0.0;  // energy up to the verdict
  double reversals = 0.0;         // arcs driven the other way than the last arc before
  double height_error_m = 0.0;    // believed - true height above the start, where there is a map
  double move_time_s = 0.0;       // driving, turning in place, steering, and at rest about moves
  double told_goal_x_m = 0.0;     // the designated goal
  double told_goal_y_m = 0.0;
  double designation_error_m = 0.0;       // designated goal to true goal
  double believed_goal_distance_m = 0.0;  // believed final position to the goal as last believed
  // True path over displacement_m where arrival was declared; else NaN.
  double path_ratio = std::numeric_limits<double>::quiet_NaN();
  double stops = 0.0;  // times that the rover came to rest
  double max_rocker_deg = 0.0;
  double max_roll_deg = 0.0;  // absolute, as max_pitch_deg
  double max_pitch_deg = 0.0;
  double first_scrape_distance_m = 0.0;  // true path up to the first scrape, or all of it
  double stall_energy_wh = 0.0;          // drawn in stall_time_s
  double stuck_noticed = 0.0;            // times that the rover noticed that it is stuck
  double max_sinkage_m = 0.0;            // deepest that a wheel went below the ground
  double beyond_soil_law = 0.0;          // 1: deeper than the sinkage law holds, D / 6
  double unconverged_balances = 0.0;     // quasi_static: balances that missed their tolerance
  // The most between two progresses towards the goal (trial/referee/referee.h), or after the last
  // progress.
  double no_progress_distance_m = 0.0;  // driven, true
  double no_progress_turn_deg = 0.0;    // turned in place, true
  // Slopes of squared errors against the true distance along the run
  // (trial/counters/drive_counters.h).
  double heading_growth_deg2_per_m = 0.0;
  double distance_growth_m2_per_m = 0.0;
  double hazards_begun = 0.0;      // hazards believed after a scan without one
  double displacement_m = 0.0;     // start to end, true and straight
  double waypoints_reached = 0.0;  // declared, before the goal
  // What the rover believes of its own error at the end; NaN where it keeps no account of it.
  double believed_position_sd_m = std::numeric_limits<double>::quiet_NaN();
  double believed_heading_sd_deg = std::numeric_limits<double>::quiet_NaN();
  double pose_nees = std::numeric_limits<double>::quiet_NaN();
  double inside_95 = std::numeric_limits<double>::quiet_NaN();
  double aids_used = 0.0;
  double aids_in_doubt = 0.0;
  double aids_gated_out = 0.0;
  double aids_unanswered = 0.0;
  double visual_steps = 0.0;     // pairs of images compared with a keyframe
  double visual_failures = 0.0;  // visual steps without a motion
  double visual_keyframes = 0.0;
  double visual_gated_out = 0.0;
  double slip_alarms = 0.0;
  double false_slip_alarms = 0.0;
  double largest_slip = std::numeric_limits<double>::quiet_NaN();  // as seen
  double first_slip_alarm_m = std::numeric_limits<double>::quiet_NaN();
  double slip_onset_m = std::numeric_limits<double>::quiet_NaN();
  double goal_rock_found = std::numeric_limits<double>::quiet_NaN();  // NaN without a goal rock
  double goal_rock_distance_m = std::numeric_limits<double>::quiet_NaN();
  double goal_rock_sign = std::numeric_limits<double>::quiet_NaN();
  double goal_rock_recognized = std::numeric_limits<double>::quiet_NaN();
  double search_places_reached = std::numeric_limits<double>::quiet_NaN();
  double steer_turned_rad = 0.0;      // by a steering motor, to and fro alike: mean over motors
  double steer_turned_max_rad = 0.0;  // by the motor that turned most
  // The way between the places of visual odometry, as believed when each was ready.
  double visual_distance_m = std::numeric_limits<double>::quiet_NaN();
  double plans_on_the_move = 0.0;
  double unsafe_plans = 0.0;  // plans on the move that found no safe motion
  double late_plans = 0.0;    // motions that ended before the next plan was ready
  // Root mean square of the way from where a plan was to begin to where it began, as believed.
  double plan_start_error_m = std::numeric_limits<double>::quiet_NaN();
};

// One column of the record of a drive: the only place that says what the value means.
struct DriveColumn {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  double DriveRecord::*member;
  bool may_lack = false;  // may be NaN, where there is nothing to tell; else NaN is a fault
};

inline constexpr std::array kDriveColumns = {
    DriveColumn{"true_distance_m", "m", "true path length", &DriveRecord::true_distance_m},
    DriveColumn{"dead_reckoned_distance_m", "m", "odometer of the rover",
                &DriveRecord::dead_reckoned_distance_m},
    DriveColumn{"straight_distance_m", "m", "start to goal", &DriveRecord::straight_distance_m},
    DriveColumn{"final_x_m", "m", "true final x", &DriveRecord::final_x_m},
    DriveColumn{"final_y_m", "m", "true final y", &DriveRecord::final_y_m},
    DriveColumn{"final_heading_rad", "rad", "true final heading", &DriveRecord::final_heading_rad},
    DriveColumn{"believed_x_m", "m", "believed final x, in the frame in which goals are told",
                &DriveRecord::believed_x_m},
    DriveColumn{"believed_y_m", "m", "the same of y", &DriveRecord::believed_y_m},
    DriveColumn{"believed_heading_rad", "rad", "the same of its heading",
                &DriveRecord::believed_heading_rad},
    DriveColumn{"distance_error_percent", "%", "100 (dead-reckoned - true) / true distance",
                &DriveRecord::distance_error_percent},
    DriveColumn{"heading_error_deg", "deg", "absolute final heading error",
                &DriveRecord::heading_error_deg},
    DriveColumn{"position_error_m", "m", "distance from believed to true final position",
                &DriveRecord::position_error_m},
    DriveColumn{"true_goal_distance_m", "m", "true final position to goal",
                &DriveRecord::true_goal_distance_m},
    DriveColumn{"sim_time_s", "s", "simulated time", &DriveRecord::sim_time_s},
    DriveColumn{"drive_time_s", "s", "simulated time driving", &DriveRecord::drive_time_s},
    DriveColumn{"turn_time_s", "s", "simulated time turning in place", &DriveRecord::turn_time_s},
    DriveColumn{"scan_time_s", "s", "simulated time scanning", &DriveRecord::scan_time_s},
    DriveColumn{"energy_wh", "Wh", "energy drawn", &DriveRecord::energy_wh},
    DriveColumn{"scans", "1", "hazard scans", &DriveRecord::scans},
    DriveColumn{"rescans", "1", "second and later scans at one pose", &DriveRecord::rescans},
    DriveColumn{"hazards_believed", "1",
                "scans whose hazard was believed; 0 with a navigator that reports no hazards (a "
                "map)",
                &DriveRecord::hazards_believed},
    DriveColumn{"turns_in_place", "1",
                "turns in place, each until a motion of another kind or the other way round; a "
                "look does not end one",
                &DriveRecord::turns_in_place},
    DriveColumn{"turned_in_place_rad", "rad", "total true rotation of turns in place",
                &DriveRecord::turned_in_place_rad},
    DriveColumn{"scrapes", "1", "episodes of body contact with a rock", &DriveRecord::scrapes},
    DriveColumn{"reflections", "1", "reflections at the mirror lines of the virtual arena",
                &DriveRecord::reflections},
    DriveColumn{"max_tilt_deg", "deg", "largest chassis tilt", &DriveRecord::max_tilt_deg},
    DriveColumn{"max_bogie_deg", "deg", "largest bogie angle", &DriveRecord::max_bogie_deg},
    DriveColumn{"min_clearance_m", "m", "smallest belly clearance over rock",
                &DriveRecord::min_clearance_m},
    DriveColumn{"layout", "1", "index of the rock field", &DriveRecord::layout},
    DriveColumn{"rocks", "1", "rocks in the field", &DriveRecord::rocks},
    DriveColumn{"rock_cover", "1", "covered fraction of the field", &DriveRecord::rock_cover},
    DriveColumn{"scrape_heading_rad", "rad", "sum of heading jumps from scrapes",
                &DriveRecord::scrape_heading_rad},
    DriveColumn{"net_rate_m_s", "m/s", "true distance over simulated time",
                &DriveRecord::net_rate_m_s},
    DriveColumn{"single_scan_rate_m_s", "m/s", "the same without the time of rescans",
                &DriveRecord::single_scan_rate_m_s},
    DriveColumn{"scan_energy_wh", "Wh", "energy of hazard scans", &DriveRecord::scan_energy_wh},
    DriveColumn{"hazards_met", "1",
                "high rocks that came within reach of the hazard array; 0 with a navigator that "
                "reports no hazards (a map)",
                &DriveRecord::hazards_met},
    DriveColumn{"hazards_missed", "1",
                "of these, driven onto with no hazard believed, of any rock, while within reach; 0 "
                "with a navigator that reports no hazards (a map)",
                &DriveRecord::hazards_missed},
    DriveColumn{"contact_hazards", "1", "touches felt by contact switches",
                &DriveRecord::contact_hazards},
    DriveColumn{"tilt_hazards", "1", "excessive tilts felt", &DriveRecord::tilt_hazards},
    DriveColumn{"articulation_hazards", "1", "excessive joint angles felt",
                &DriveRecord::articulation_hazards},
    DriveColumn{"current_hazards", "1", "excessive motor currents felt",
                &DriveRecord::current_hazards},
    DriveColumn{"moves", "1", "motion commands, each until another one or a look",
                &DriveRecord::moves},
    DriveColumn{"point_turns", "1",
                "of these, turns in place; a turn that goes on after a look counts again, unlike "
                "in turns_in_place",
                &DriveRecord::point_turns},
    DriveColumn{"image_sets", "1", "pairs of stereo images", &DriveRecord::image_sets},
    DriveColumn{"rear_image_sets", "1", "of these, from rear cameras",
                &DriveRecord::rear_image_sets},
    DriveColumn{"safeguard_stops", "1",
                "times that there came to be a felt hazard to get away from",
                &DriveRecord::safeguard_stops},
    DriveColumn{"imaging_time_s", "s", "simulated time taking stereo images",
                &DriveRecord::imaging_time_s},
    DriveColumn{"compute_time_s", "s", "simulated time computing stereo, map and votes",
                &DriveRecord::compute_time_s},
    DriveColumn{"imaging_energy_wh", "Wh", "energy of stereo images",
                &DriveRecord::imaging_energy_wh},
    DriveColumn{"compute_energy_wh", "Wh", "energy of computing stereo, map and votes",
                &DriveRecord::compute_energy_wh},
    DriveColumn{"steer_time_s", "s", "simulated time steering wheels at rest",
                &DriveRecord::steer_time_s},
    DriveColumn{"move_overhead_time_s", "s",
                "simulated time at rest about moves (clock.compute.move_overhead_s)",
                &DriveRecord::move_overhead_time_s},
    DriveColumn{"stall_time_s", "s",
                "from the verdict on a rover found stuck until its batteries are empty, in closed "
                "form; 0 where a trial ends otherwise or batteries are never empty. Counts in "
                "sim_time_s only where referee.stuck_rover is run_on",
                &DriveRecord::stall_time_s},
    DriveColumn{"active_time_s", "s",
                "simulated time up to the verdict; sim_time_s, unless a stuck rover runs on "
                "(referee.stuck_rover)",
                &DriveRecord::active_time_s},
    DriveColumn{"active_energy_wh", "Wh",
                "energy drawn up to the verdict; energy_wh, unless a stuck rover runs on",
                &DriveRecord::active_energy_wh},
    DriveColumn{"reversals", "1",
                "arcs driven the other way, forward or backward, than the last arc before, looks "
                "and turns in place between them or not; backing off counts",
                &DriveRecord::reversals},
    DriveColumn{"height_error_m", "m",
                "believed less true height above the start, at the end; 0 with a navigator that "
                "keeps no map and has no use for it",
                &DriveRecord::height_error_m},
    DriveColumn{"move_time_s", "s",
                "simulated time of moves: driving, turning in place, steering, and "
                "move_overhead_time_s",
                &DriveRecord::move_time_s},
    DriveColumn{"told_goal_x_m", "m", "x of the designated goal", &DriveRecord::told_goal_x_m},
    DriveColumn{"told_goal_y_m", "m", "y of the designated goal", &DriveRecord::told_goal_y_m},
    DriveColumn{"designation_error_m", "m", "designated goal to true goal",
                &DriveRecord::designation_error_m},
    DriveColumn{"believed_goal_distance_m", "m",
                "believed final position to the goal as told, or as last seen where it is tracked; "
                "beside true_goal_distance_m",
                &DriveRecord::believed_goal_distance_m},
    DriveColumn{
        "path_ratio", "1",
        "true path length over displacement_m; 1 or more, and undefined where the rover did "
        "not declare arrival",
        &DriveRecord::path_ratio, true},
    DriveColumn{"stops", "1",
                "times that the rover came to rest: for a look, to steer at rest, for the overhead "
                "of a move, or at the end",
                &DriveRecord::stops},
    DriveColumn{"max_rocker_deg", "deg", "largest rocker angle, either side",
                &DriveRecord::max_rocker_deg},
    DriveColumn{"max_roll_deg", "deg",
                "largest slope of the chassis's lateral axis against the horizontal, either way",
                &DriveRecord::max_roll_deg},
    DriveColumn{"max_pitch_deg", "deg",
                "largest slope of the chassis's forward axis against the horizontal, either way",
                &DriveRecord::max_pitch_deg},
    DriveColumn{"first_scrape_distance_m", "m",
                "true path length at the first scrape, to a control tick; where scrapes is 0 all "
                "of it, a lower bound (censored)",
                &DriveRecord::first_scrape_distance_m},
    DriveColumn{"stall_energy_wh", "Wh",
                "energy of stall_time_s: what the batteries of a rover found stuck still hold",
                &DriveRecord::stall_energy_wh},
    DriveColumn{"stuck_noticed", "1",
                "times that the rover noticed by its own measurements that it is stuck, rightly or "
                "not; 0 where it does not look for it (navigation.on_board_stuck.reaction)",
                &DriveRecord::stuck_noticed},
    DriveColumn{"max_sinkage_m", "m", "deepest that a wheel went below the ground",
                &DriveRecord::max_sinkage_m},
    DriveColumn{"beyond_soil_law", "1",
                "1 where a wheel sank deeper than a sixth of its diameter, to where the law of "
                "sinkage holds; else 0",
                &DriveRecord::beyond_soil_law},
    DriveColumn{"unconverged_balances", "1",
                "balances of forces that were used without having met their tolerance; 0 for the "
                "multibody, which has none",
                &DriveRecord::unconverged_balances},
    DriveColumn{
        "no_progress_distance_m", "m",
        "most true distance driven without progress (referee.no_path_progress_m); under less "
        "patience than that the trial would have ended as no_path",
        &DriveRecord::no_progress_distance_m},
    DriveColumn{"no_progress_turn_deg", "deg", "most turning in place without progress, as above",
                &DriveRecord::no_progress_turn_deg},
    DriveColumn{"heading_growth_deg2_per_m", "deg2/m",
                "slope of the squared heading error against true distance along the run, by least "
                "squares through the origin",
                &DriveRecord::heading_growth_deg2_per_m},
    DriveColumn{"distance_growth_m2_per_m", "m2/m",
                "the same of the error of the dead-reckoned distance",
                &DriveRecord::distance_growth_m2_per_m},
    DriveColumn{"hazards_begun", "1",
                "scans whose hazard was believed after one without: once for each avoidance; 0 "
                "with a navigator that reports no hazards (a map)",
                &DriveRecord::hazards_begun},
    DriveColumn{"displacement_m", "m", "straight distance from the start to the true end",
                &DriveRecord::displacement_m},
    DriveColumn{"waypoints_reached", "1",
                "waypoints (course.waypoints) at which the rover declared to be; the goal is none "
                "of them",
                &DriveRecord::waypoints_reached},
    DriveColumn{"believed_position_sd_m", "m",
                "root of the summed variances of x and y that the rover believes at the end; "
                "undefined where its estimator keeps no account of its error",
                &DriveRecord::believed_position_sd_m, true},
    DriveColumn{"believed_heading_sd_deg", "deg", "the same of its heading",
                &DriveRecord::believed_heading_sd_deg, true},
    DriveColumn{"pose_nees", "1",
                "squared error of x, y and heading at the end in units of the believed covariance: "
                "chi-squared with 3 degrees of freedom, mean 3, where the belief is right",
                &DriveRecord::pose_nees, true},
    DriveColumn{"inside_95", "1",
                "1 where the true pose lies in the region that the rover believes to hold it with "
                "95 %; else 0",
                &DriveRecord::inside_95, true},
    DriveColumn{"aids_used", "1", "measurements of aids that corrected the estimate",
                &DriveRecord::aids_used},
    DriveColumn{"aids_in_doubt", "1",
                "of these, taken after others were turned away in a row: the estimator doubted "
                "itself",
                &DriveRecord::aids_in_doubt},
    DriveColumn{"aids_gated_out", "1", "measurements of aids that were turned away",
                &DriveRecord::aids_gated_out},
    DriveColumn{"aids_unanswered", "1",
                "measurements that were due and found nothing: out of range, hidden, dropped out",
                &DriveRecord::aids_unanswered},
    DriveColumn{"visual_steps", "1", "pairs of images that visual odometry compared with others",
                &DriveRecord::visual_steps},
    DriveColumn{"visual_failures", "1", "of these, those in which no motion was found",
                &DriveRecord::visual_failures},
    DriveColumn{"visual_keyframes", "1", "pairs of images that later ones were compared with",
                &DriveRecord::visual_keyframes},
    DriveColumn{"visual_gated_out", "1",
                "motions that were found and that the estimator turned away",
                &DriveRecord::visual_gated_out},
    DriveColumn{"slip_alarms", "1", "motions whose slip was seen to exceed its limit",
                &DriveRecord::slip_alarms},
    DriveColumn{"false_slip_alarms", "1",
                "of these, those whose true slip over the same way did not exceed it",
                &DriveRecord::false_slip_alarms},
    DriveColumn{"largest_slip", "1",
                "largest slip that was seen, 1 less the seen over the rolled way; empty where slip "
                "is not checked (perception.visual_odometry.slip_check)",
                &DriveRecord::largest_slip, true},
    DriveColumn{"first_slip_alarm_m", "m",
                "true path length at the first alarm of slip; empty without one",
                &DriveRecord::first_slip_alarm_m, true},
    DriveColumn{"slip_onset_m", "m",
                "true path length at which the true slip over slip_check.min_way_m first exceeded "
                "the limit; empty where it never did or is not checked",
                &DriveRecord::slip_onset_m, true},
    DriveColumn{"goal_rock_found", "1",
                "1 where the rover found the rock at its goal, else 0; empty without such a rock "
                "(course.goal_rock), as the next four",
                &DriveRecord::goal_rock_found, true},
    DriveColumn{"goal_rock_distance_m", "m",
                "from the rover's outline to that rock's, as seen from above, at the end",
                &DriveRecord::goal_rock_distance_m, true},
    DriveColumn{"goal_rock_sign", "1",
                "1 where it was found by the array of elevations, 2 by contact, else 0",
                &DriveRecord::goal_rock_sign, true},
    DriveColumn{"goal_rock_recognized", "1", "1 where the rover had recognized it, else 0",
                &DriveRecord::goal_rock_recognized, true},
    DriveColumn{"search_places_reached", "1",
                "places of the local search that the rover declared to be at, the told place "
                "included",
                &DriveRecord::search_places_reached, true},
    DriveColumn{
        "steer_turned_rad", "rad",
        "total true turning of a steering motor, to and fro alike, at rest and on the move: "
        "mean over the steered wheels",
        &DriveRecord::steer_turned_rad},
    DriveColumn{"steer_turned_max_rad", "rad", "the same of the motor that turned most",
                &DriveRecord::steer_turned_max_rad},
    DriveColumn{"visual_distance_m", "m",
                "way between the believed places at each motion of visual odometry; empty without "
                "one",
                &DriveRecord::visual_distance_m, true},
    DriveColumn{"plans_on_the_move", "1", "plans made while the rover drove (csod, csad)",
                &DriveRecord::plans_on_the_move},
    DriveColumn{"unsafe_plans", "1", "of these, those that found no safe motion",
                &DriveRecord::unsafe_plans},
    DriveColumn{"late_plans", "1", "motions that ended before the next plan was ready",
                &DriveRecord::late_plans},
    DriveColumn{"plan_start_error_m", "m",
                "root of the mean square of the distance from where a plan on the move was to "
                "begin to where the rover believed to be when it did; empty without one",
                &DriveRecord::plan_start_error_m, true},
};

}  // namespace rockyard::truth

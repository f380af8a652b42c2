#include "experiments/mission/mission_params.h"

#include <algorithm>

#include "math/functions.h"
#include "math/sun_position.h"
#include "trial/drive_checks_params.h"

namespace rockyard::experiments {

using core::Assumed;
using core::Published;
using core::Setting;

std::vector<messages::Goal> MissionGoalsParams::Places() const {
  std::vector<messages::Goal> places;
  for (std::size_t i = 0; i < std::min(x_m.size(), y_m.size()); ++i) {
    places.push_back({x_m[i], y_m[i]});
  }
  return places;
}

void MissionGoalsParams::Visit(core::FieldVisitor& v) {
  v.Reals("x_m", x_m,
          Setting("true places of the goal rocks in the world frame, in the order in which they "
                  "are visited",
                  {-1000.0, 1000.0}));
  v.Reals("y_m", y_m, Setting("the same, one for each x_m", {-1000.0, 1000.0}));
  v.Integer("attempts", attempts,
            Assumed("sols that end at a goal without its having been reached, or before it by a "
                    "stop of the rover, after which operators go on to the next one; sols that run "
                    "out of time or energy do not count",
                    "the paper does not say how often a goal is tried again", {1, 1000}, {1, 10}));
  v.Require("x_m", !x_m.empty() && x_m.size() == y_m.size(),
            "is empty, or has another number of entries than y_m",
            "list x and y of every goal, one at least");
}

double MissionDayParams::RoverBits() const {
  return static_cast<double>(rover_images) * rover_image_bits / compression + telemetry_bits;
}

void MissionDayParams::Visit(core::FieldVisitor& v) {
  v.Real("window_h", window_h,
         Published("hours (of 3600 s) in which the rover may drive, centred on local noon",
                   "Matthies 1995 sec. 2.1.2: approximately four hours a day, centred around noon",
                   {0.01, 12.0}));
  v.Real("latency_min", latency_min,
         Published("one-way light time to the Earth", "Matthies 1995 sec. 2.1.1", {0.0, 60.0}));
  v.Real("downlink_bit_s", downlink_bit_s,
         Published("rate from the lander to the Earth", "Matthies 1995 sec. 2.1.1", {1.0, 1e9}));
  v.Real(
      "downlink_h", downlink_h,
      Published("hours of it a sol", "Matthies 1995 sec. 2.1.1: roughly 2 to 3 hours; the middle",
                {0.01, 24.0}, {2.0, 3.0}));
  v.Real("planning_h", planning_h,
         Assumed("hours that operators take from the last image to the command",
                 "a night shift; the paper says once a day only", {0.0, 1000.0}, {4.0, 24.0}));
  v.Real("lander_image_bits", lander_image_bits,
         Published("bits of one image of the lander's cameras, before compression",
                   "Matthies 1995 sec. 2.1.1: 256 x 256 pixels; 8 bits each assumed", {0.0, 1e9}));
  v.Integer("lander_images", lander_images,
            Assumed("images of the lander that a command needs: the pair that shows the rover, and "
                    "a pair towards the next goal",
                    "sec. 2.1.2: a stereo pair of the rover at the end of each day; pairs in which "
                    "waypoints are designated",
                    {0, 10000}, {2, 16}));
  v.Real("rover_image_bits", rover_image_bits,
         Published("bits of one image of the rover, before compression",
                   "Matthies 1995 table 3: 768 x 484 pixels; 8 bits each assumed", {0.0, 1e9}));
  v.Integer("rover_images", rover_images,
            Assumed("images of the rover that a command needs",
                    "what stands before the rover; the paper does not tell", {0, 10000}, {0, 3}));
  v.Real("telemetry_bits", telemetry_bits,
         Assumed("what else the rover says of a sol", "some 600 scans of 20 elevations at 16 bits",
                 {0.0, 1e9}, {2e4, 2e6}));
  v.Real("compression", compression,
         Assumed("how many times smaller images become", "the paper speaks of none", {1.0, 1000.0},
                 {1.0, 6.0}));
  v.Real("radio_bit_s", radio_bit_s,
         Published("rate from the rover to the lander",
                   "Matthies 1995 sec. 2.1.2: 2000 bits/second", {1.0, 1e9}));
}

void MissionPowerParams::Visit(core::FieldVisitor& v) {
  v.Real("noon_W", noon_W,
         Published("power of the solar cells at noon of the first sol; over the day it follows the "
                   "sun's arc of the site and season of sensors.aids.sun",
                   "Matthies 1995 sec. 2.1.2: a peak output of 16 W at noon", {0.0, 1e4}));
  v.Real("dust_loss_per_sol", dust_loss_per_sol,
         Assumed("share of that power that dust takes from one sol to the next",
                 "0.28 % a sol, as later measured on Sojourner (Landis and Jenkins 2000)",
                 {0.0, 0.5}, {0.0, 0.01}));
  v.Real("battery_wh", battery_wh,
         Assumed("energy of the batteries at the start, which nothing recharges",
                 "the paper calls them non-rechargeable and gives no capacity; about that of "
                 "Sojourner's lithium cells",
                 {0.0, 1e5}, {50.0, 300.0}));
  v.Real("modem_W", modem_W,
         Published("the modem while it transmits, beside idle_W", "Matthies 1995 table 1",
                   {0.0, 1e4}));
  v.Real("idle_W", idle_W,
         Assumed("of a rover that is awake and does nothing, from the end of its drive to the end "
                 "of window_h, and while it transmits",
                 "computer and I/O of table 1, everything else off", {0.0, 1e4}, {0.5, 5.0}));
  v.Real("sleep_W", sleep_W,
         Assumed("of a rover that sleeps: clock, and heating beyond its radioisotope units",
                 "150 Wh through the 28 nights of the mission's goal (sec. 2.1.1: four weeks), "
                 "16.5 hours each",
                 {0.0, 1e4}, {0.05, 1.0}));
}

void MissionParams::Visit(core::FieldVisitor& v) {
  v.Integer("sols", sols,
            Published("most sols of a mission",
                      "Matthies 1995 sec. 2.1.1: one week, with a goal of four", {1, kMostSols}));
  v.Choice("lander_update", lander_update,
           Published("when operators find the rover in the lander's images of a day, with the "
                     "errors of sensors.aids.lander_fix",
                     "Matthies 1995 sec. 2.1.2, 5: once daily, by images from the end of the day"));
  v.Real("lander_x_m", lander_x_m,
         Setting("where the lander's cameras stand, in the world frame", {-1000.0, 1000.0}));
  v.Real("lander_y_m", lander_y_m, Setting("the same", {-1000.0, 1000.0}));
  v.Real("radio_range_m", radio_range_m,
         Published("distance from the lander beyond which the rover hears no command: it is lost",
                   "Matthies 1995 sec. 2.1.2: a clear-field radial range of 500 m", {0.1, 1e5}));
  v.Integer(
      "stuck_sols", stuck_sols,
      Assumed(
          "sols in a row that end jammed or high-centred, after which operators give the rover up",
          "the paper does not tell", {1, 1000}, {1, 10}));
  v.Boolean("sol_columns", sol_columns, Setting("a record tells of every sol as well"));
  v.Group("goals", goals, "where the rover is to go");
  v.Group("day", day, "the hours of a sol, and what a command needs");
  v.Group("power", power, "sun, batteries and what draws on them beside the drive");
}

namespace {

void RequireField(const MissionParams& mission, const trial::DriveParams& drive,
                  core::FieldVisitor& v) {
  const terrain::ArenaParams& arena = drive.terrain.arena;
  v.Require("terrain.arena.kind", arena.kind == terrain::ArenaKind::kOpen,
            "is not open, where a mission roams about the lander", "use open");
  v.Require("terrain.rocks.mobility", drive.terrain.rocks.mobility == terrain::RockMobility::kFixed,
            "is movable, where nobody keeps over a night what was pushed", "use fixed");
  const std::vector<messages::Goal> goals = mission.goals.Places();
  v.Require("mission.goals.x_m",
            std::all_of(goals.begin(), goals.end(),
                        [&](const messages::Goal& goal) {
                          return arena.HoldsCoursePoint(goal.x_m, goal.y_m);
                        }),
            "puts a goal outside of terrain.arena", "move it or enlarge the arena");
  const double start_x_m = drive.course.start_x_m;
  const double start_y_m = drive.course.start_y_m;
  v.Require("mission.goals.x_m",
            goals.empty() ||
                math::Hypot(goals.front().x_m - start_x_m, goals.front().y_m - start_y_m) > 0.1,
            "puts the first goal within 0.1 m of the start", "use a goal that has to be driven to");
}

// Requires one goal: a sol's command names one.
void RequireOneGoal(const trial::DriveParams& drive, core::FieldVisitor& v) {
  const trial::CourseParams& course = drive.course;
  v.Require("course.waypoints.x_m", course.waypoints.x_m.empty(),
            "names waypoints, where each sol of a mission has one goal",
            "list them in mission.goals");
  v.Require("course.tracking.enabled", !course.tracking.enabled,
            "is true, where a mission's goals are told", "use false");
  v.Require("course.goal_rock.enabled", !course.goal_rock.enabled,
            "is true, where rocks of a mission stand from its first sol on", "use false");
  v.Require("course.target_speed_m_s", course.target_speed_m_s == 0.0,
            "is above 0, where a mission's goals are rocks", "use 0");
  v.Require("course.route_map.use",
            course.route_map.use == trial::RouteUse::kNavigator &&
                !drive.navigation.navigators.chosen().traits().follows_route,
            "is waypoints, or navigation.navigator follows a route: both begin where the rover "
            "truly stands",
            "use navigator, and pathfinder or gestalt");
}

void RequireClock(const MissionParams& mission, const trial::DriveParams& drive,
                  core::FieldVisitor& v) {
  const trial::OverlapParams& overlap = drive.clock.overlap;
  v.Require("clock.overlap.imaging", !overlap.imaging && !overlap.computing && !overlap.steering,
            "or another of clock.overlap is true, where one sun supplies one activity at a time",
            "turn all of clock.overlap off");
  const bool on_board = drive.referee.stuck_rover == trial::StuckRover::kEnd;
  v.Require("referee.stuck_rover", on_board,
            "is run_on, where a rover that is stuck rests until the next command", "use end");
  const MissionDayParams& day = mission.day;
  v.Require("mission.day.rover_images", day.Window_s() + day.TransmitTime_s() < math::kSolOfMars_s,
            "asks for more than the rover can transmit in what is left of a sol",
            "use fewer or smaller images, more compression or a faster radio");
}

void RequireSun(const trial::DriveParams& drive, core::FieldVisitor& v) {
  const sensing::SunSensorParams& sky = drive.sensors.aids.sun;
  const double declination_rad = math::SunDeclination(sky.areocentric_longitude_rad);
  // The sine of the elevation of the noon sun; at a pole no sol has a noon.
  const double noon = math::Cos(sky.latitude_rad - declination_rad);
  v.Require("sensors.aids.sun.latitude_deg", noon > 0.0 && math::Cos(sky.latitude_rad) > 1e-3,
            "puts the site where no sun rises in that season, or at a pole",
            "use another latitude or areocentric_longitude_deg");
}

// Requires an estimator that takes fixes where updates come at noon: such an update reaches a rover
// that drives.
void RequireNoonListener(const MissionParams& mission, const trial::DriveParams& drive,
                         core::FieldVisitor& v) {
  v.Require("mission.lander_update",
            mission.lander_update != LanderUpdate::kNoon ||
                drive.localization.estimators.chosen().takes_fixes(),
            "is noon where localization.estimator takes no fixes on the way",
            "use evening, or estimator error_state");
}

}  // namespace

void RequireMission(const MissionParams& mission, const trial::DriveParams& drive,
                    core::FieldVisitor& v) {
  trial::RequireSoundDrive(drive, v);
  RequireField(mission, drive, v);
  RequireOneGoal(drive, v);
  RequireClock(mission, drive, v);
  RequireSun(drive, v);
  RequireNoonListener(mission, drive, v);
}

}  // namespace rockyard::experiments

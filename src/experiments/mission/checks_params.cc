#include "experiments/mission/checks_params.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/sun_position.h"

namespace rockyard::experiments {
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
                std::hypot(goals.front().x_m - start_x_m, goals.front().y_m - start_y_m) > 0.1,
            "puts the first goal within 0.1 m of the start", "use a goal that has to be driven to");
}

// A sol's command names one goal.
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
  // Of the noon sun, and at a pole no sol has a noon.
  const double noon = std::cos(sky.latitude_rad - declination_rad);
  v.Require("sensors.aids.sun.latitude_deg", noon > 0.0 && std::cos(sky.latitude_rad) > 1e-3,
            "puts the site where no sun rises in that season, or at a pole",
            "use another latitude or areocentric_longitude_deg");
}

// An update at noon reaches a rover that drives.
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
  RequireField(mission, drive, v);
  RequireOneGoal(drive, v);
  RequireClock(mission, drive, v);
  RequireSun(drive, v);
  RequireNoonListener(mission, drive, v);
}

}  // namespace rockyard::experiments

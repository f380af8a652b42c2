#include "trial/drive_checks_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "math/angles.h"
#include "math/functions.h"
#include "rover/rover_params.h"
#include "trial/eyes/terrain_sensor_set_params.h"

namespace rockyard::trial {
namespace {

// Refuses listed rocks nearer than clear_m to (x, y), which the course's `place` names.
void RequireFreePlace(const terrain::ListedRocksParams& rocks, double x_m, double y_m,
                      double clear_m, std::string_view place, core::FieldVisitor& v) {
  for (std::size_t i = 0; i < rocks.x_m.size(); ++i) {
    const double centre_m = math::Hypot(rocks.x_m[i] - x_m, rocks.y_m[i] - y_m);
    if (centre_m >= clear_m + 0.5 * rocks.diameter_m[i]) continue;
    v.Require(
        fmt::format("terrain.rocks.listed.x_m[{}]", i), false,
        fmt::format("puts the rock nearer to course.{} than terrain.rocks.clear_radius_m", place),
        "move the rock or the course, or use a smaller clear_radius_m where that is meant");
    return;
  }
}

// Random rocks keep away from start and goal, listed ones stand where they were put.
void RequireFreeEnds(const DriveParams& drive, core::FieldVisitor& v) {
  const terrain::RockFieldParams& rocks = drive.terrain.rocks;
  const terrain::ListedRocksParams& listed = rocks.listed;
  // Lists of different lengths have been refused by their own group.
  if (rocks.kind != terrain::RockFieldKind::kListed || !listed.IsSound()) return;
  const CourseParams& course = drive.course;
  RequireFreePlace(listed, course.start_x_m, course.start_y_m, rocks.clear_radius_m,
                   "start_x_m, start_y_m", v);
  RequireFreePlace(listed, course.goal_x_m, course.goal_y_m, rocks.clear_radius_m,
                   "goal_x_m, goal_y_m", v);
  const std::vector<messages::Goal> waypoints = course.waypoints.Places();
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    RequireFreePlace(listed, waypoints[i].x_m, waypoints[i].y_m, rocks.clear_radius_m,
                     fmt::format("waypoint {} of course.waypoints", i + 1), v);
  }
}

// Refuses goals that may be told beyond a mirror line: the rover is turned back there.
void RequireDesignatedGoals(const DriveParams& drive, core::FieldVisitor& v) {
  const CourseParams& course = drive.course;
  const terrain::ArenaParams& arena = drive.terrain.arena;
  if (!course.designation.enabled || arena.kind != terrain::ArenaKind::kVirtualReflected) return;
  constexpr double kDeviations = 5.0;  // one trial in a million lies beyond
  const std::vector<messages::Goal> goals = course.Goals();
  const bool within = std::all_of(goals.begin(), goals.end(), [&](const messages::Goal& goal) {
    const DesignationErrors errors = course.designation.ErrorsAt(course.DesignationRange_m(goal));
    const double reach_m = kDeviations * std::max(errors.crossrange_sd_m, errors.downrange_sd_m) +
                           std::abs(errors.crossrange_bias_m);
    return std::abs(goal.y_m) + reach_m <= arena.MirrorLine();
  });
  v.Require("course.designation.enabled", within,
            "is true where goals or waypoints may be designated beyond the mirror lines of "
            "terrain.arena, where no rover arrives",
            "use a wider arena, another kind, a nearer lander or smaller errors");
}

bool IsLike(double believed_m, double true_m) {
  return believed_m <= 2.0 * true_m && believed_m >= 0.5 * true_m;
}

void RequireOwnSize(const DriveParams& drive, core::FieldVisitor& v) {
  const navigation::NavigatorKind& navigator = drive.navigation.navigators.chosen();
  const std::optional<navigation::BelievedSize> believed = navigator.traits().size;
  if (!believed) return;
  const rover::RoverGeometryParams& rover = drive.rover.geometry;
  v.Require(navigator.PathOf(believed->length_path), IsLike(believed->length_m, rover.length_m),
            "is more than a factor of two from rover.geometry.length_m", believed->suggestion);
  v.Require(navigator.PathOf(believed->width_path), IsLike(believed->width_m, rover.width_m),
            "is more than a factor of two from rover.geometry.width_m", believed->suggestion);
}

// Refuses a slope on which the soil does not hold the rover: it slides off while it waits, ever
// faster.
void RequireHold(const DriveParams& drive, core::FieldVisitor& v) {
  const terrain::GroundParams& ground = drive.terrain.ground;
  const double held_rad = rover::SteepestHeldSlope_rad(drive.rover, ground.soil);
  // Rounded down, to tenths.
  const double held_deg = std::floor(10.0 * math::RadToDeg(held_rad)) / 10.0;
  v.Require(
      "terrain.ground.slope_deg", ground.slope_rad <= held_rad,
      fmt::format("is steeper than the {:.1f} deg up to which this soil holds this rover, "
                  "braked",
                  held_deg),
      fmt::format("use at most {:.1f} deg, or a soil of more friction or cohesion", held_deg));
}

// Refuses ditches and pits under the start: a rover that is put down on an edge falls before it is
// told to drive.
void RequireLevelStart(const DriveParams& drive, core::FieldVisitor& v) {
  const terrain::GroundParams& ground = drive.terrain.ground;
  if (!ground.ditches.IsSound() || !ground.pits.IsSound()) return;
  const rover::RoverGeometryParams& rover = drive.rover.geometry;
  const double reach_m = 0.5 * math::Hypot(rover.length_m, rover.width_m);
  const auto meets = [&](const terrain::Depression& one) {
    return one.Distance_m(drive.course.start_x_m, drive.course.start_y_m) <
           one.half_width_m + reach_m;
  };
  const auto depressions = terrain::ListDepressions(ground.ditches, ground.pits);
  const auto first = std::find_if(depressions.begin(), depressions.end(), meets);
  if (first == depressions.end()) return;
  const auto index = static_cast<std::size_t>(first - depressions.begin());
  const std::size_t ditches = ground.ditches.x_m.size();
  const std::string name = index < ditches ? fmt::format("ditches.x_m[{}]", index)
                                           : fmt::format("pits.x_m[{}]", index - ditches);
  v.Require("terrain.ground." + name, false,
            fmt::format("reaches under the rover at the start, {:.2f} m around ({:g}, {:g})",
                        reach_m, drive.course.start_x_m, drive.course.start_y_m),
            "move it, or course.start_x_m and course.start_y_m");
}

// Refuses waypoints and tracking with a route to follow, which is planned once, from the start to
// the goal.
void RequireOnePlan(const DriveParams& drive, core::FieldVisitor& v) {
  const navigation::NavigatorKind& navigator = drive.navigation.navigators.chosen();
  const bool follows = navigator.traits().follows_route;
  const CourseParams& course = drive.course;
  v.Require("course.waypoints.x_m", !follows || course.waypoints.x_m.empty(),
            fmt::format("names waypoints where navigation.navigator is {}, whose oracle plans one "
                        "way from the start to the goal",
                        navigator.name()),
            "use navigator pathfinder or gestalt, or a course without waypoints");
  v.Require("course.tracking.enabled", !follows || !course.tracking.enabled,
            fmt::format("is true where navigation.navigator is {}, which follows a way that was "
                        "planned before",
                        navigator.name()),
            "use navigator pathfinder or gestalt, or no tracking");
}

// Requires that a route has somebody who follows it, or drives along its corners, not both, and
// that the map of a lander has a lander, which stands where designation says.
void RequireSoundRouteMap(const DriveParams& drive, core::FieldVisitor& v) {
  const navigation::NavigatorKind& navigator = drive.navigation.navigators.chosen();
  const bool follows = navigator.traits().follows_route;
  const CourseParams& course = drive.course;
  const bool waypoints = course.route_map.use == RouteUse::kWaypoints;
  const bool lander = course.route_map.source == RouteMap::kLander;
  v.Require("course.route_map.use", !waypoints || !follows,
            fmt::format("is waypoints where navigation.navigator is {}, which follows the whole "
                        "route itself",
                        navigator.name()),
            "use navigator, or navigation.navigator pathfinder or gestalt, which look for hazards");
  v.Require("course.route_map.use", !waypoints || course.waypoints.x_m.empty(),
            "is waypoints where course.waypoints names others",
            "use a course without waypoints, or navigator");
  v.Require("course.route_map.use", !waypoints || !course.tracking.enabled,
            "is waypoints where course.tracking.enabled is true: the route was planned before, to "
            "the goal as it was told",
            "use navigator, or no tracking");
  v.Require("course.route_map.source", !lander || waypoints || follows,
            fmt::format("is lander where nobody uses a route: navigation.navigator is {} and "
                        "course.route_map.use is navigator",
                        navigator.name()),
            "use waypoints, navigation.navigator route, or oracle");
  v.Require("course.route_map.source", !lander || course.designation.enabled,
            "is lander where course.designation.enabled is false, which says where the lander's "
            "cameras stand and how far the goal is off in their frame",
            "use course.designation.enabled true, or oracle");
}

// Refuses a target that moves across a mirror line, where no rover arrives.
void RequireTargetBetweenLines(const DriveParams& drive, core::FieldVisitor& v) {
  v.Require("course.target_speed_m_s",
            drive.course.target_speed_m_s == 0.0 ||
                drive.terrain.arena.kind != terrain::ArenaKind::kVirtualReflected,
            "is above 0 in a virtual_reflected arena, whose mirror lines the target would cross",
            "use a target that stands, or another kind of arena");
}

// Requires what a rock at the goal needs of field, sensors and navigator.
void RequireFindableRock(const DriveParams& drive, core::FieldVisitor& v) {
  const GoalRockParams& rock = drive.course.goal_rock;
  if (!rock.enabled) return;
  const navigation::NavigatorKind& navigator = drive.navigation.navigators.chosen();
  v.Require("course.goal_rock.enabled",
            navigator.traits().reads == navigation::LookReading::kHazardReport,
            fmt::format("is true where navigation.navigator is {}, which reads no report of "
                        "hazards that could find the rock",
                        navigator.name()),
            "use navigator pathfinder");
  v.Require("course.goal_rock.enabled", !drive.course.tracking.enabled,
            "is true where course.tracking is enabled, which knows the goal all the way",
            "use recognition_m, which measures as course.tracking says, or no goal rock");
  v.Require("course.goal_rock.enabled", drive.course.target_speed_m_s == 0.0,
            "is true where course.target_speed_m_s is above 0, and rocks do not move on",
            "use a target that stands");
  v.Require("course.goal_rock.enabled",
            drive.terrain.arena.kind != terrain::ArenaKind::kVirtualReflected,
            "is true in a virtual_reflected arena, beyond whose mirror lines a search may lead",
            "use an open arena");
  v.Require("course.goal_rock.diameter_m",
            drive.terrain.rocks.kind == terrain::RockFieldKind::kNone ||
                0.5 * rock.diameter_m <= drive.terrain.rocks.clear_radius_m,
            "makes the rock larger than what terrain.rocks.clear_radius_m keeps free of others",
            "use a smaller rock or a larger clear_radius_m");
}

// Requires batteries that can be empty, which end the run of a stuck rover that runs on.
void RequireEndOfStall(const DriveParams& drive, core::FieldVisitor& v) {
  v.Require("referee.stuck_rover",
            drive.referee.stuck_rover == StuckRover::kEnd || drive.energy.battery_wh > 0.0,
            "is run_on where energy.battery_wh is 0, so that a stuck rover would run on for ever",
            "use end, or batteries that can be empty");
}

// Refuses answers to alarms of slip that nobody would give.
void RequireSlipReaction(const DriveParams& drive, core::FieldVisitor& v) {
  using navigation::SlipResponse;
  if (!drive.perception.visual_odometry.slip_check.enabled) return;
  const SlipResponse reaction = drive.navigation.on_slip.reaction;
  v.Require("navigation.on_slip.reaction",
            reaction != SlipResponse::kAsStuck ||
                drive.navigation.on_board_stuck.reaction != navigation::StuckResponse::kOff,
            "is as_stuck where navigation.on_board_stuck.reaction is off",
            "use stop, or turn on_board_stuck on");
  v.Require("navigation.on_slip.reaction",
            reaction != SlipResponse::kReplan ||
                !drive.navigation.navigators.chosen().traits().follows_route,
            "is replan where the navigator follows a route and heeds no hazard",
            "use stop or as_stuck, or another navigator");
}

// Refuses a navigator that looks or steers on the move in a drive that stops for it.
void RequireOverlap(const DriveParams& drive, core::FieldVisitor& v) {
  const navigation::NavigatorKind& navigator = drive.navigation.navigators.chosen();
  const navigation::NavigatorTraits traits = navigator.traits();
  const OverlapParams& overlap = drive.clock.overlap;
  // A navigator that is no part of the program has no such parameter: it is named itself.
  const bool foreign = navigator.foreign();
  const std::string cycle = foreign ? "navigation.navigator" : navigator.PathOf("continuous.cycle");
  const std::string suggestion = foreign ? "use " : "use stop_and_look, or ";
  v.Require(cycle, !traits.looks_on_the_move || overlap.imaging || overlap.computing,
            "looks on the move where clock.overlap lets neither imaging nor computing go on "
            "beside the drive: the rover would stop for each look",
            suggestion + "clock.overlap.imaging and clock.overlap.computing true");
  v.Require(cycle,
            !traits.looks_on_the_move || drive.sensors.terrain_sensors.chosen().takes_image_sets(),
            "looks on the move where sensors.terrain_sensor is one that scans at rest",
            suggestion + "sensors.terrain_sensor stereo");
  v.Require(
      cycle, !traits.steers_on_the_move || overlap.steering,
      "steers on the move (csad) where clock.overlap.steering is false: the rover would stand "
      "to steer",
      std::string(foreign ? "use " : "use csod, or ") + "clock.overlap.steering true");
}

// Refuses a navigator that wants images where no cameras take any.
void RequireImages(const DriveParams& drive, core::FieldVisitor& v) {
  const navigation::NavigatorKind& navigator = drive.navigation.navigators.chosen();
  if (!navigator.traits().images) return;
  const TerrainSensorKind& sensor = drive.sensors.terrain_sensors.chosen();
  const sensing::StereoParams* cameras = sensor.cameras(drive);
  v.Require("sensors.terrain_sensor", cameras != nullptr,
            fmt::format("is {}, which takes no images, where navigation.navigator is {}, which "
                        "asks for them",
                        sensor.name(), navigator.name()),
            "use stereo, with sensors.stereo.fidelity image, or another navigator");
  v.Require("sensors.stereo.fidelity",
            cameras == nullptr || cameras->fidelity == sensing::StereoFidelity::kImage,
            fmt::format("takes no images, where navigation.navigator is {}, which asks for them",
                        navigator.name()),
            "use image, or another navigator");
}

// Refuses a reader of images where there are none, or nobody wants what it makes of them.
void RequireReadImages(const DriveParams& drive, core::FieldVisitor& v) {
  const perception::PointReaderKind& reader = drive.perception.readers.chosen();
  if (reader.is_own()) return;
  const sensing::StereoParams* cameras = drive.sensors.terrain_sensors.chosen().cameras(drive);
  const bool takes = cameras != nullptr && cameras->fidelity == sensing::StereoFidelity::kImage;
  v.Require("perception.reader", takes,
            fmt::format("is {}, where the terrain sensor takes no images that it could read",
                        reader.name()),
            "use sensors.terrain_sensor stereo with sensors.stereo.fidelity image, or reader "
            "stereo");
  v.Require("perception.reader", !takes || !ReadsImagesAlone(drive),
            fmt::format("is {}, where navigation.navigator is {}, which reads the images itself",
                        reader.name(), drive.navigation.navigators.chosen().name()),
            "use reader stereo, or another navigator");
}

// Refuses steering so slow that a rover in a curve finds no motion to go on with.
void RequireFeasibleCurves(const DriveParams& drive, core::FieldVisitor& v) {
  const navigation::NavigatorKind& navigator = drive.navigation.navigators.chosen();
  const auto rates = navigator.traits().curvature_rates;
  if (!rates) return;
  const double least_per_m_s = rates->least_per_m2 * drive.rover.drive.speed_m_s;
  v.Require(navigator.PathOf(rates->path), rates->limit_per_m_s >= least_per_m_s,
            fmt::format("leaves no spline from one curvature to the next, which at {:g} m/s takes "
                        "{:.2g} / (m s)",
                        drive.rover.drive.speed_m_s, least_per_m_s),
            "use a larger limit, more knots, longer splines or a slower rover");
}

// Refuses aids that the estimator does not listen to, and a slip check without visual odometry.
void RequireListener(const DriveParams& drive, core::FieldVisitor& v) {
  const localization::EstimatorKind& estimator = drive.localization.estimators.chosen();
  v.Require("localization.estimator", !drive.sensors.aids.AnyEnabled() || estimator.takes_fixes(),
            "takes no fixes, where sensors.aids has some enabled",
            "use error_state, or turn the aids off");
  v.Require("localization.estimator",
            !drive.sensors.visual_odometry.enabled || estimator.takes_motions(),
            "takes no motions that are seen, where sensors.visual_odometry is enabled",
            "use visual_odometry or error_state, or turn sensors.visual_odometry off");
  v.Require(
      "perception.visual_odometry.slip_check.enabled",
      !drive.perception.visual_odometry.slip_check.enabled || drive.sensors.visual_odometry.enabled,
      "is true where sensors.visual_odometry is off, so that no slip is ever seen",
      "turn sensors.visual_odometry on, or the check off");
}

}  // namespace

void RequireTwoEyes(const DriveParams& drive, core::FieldVisitor& v) {
  v.Require("sensors.visual_odometry.fidelity",
            drive.sensors.visual_odometry.fidelity != sensing::VisualFidelity::kImage ||
                drive.sensors.stereo.fidelity != sensing::StereoFidelity::kIdeal,
            "is image where sensors.stereo.fidelity is ideal, whose two eyes stand in one place",
            "use sensors.stereo.fidelity error_model or image");
}

void RequireSoundDrive(const DriveParams& drive, core::FieldVisitor& v) {
  drive.sensors.terrain_sensors.chosen().RequireDrive(drive, v);
  RequireOwnSize(drive, v);
  RequireHold(drive, v);
  RequireLevelStart(drive, v);
  RequireEndOfStall(drive, v);
  RequireFreeEnds(drive, v);
  RequireDesignatedGoals(drive, v);
  RequireOnePlan(drive, v);
  RequireSoundRouteMap(drive, v);
  RequireTargetBetweenLines(drive, v);
  RequireListener(drive, v);
  if (drive.sensors.visual_odometry.enabled) RequireTwoEyes(drive, v);
  RequireOverlap(drive, v);
  RequireImages(drive, v);
  RequireReadImages(drive, v);
  RequireFeasibleCurves(drive, v);
  RequireSlipReaction(drive, v);
  RequireFindableRock(drive, v);
}

}  // namespace rockyard::trial

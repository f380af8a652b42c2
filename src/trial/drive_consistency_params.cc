// What any experiment requires of a drive: RequireConsistency of drive_checks_params.h.
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "rover/rover_params.h"
#include "trial/drive_checks_params.h"
#include "trial/eyes/terrain_sensor_set_params.h"

namespace rockyard::trial {
namespace {

// Requires places inside the arena, control ticks no shorter than a step, and fixed rocks with the
// quasi-static rover.
void RequirePossible(const DriveParams& drive, core::FieldVisitor& v) {
  const terrain::ArenaParams& arena = drive.terrain.arena;
  const CourseParams& course = drive.course;
  v.Require("course.start_x_m", arena.HoldsCoursePoint(course.start_x_m, course.start_y_m),
            "puts the start outside of terrain.arena (or of the mirror lines of a virtual arena)",
            "move the start or enlarge the arena");
  v.Require("course.goal_x_m", arena.HoldsCoursePoint(course.goal_x_m, course.goal_y_m),
            "puts the goal outside of terrain.arena (or of the mirror lines of a virtual arena)",
            "move the goal or enlarge the arena");
  const std::vector<messages::Goal> waypoints = course.waypoints.Places();
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    v.Require("course.waypoints.x_m", arena.HoldsCoursePoint(waypoints[i].x_m, waypoints[i].y_m),
              fmt::format("puts waypoint {} outside of terrain.arena (or of the mirror lines of a "
                          "virtual arena)",
                          i + 1),
              "move the waypoint or enlarge the arena");
  }
  const bool multibody = drive.rover.fidelity == rover::Fidelity::kMultibody;
  const double step_s = multibody ? drive.rover.physics.time_scale * drive.rover.physics.step_s
                                  : drive.rover.quasi_static.step_s;
  v.Require("clock.control_rate_hz", drive.clock.control_rate_hz * step_s <= 1.0,
            "asks for more than one control step per rover.physics.step_s times time_scale "
            "(multibody) or "
            "rover.quasi_static.step_s (quasi_static)",
            "use a lower rate or a shorter physics step");
  v.Require("rover.fidelity",
            multibody || drive.terrain.rocks.mobility == terrain::RockMobility::kFixed,
            "is quasi_static, which pushes no rocks, where terrain.rocks.mobility is movable",
            "use fidelity multibody or fixed rocks");
}

// Returns whether a mass is left for the chassis; where not, RoverMassParams has refused the
// masses.
bool HasChassis(const rover::RoverMassParams& mass) {
  return mass.total_kg > 6.0 * mass.wheel_kg + 2.0 * (mass.rocker_kg + mass.bogie_kg);
}

// Refuses a centre of mass beyond the wheels: such a rover falls over before it drives.
void RequireStanding(const rover::RoverParams& rover, core::FieldVisitor& v) {
  if (!HasChassis(rover.mass)) return;
  const rover::ComRange range = rover::StandingComRange(rover);
  const double com_x_m = rover.mass.chassis_com_x_m;
  v.Require("rover.mass.chassis_com_x_m", com_x_m > range.min_m && com_x_m < range.max_m,
            "tips the rover over: on level ground some wheels would have to hold it down",
            // Rounded inwards, to millimetres.
            fmt::format("use a value from {:.3f} to {:.3f}, with which all six wheels carry a part",
                        std::ceil(1000.0 * range.min_m) / 1000.0,
                        std::floor(1000.0 * range.max_m) / 1000.0));
}

// Requires that a rover without any error arrives truly where its navigator arrives.
void RequireArrival(const DriveParams& drive, core::FieldVisitor& v) {
  const navigation::NavigatorKind& navigator = drive.navigation.navigators.chosen();
  const navigation::GoalTolerance arrival = navigator.traits().goal;
  v.Require("course.goal_radius_m", drive.course.goal_radius_m >= arrival.tolerance_m,
            fmt::format("is below {}, so that a rover without any error could arrive falsely",
                        navigator.PathOf(arrival.path)),
            "use a goal radius of at least the navigator's tolerance");
}

// Returns the sensor whose conditions hold: the light stripe where the experiment measures it, else
// the sensor that the scenario chooses.
const TerrainSensorKind& SensorInUse(const DriveParams& drive, LightStripeUse use) {
  const TerrainSensorSet& sensors = drive.sensors.terrain_sensors;
  return use == LightStripeUse::kAlways ? sensors.Named("light_stripe") : sensors.chosen();
}

// Requires that a navigator that tells stripes apart names every stripe of the array that it
// judges.
void RequireStripes(const DriveParams& drive, const TerrainSensorKind& sensor,
                    core::FieldVisitor& v) {
  const navigation::NavigatorKind& navigator = drive.navigation.navigators.chosen();
  const std::optional<navigation::StripeNames> named = navigator.traits().stripes;
  if (!named) return;
  const ReportArray array = sensor.report_array(drive);
  v.Require(navigator.PathOf(named->path), static_cast<std::int64_t>(named->count) == array.stripes,
            fmt::format("{} another number of stripes than {}", named->names, array.owner),
            array.suggestion);
}

}  // namespace

void RequireConsistency(const DriveParams& drive, LightStripeUse light_stripe,
                        core::FieldVisitor& v) {
  RequirePossible(drive, v);
  RequireStanding(drive.rover, v);
  RequireArrival(drive, v);
  const TerrainSensorKind& sensor = SensorInUse(drive, light_stripe);
  RequireStripes(drive, sensor, v);
  sensor.Require(drive, v);
}

}  // namespace rockyard::trial

#include "experiments/three_rock_run/checks_params.h"

#include "navigation/navigator_traits_params.h"

namespace rockyard::experiments {

void RequireThreeRockRun(const ThreeRockRunParams& run, const trial::DriveParams& drive,
                         core::FieldVisitor& v) {
  v.Require("sensors.terrain_sensor",
            drive.sensors.terrain_sensors.chosen().name() == "light_stripe",
            "is not light_stripe, by whose array the experiment three_rock_run tells alarms apart",
            "use light_stripe");
  v.Require(
      "navigation.navigator",
      drive.navigation.navigators.chosen().traits().reads == navigation::LookReading::kHazardReport,
      "reads no reports of hazards, of which the run is told", "use pathfinder");
  const terrain::RockFieldParams& rocks = drive.terrain.rocks;
  v.Require("terrain.rocks.kind", rocks.kind == terrain::RockFieldKind::kNone,
            "is not none, where the experiment lays out three rocks and no others", "use none");
  v.Require("terrain.rocks.mobility", rocks.mobility == terrain::RockMobility::kFixed,
            "is not fixed, where scrapes are told apart by where the rocks lie", "use fixed");
  v.Require("terrain.ground.slope_deg", drive.terrain.ground.IsLevel(),
            "or roughness_rms_m is not 0, or there are ditches or pits, where the run was on level "
            "sand",
            "leave the ground flat");
  const terrain::ArenaParams& arena = drive.terrain.arena;
  v.Require("terrain.arena.kind", arena.kind == terrain::ArenaKind::kOpen,
            "is not open, where the run had nothing but three rocks around it", "use open");
  const trial::CourseParams& course = drive.course;
  v.Require("course.goal_y_m",
            course.goal_y_m == 0.0 && course.start_x_m == 0.0 && course.start_y_m == 0.0 &&
                course.start_heading_rad == 0.0 && course.waypoints.x_m.empty(),
            "or the start or waypoints ask for another course than from the origin along x",
            "start at 0, 0 with heading 0, and leave waypoints out");
  v.Require("three_rock_run.prior.goal_m", arena.HoldsCoursePoint(run.prior.goal_m[1], 0.0),
            "reaches beyond terrain.arena", "lengthen the arena, or bring the goal nearer");
}

}  // namespace rockyard::experiments

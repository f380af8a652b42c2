#include "experiments/three_rock_run/three_rock_run_params.h"

#include <string_view>

#include "navigation/navigator_traits_params.h"

namespace rockyard::experiments {
namespace {

using core::Published;
using core::Setting;

void VisitRange(core::FieldVisitor& v, std::string_view name, UniformRange& range,
                const core::FieldInfo& info) {
  v.FixedReals(name, range, info);
  v.Require(name, range[0] <= range[1], "ends below its start",
            "give the lowest value first, then the highest");
}

}  // namespace

void RockPrior::Visit(core::FieldVisitor& v) {
  VisitRange(
      v, "along_m", along_m,
      Assumed("rock A: from the rover's front to its near end where told.a_path_m is driven; "
              "B: path at which the rover's centre would come to it; C: path from B to it",
              "A: the light stripe's array spans 0.3 m ahead; B: after the way around A; C: "
              "after a straight stretch (Matthies 1995 sec. 5)",
              {0.0, 100.0}));
  VisitRange(v, "offset_m", offset_m,
             Assumed("centre beside the rover's way, to the left",
                     "half of the array's width, or of the body's with some of the rock's radius: "
                     "farther out a rock is neither seen nor scraped",
                     {-5.0, 5.0}));
  VisitRange(v, "height_m", height_m,
             Assumed("height above the ground",
                     "around what is detected (0.075 m); B from the underside of a hub (0.04 m)",
                     {0.01, 5.0}));
  VisitRange(v, "diameter_m", diameter_m,
             Assumed("diameter",
                     "usual rocks of nominal terrain; B up to the stripes' distance (0.185 m), "
                     "beyond which some stripe meets it",
                     {0.02, 5.0}));
}

void ThreeRockPrior::Visit(core::FieldVisitor& v) {
  VisitRange(
      v, "goal_m", goal_m,
      Assumed("start to goal, straight",
              "below the 8.1 m that were driven, around the 7.6 m of section 7", {3.0, 100.0}));
  v.Group("a", a, "the first rock, beside the line to the goal");
  v.Group("b", b, "the second rock, beside the way that the rover takes past A");
  v.Group("c", c, "the third rock, beside the way that the rover takes past B");
  v.Integer("tries", tries,
            Setting("most places of B, and of C, that one run tries until the drive goes as told",
                    {1, 1000000}));
}

void ThreeRockTold::Visit(core::FieldVisitor& v) {
  v.Real("length_m", length_m,
         Published("true length of the run", "Matthies 1995 sec. 5", {0.1, 1000.0}));
  v.Real("length_tolerance_m", length_tolerance_m, Setting("either way", {0.0, 1000.0}));
  v.Real("a_path_m", a_path_m,
         Published("path at which the rover turns in place to avoid rock A", "Matthies 1995 sec. 5",
                   {0.1, 1000.0}));
  v.Real("a_path_tolerance_m", a_path_tolerance_m, Setting("either way", {0.0, 1000.0}));
  v.Angle("c_turn_deg", c_turn_rad,
          Published("turn in place at rock C", "Matthies 1995 sec. 5: about 20 deg", {0.0, 360.0}));
  v.Angle("c_turn_tolerance_deg", c_turn_tolerance_rad, Setting("either way", {0.0, 360.0}));
  v.Integer("b_scrapes", b_scrapes,
            Setting("fewest scrapes of rock B, which was scraped considerably", {1, 100}));
  v.Boolean("false_alarm", false_alarm,
            Setting("a hazard is believed where there is none before rock A is detected, as in the "
                    "published run"));
}

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

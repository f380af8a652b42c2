#include "scenario/scenario.h"

namespace rockyard::scenario {
namespace {

// What no module can check alone.
void RequireConsistency(const Scenario& scenario, core::FieldVisitor& v) {
  const terrain::ArenaParams& arena = scenario.terrain.arena;
  const trial::CourseParams& course = scenario.course;
  v.Require("course.start_x_m", arena.HoldsCoursePoint(course.start_x_m, course.start_y_m),
            "puts the start outside of terrain.arena (or of the mirror lines of a virtual arena)",
            "move the start or enlarge the arena");
  v.Require("course.goal_x_m", arena.HoldsCoursePoint(course.goal_x_m, course.goal_y_m),
            "puts the goal outside of terrain.arena (or of the mirror lines of a virtual arena)",
            "move the goal or enlarge the arena");
  v.Require("course.goal_radius_m",
            course.goal_radius_m >= scenario.navigation.pathfinder.goal_tolerance_m,
            "is below navigation.pathfinder.goal_tolerance_m, so that a rover without any error "
            "could arrive falsely",
            "use a goal radius of at least the navigator's tolerance");
  const bool multibody = scenario.rover.fidelity == rover::Fidelity::kMultibody;
  const double step_s = multibody
                            ? scenario.rover.physics.time_scale * scenario.rover.physics.step_s
                            : scenario.rover.quasi_static.step_s;
  v.Require("clock.control_rate_hz", scenario.clock.control_rate_hz * step_s <= 1.0,
            "asks for more than one control step per rover.physics.step_s times time_scale "
            "(multibody) or "
            "rover.quasi_static.step_s (quasi_static)",
            "use a lower rate or a shorter physics step");
  v.Require("rover.fidelity",
            multibody || scenario.terrain.rocks.mobility == terrain::RockMobility::kFixed,
            "is quasi_static, which pushes no rocks, where terrain.rocks.mobility is movable",
            "use fidelity multibody or fixed rocks");
}

}  // namespace

void Scenario::Visit(core::FieldVisitor& v) {
  using core::Origin;
  v.Integer("schema_version", schema_version,
            {.doc = "version of this format", .min = 1, .max = 1, .origin = Origin::kSetting});
  v.Text("name", name, {.doc = "short name, used in reports", .origin = Origin::kSetting});
  v.Text("description", description, {.doc = "what it stands for", .origin = Origin::kSetting});
  v.Choice("experiment", experiment, {.doc = "what one run is", .origin = Origin::kSetting});
  v.Integer("trials", trials,
            {.doc = "number of runs", .min = 1, .max = 1e9, .origin = Origin::kSetting});
  v.Integer(
      "seed", seed,
      {.doc = "seed of every random stream", .min = 0, .max = 9e18, .origin = Origin::kSetting});
  v.Group("terrain", terrain, "ground, rocks and arena");
  v.Group("rover", rover, "the vehicle");
  v.Group("sensors", sensors, "what the rover measures");
  v.Group("perception", perception, "what the rover makes of its measurements");
  v.Group("navigation", navigation, "what the rover decides");
  v.Group("course", course, "start and goal");
  v.Group("referee", referee, "when a trial is over");
  v.Group("clock", clock, "simulated time");
  v.Group("energy", energy, "electrical power and batteries");
  RequireConsistency(*this, v);
}

}  // namespace rockyard::scenario

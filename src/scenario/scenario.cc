#include "scenario/scenario.h"

#include <algorithm>
#include <cmath>

#include "core/archive.h"
#include "core/error.h"
#include "rover/body_boxes_params.h"
#include "scenario/drive_checks.h"
#include "sensing/stripe_layout_params.h"
#include "sensing/stripe_view_params.h"

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

// The parameter of the navigator in use that says how near counts as arrived.
struct ArrivalTolerance {
  std::string_view reason;
  double tolerance_m;
};

ArrivalTolerance ToleranceOf(const NavigationParams& navigation) {
  switch (navigation.navigator) {
    case NavigatorKind::kPathfinder:
      break;
    case NavigatorKind::kGestalt:
      return {
          "is below navigation.gestalt.waypoints.goal_tolerance_m, so that a rover without any "
          "error could arrive falsely",
          navigation.gestalt.waypoints.goal_tolerance_m};
    case NavigatorKind::kRoute:
      return {
          "is below navigation.route.goal_tolerance_m, so that a rover without any error could "
          "arrive falsely",
          navigation.route.goal_tolerance_m};
  }
  return {
      "is below navigation.pathfinder.goal_tolerance_m, so that a rover without any error could "
      "arrive falsely",
      navigation.pathfinder.goal_tolerance_m};
}

// What an arrival of the navigator means.
void RequireArrival(const Scenario& scenario, core::FieldVisitor& v) {
  const ArrivalTolerance arrival = ToleranceOf(scenario.navigation);
  v.Require("course.goal_radius_m", scenario.course.goal_radius_m >= arrival.tolerance_m,
            arrival.reason, "use a goal radius of at least the navigator's tolerance");
}

// Whether the light stripe sensor has any part in the experiment.
bool UsesLightStripe(const Scenario& scenario) {
  return scenario.experiment == ExperimentKind::kHazardDetection ||
         scenario.sensors.terrain_sensor == TerrainSensor::kLightStripe;
}

// What the behaviour controller takes for left, centre and right.
void RequireStripes(const Scenario& scenario, core::FieldVisitor& v) {
  const NavigationParams& navigation = scenario.navigation;
  if (navigation.navigator != NavigatorKind::kPathfinder) return;
  const bool light_stripe = UsesLightStripe(scenario);
  v.Require("navigation.pathfinder.left_stripes",
            !light_stripe || navigation.pathfinder.stripe_count() ==
                                 sensing::ArraySize(scenario.sensors.light_stripe).stripes,
            "names with centre_stripes and right_stripes another number of stripes than "
            "sensors.light_stripe has",
            "name every stripe of a denser array, e.g. left [0, 1, 2, 3], centre [4], right [5, 6, "
            "7, 8]");
  v.Require("navigation.pathfinder.left_stripes",
            light_stripe || static_cast<std::int64_t>(navigation.pathfinder.stripe_count()) ==
                                scenario.perception.cloud_elevations.stripes,
            "names with centre_stripes and right_stripes another number of stripes than "
            "perception.cloud_elevations.stripes",
            "name every stripe of the array, from left to right");
}

void RequireFinder(const Scenario& scenario, core::FieldVisitor& v) {
  if (!UsesLightStripe(scenario)) return;
  const sensing::LightStripeParams& sensor = scenario.sensors.light_stripe;
  v.Require(
      "perception.stripe_finder.averaging_px",
      sensor.fidelity == sensing::Fidelity::kGeometric ||
          scenario.perception.stripe_finder.averaging_px <=
              sensor.imager.averaging_rows + 2 * sensor.imager.margin_rows,
      "is more than the image lines that sensors.light_stripe.imager reads around a scanline, "
      "so that no point would ever be found",
      "use at most its averaging_rows plus twice its margin_rows");
}

// Images show the rover itself, rays do not.
void RequireFreeView(const Scenario& scenario, core::FieldVisitor& v) {
  if (!UsesLightStripe(scenario)) return;
  const sensing::LightStripeParams& sensor = scenario.sensors.light_stripe;
  v.Require("sensors.light_stripe.fidelity",
            sensor.fidelity == sensing::Fidelity::kGeometric ||
                !sensing::IsHiddenBy(sensor, rover::BodyBoxes(scenario.rover.geometry)),
            "is image, where chassis or solar panel hide a point on flat ground from a camera or a "
            "light emitter",
            "mount both below the front edge of the panel, as camera_height_m and "
            "emitter_height_m 0.25 do on Rocky 3.2, or ahead of it");
}

// A list that takes the place of terrain.rocks.k_per_m2 keeps the condition of that field.
void RequireFields(const Scenario& scenario, core::FieldVisitor& v) {
  const experiments::HazardDetectionParams& study = scenario.hazard_detection;
  if (study.study != experiments::HazardStudy::kMissed) return;
  const terrain::RockFieldParams& rocks = scenario.terrain.rocks;
  v.Require("terrain.rocks.kind", rocks.kind == terrain::RockFieldKind::kMoore,
            "is not moore, so that hazard_detection.rock_k_per_m2 would change nothing",
            "use kind moore");
  v.Require("hazard_detection.rock_k_per_m2",
            std::all_of(study.rock_k_per_m2.begin(), study.rock_k_per_m2.end(),
                        [&](double k_per_m2) { return k_per_m2 <= rocks.k_reference_per_m2; }),
            "has a value larger than terrain.rocks.k_reference_per_m2",
            "raise k_reference_per_m2 to at least the largest value of the list");
  const trial::CourseParams& course = scenario.course;
  v.Require("course.goal_y_m",
            course.goal_y_m == course.start_y_m && course.start_heading_rad == 0.0,
            "or start_heading_deg asks for another drive than straight along x",
            "use start_y_m, and a heading of 0");
  v.Require("course.goal_x_m",
            course.goal_x_m - course.start_x_m > study.first_scan_m + study.scan_interval_m,
            "lies nearer to the start than hazard_detection.first_scan_m and scan_interval_m "
            "together, so that no hazard could be scanned before it is met",
            "move the goal away, or begin to scan later");
}

// Whether the sensor can be built with the emitters at this baseline.
bool HoldsBaseline(sensing::LightStripeParams sensor, double baseline_m) {
  sensor.inner_emitter_y_m = experiments::BaselineEmitterY(sensor.camera_separation_m, baseline_m);
  sensor.outer_emitter_y_m = sensor.inner_emitter_y_m;
  try {
    core::ReadParams(core::WriteParams(sensor), sensor);
  } catch (const core::UserError&) {
    return false;
  }
  return true;
}

// Emitters that the study "precision" moves, and planes that no scan would find.
void RequirePlanes(const Scenario& scenario, core::FieldVisitor& v) {
  const experiments::HazardDetectionParams& study = scenario.hazard_detection;
  if (study.study != experiments::HazardStudy::kPrecision) return;
  const sensing::LightStripeParams& sensor = scenario.sensors.light_stripe;
  const bool on_axis = std::abs(sensor.emitter_height_m - sensor.camera_height_m) < kSame_m &&
                       std::abs(sensor.emitter_x_m - sensor.camera_x_m) < kSame_m;
  v.Require("sensors.light_stripe.emitter_height_m", on_axis,
            "or emitter_x_m puts the emitters beside the cameras' axis, along which the study "
            "precision moves them",
            "use emitter_height_m = camera_height_m and emitter_x_m = camera_x_m");
  v.Require(
      "hazard_detection.baselines_m",
      !on_axis || std::all_of(study.baselines_m.begin(), study.baselines_m.end(),
                              [&](double baseline_m) { return HoldsBaseline(sensor, baseline_m); }),
      "puts an emitter where sensors.light_stripe cannot work",
      "use shorter baselines, or move the stripes (inner_stripe_y_m, outer_stripe_y_m)");
  const double half_m = 0.5 * study.plane_width_m;
  v.Require("hazard_detection.plane_heights_m",
            std::all_of(study.plane_heights_m.begin(), study.plane_heights_m.end(),
                        [&](double height_m) {
                          const double elevation_m = height_m - sensor.datum_z_m;
                          return elevation_m - half_m >= sensor.search_low_m &&
                                 elevation_m + half_m <= sensor.search_high_m;
                        }),
            "and plane_width_m reach beyond the elevations that sensors.light_stripe searches",
            "use heights between its search_low_m and search_high_m");
}

// What the experiment "hazard_detection" takes for granted.
void RequireMeasurable(const Scenario& scenario, core::FieldVisitor& v) {
  if (scenario.experiment != ExperimentKind::kHazardDetection) return;
  const experiments::HazardDetectionParams& study = scenario.hazard_detection;
  const sensing::LightStripeParams& sensor = scenario.sensors.light_stripe;
  v.Require("sensors.terrain_sensor",
            scenario.sensors.terrain_sensor == TerrainSensor::kLightStripe,
            "is not light_stripe, the sensor that the experiment hazard_detection measures",
            "use light_stripe");
  const terrain::GroundParams& ground = scenario.terrain.ground;
  v.Require("terrain.ground.slope_deg", ground.slope_rad == 0.0 && ground.roughness_rms_m == 0.0,
            "or roughness_rms_m is not 0, where the experiment measures on flat sand",
            "leave the ground flat");
  v.Require("perception.hazard.agreement",
            scenario.perception.hazard.agreement != perception::ScanAgreement::kConsecutiveMoving,
            "is consecutive_moving, where the experiment judges every pose on its own",
            "use rescan_same_pose or single_scan");
  const double rows = static_cast<double>(sensing::ArraySize(sensor).rows);
  v.Require("hazard_detection.rows",
            std::all_of(study.rows.begin(), study.rows.end(),
                        [&](double row) { return row < rows && row == std::floor(row); }),
            "names a row that sensors.light_stripe does not have", "count its rows from 0");
  RequireFields(scenario, v);
  RequirePlanes(scenario, v);
  if (study.study != experiments::HazardStudy::kFalseAlarm) return;
  const bool images = sensor.fidelity == sensing::Fidelity::kImage;
  v.Require("hazard_detection.sun_elevations_deg",
            images || (study.sun_elevations_deg.empty() && study.laser_powers_w.empty()),
            "or laser_powers_w is given, but both act on images only",
            "use sensors.light_stripe.fidelity image, or leave the lists empty");
  v.Require(
      "hazard_detection.wrong_place_probabilities",
      !images || (study.wrong_place_probabilities.empty() && study.outlier_persistences.empty()),
      "or outlier_persistences is given, but in images points go wrong by themselves",
      "leave both lists empty, or use sensors.light_stripe.fidelity geometric");
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
  v.Group("hazard_detection", hazard_detection, "the experiment of that name");
  RequireConsistency(*this, v);
  RequireArrival(*this, v);
  RequireStripes(*this, v);
  RequireFinder(*this, v);
  RequireFreeView(*this, v);
  RequireMeasurable(*this, v);
  RequireSoundDrive(*this, v);
}

}  // namespace rockyard::scenario

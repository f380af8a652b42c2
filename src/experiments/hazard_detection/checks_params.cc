#include "experiments/hazard_detection/checks_params.h"

#include <algorithm>
#include <cmath>

#include "core/archive.h"
#include "core/error.h"
#include "sensing/stripe_layout_params.h"
#include "trial/drive_checks_params.h"

namespace rockyard::experiments {
namespace {

// A list that takes the place of terrain.rocks.k_per_m2 keeps the condition of that field.
void RequireFields(const HazardDetectionParams& study, const trial::DriveParams& drive,
                   core::FieldVisitor& v) {
  if (study.study != HazardStudy::kMissed) return;
  const terrain::RockFieldParams& rocks = drive.terrain.rocks;
  v.Require("terrain.rocks.kind", rocks.kind == terrain::RockFieldKind::kMoore,
            "is not moore, so that hazard_detection.rock_k_per_m2 would change nothing",
            "use kind moore");
  v.Require("hazard_detection.rock_k_per_m2",
            std::all_of(study.rock_k_per_m2.begin(), study.rock_k_per_m2.end(),
                        [&](double k_per_m2) { return k_per_m2 <= rocks.k_reference_per_m2; }),
            "has a value larger than terrain.rocks.k_reference_per_m2",
            "raise k_reference_per_m2 to at least the largest value of the list");
  const trial::CourseParams& course = drive.course;
  v.Require("course.goal_y_m",
            course.goal_y_m == course.start_y_m && course.start_heading_rad == 0.0,
            "or start_heading_deg asks for another drive than straight along x",
            "use start_y_m, and a heading of 0");
  v.Require("course.waypoints.x_m", course.waypoints.x_m.empty(),
            "names waypoints, to which the study does not drive", "leave the waypoints out");
  v.Require("course.goal_x_m",
            course.goal_x_m - course.start_x_m > study.first_scan_m + study.scan_interval_m,
            "lies nearer to the start than hazard_detection.first_scan_m and scan_interval_m "
            "together, so that no hazard could be scanned before it is met",
            "move the goal away, or begin to scan later");
}

// Whether the sensor can be built with the emitters at this baseline.
bool HoldsBaseline(sensing::LightStripeParams sensor, double baseline_m) {
  sensor.inner_emitter_y_m = BaselineEmitterY(sensor.camera_separation_m, baseline_m);
  sensor.outer_emitter_y_m = sensor.inner_emitter_y_m;
  try {
    core::ReadParams(core::WriteParams(sensor), sensor);
  } catch (const core::UserError&) {
    return false;
  }
  return true;
}

// Emitters that the study "precision" moves, and planes that no scan would find.
void RequirePlanes(const HazardDetectionParams& study, const trial::DriveParams& drive,
                   core::FieldVisitor& v) {
  if (study.study != HazardStudy::kPrecision) return;
  const sensing::LightStripeParams& sensor = drive.sensors.light_stripe;
  const bool on_axis =
      std::abs(sensor.emitter_height_m - sensor.camera_height_m) < trial::kSame_m &&
      std::abs(sensor.emitter_x_m - sensor.camera_x_m) < trial::kSame_m;
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

}  // namespace

void RequireMeasurable(const HazardDetectionParams& study, const trial::DriveParams& drive,
                       core::FieldVisitor& v) {
  const sensing::LightStripeParams& sensor = drive.sensors.light_stripe;
  v.Require("sensors.terrain_sensor",
            drive.sensors.terrain_sensors.chosen().name() == "light_stripe",
            "is not light_stripe, the sensor that the experiment hazard_detection measures",
            "use light_stripe");
  const terrain::GroundParams& ground = drive.terrain.ground;
  v.Require("terrain.ground.slope_deg", ground.IsLevel(),
            "or roughness_rms_m is not 0, or there are ditches or pits, where the experiment "
            "measures on flat "
            "sand",
            "leave the ground flat");
  v.Require("perception.hazard.agreement",
            drive.perception.hazard.agreement != perception::ScanAgreement::kConsecutiveMoving,
            "is consecutive_moving, where the experiment judges every pose on its own",
            "use rescan_same_pose or single_scan");
  const double rows = static_cast<double>(sensing::ArraySize(sensor).rows);
  v.Require("hazard_detection.rows",
            std::all_of(study.rows.begin(), study.rows.end(),
                        [&](double row) { return row < rows && row == std::floor(row); }),
            "names a row that sensors.light_stripe does not have", "count its rows from 0");
  RequireFields(study, drive, v);
  RequirePlanes(study, drive, v);
  if (study.study != HazardStudy::kFalseAlarm) return;
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

}  // namespace rockyard::experiments

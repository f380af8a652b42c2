#include "experiments/hazard_detection/hazard_detection_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/archive.h"
#include "core/error.h"
#include "core/sources.h"
#include "sensing/stripe_layout_params.h"
#include "trial/drive_checks_params.h"

namespace rockyard::experiments {
namespace {

using core::Assumed;
using core::FieldInfo;
using core::kMatthiesSection6;
using core::Published;
using core::Setting;

// Least baseline: nearer emitters are looked at by the camera of the other side
// (sensing/stripe_layout_params.h).
constexpr double kMinBaseline_m = 0.05;
constexpr double kLeastHeight_m = 0.001;  // far below what any sensor tells from the ground

bool AtLeast(const std::vector<double>& values, double low) {
  return std::all_of(values.begin(), values.end(), [&](double value) { return value >= low; });
}

// Returns whether each value is 0, or no less than `low`.
bool AreNoneOrAtLeast(const std::vector<double>& values, double low) {
  return std::all_of(values.begin(), values.end(),
                     [&](double value) { return value == 0.0 || value >= low; });
}

void VisitList(core::FieldVisitor& v, std::string_view name, std::vector<double>& values,
               const FieldInfo& info) {
  v.Reals(name, values, info);
  v.Require(name, !values.empty(), "is an empty list", "list at least one value");
}

void VisitRocks(HazardDetectionParams& p, core::FieldVisitor& v) {
  v.Choice("proportions", p.proportions,
           Setting("listed: every height with every diameter; natural: the diameter follows from "
                   "the height by terrain.rocks' ratios, diameters_m is not used"));
  VisitList(v, "heights_m", p.heights_m,
            Setting("heights of the rock above the ground; 0 is no rock", {0.0, 2.0}));
  v.Require("heights_m", AreNoneOrAtLeast(p.heights_m, kLeastHeight_m),
            fmt::format("has a height between 0 and {} m", kLeastHeight_m),
            fmt::format("use 0 for no rock, or at least {}", kLeastHeight_m));
  VisitList(v, "diameters_m", p.diameters_m,
            Setting("largest horizontal diameters of the rock", {0.01, 5.0}));
  VisitList(v, "lateral_offsets_m", p.lateral_offsets_m,
            Setting("middle of the rock beside the rover's course, to the left or to the right",
                    {0.0, 5.0}));
  VisitList(v, "distances_m", p.distances_m,
            Setting("from the rover's front to the nearest end of the rock; study detection",
                    {-10.0, 10.0}));
  v.Real("lateral_width_m", p.lateral_width_m,
         Setting("width of a cell of offsets: the offset is uniform within half of it on each side",
                 {0.0, 5.0}));
  v.Real("distance_width_m", p.distance_width_m, Setting("the same for distances", {0.0, 5.0}));
  v.Angle("heading_jitter_deg", p.heading_jitter_rad,
          Setting("the rover's heading is uniform within this on each side of its course",
                  {0.0, 90.0}));
  v.Require("distances_m", AtLeast(p.distances_m, 0.5 * p.distance_width_m),
            "puts a rock inside the rover: a cell reaches behind the rover's front",
            "use distances of at least half of distance_width_m");
}

void VisitApproach(HazardDetectionParams& p, core::FieldVisitor& v) {
  v.Real("scan_interval_m", p.scan_interval_m,
         Published("distance driven between scans, at a random phase", kMatthiesSection6,
                   {0.001, 10.0}));
  v.Real("first_scan_m", p.first_scan_m,
         Assumed("scans start this far before a rock", "beyond the farthest row at 0.3 m",
                 {0.0, 10.0}, {0.35, 0.6}));
  v.Require("first_scan_m", p.first_scan_m >= p.scan_interval_m,
            "is shorter than scan_interval_m, so that some drives hold no scan",
            "start at least one interval before the rock");
}

void VisitAlarms(HazardDetectionParams& p, core::FieldVisitor& v) {
  v.Reals("wrong_place_probabilities", p.wrong_place_probabilities,
          Setting("values of sensors.light_stripe.wrong_place_probability, geometric level only; "
                  "empty: the sensor's own; study false_alarm",
                  {0.0, 1.0}));
  v.Reals("outlier_persistences", p.outlier_persistences,
          Setting("values of sensors.light_stripe.outlier_persistence, geometric level only; "
                  "empty: the sensor's own",
                  {0.0, 0.99}));
  v.Reals("sun_elevations_deg", p.sun_elevations_deg,
          Setting("elevations of the sun, image level only; empty: the sensor's own", {0.0, 90.0}));
  v.Reals("laser_powers_w", p.laser_powers_w,
          Setting("electrical inputs of a laser, image level only; empty: the sensor's own",
                  {1e-6, 100.0}));
}

void VisitFields(HazardDetectionParams& p, core::FieldVisitor& v) {
  VisitList(v, "rock_k_per_m2", p.rock_k_per_m2,
            Setting("values of terrain.rocks.k_per_m2; study missed", {0.0, 0.1}));
  v.Real(
      "hazard_height_m", p.hazard_height_m,
      Published("a rock in the way is a hazard from this height",
                "Matthies 1995 sec. 6: the undercarriage is 13 cm off the ground", {0.001, 10.0}));
}

void VisitPlanes(HazardDetectionParams& p, core::FieldVisitor& v) {
  VisitList(
      v, "baselines_m", p.baselines_m,
      Published("camera-to-emitter baselines to which the emitters are moved; study precision",
                "Matthies 1995 table 3: 5 to 10 cm; cameras 12 cm apart", {kMinBaseline_m, 1.0}));
  VisitList(v, "plane_heights_m", p.plane_heights_m,
            Setting("heights of the plane against the wheels", {-5.0, 5.0}));
  VisitList(v, "rows", p.rows, Setting("rows of the array, 0 is the nearest", {0.0, 6.0}));
  v.Real("plane_width_m", p.plane_width_m,
         Setting("the height is uniform within half of this on each side: without it a plane meets "
                 "one part of a pixel only",
                 {0.0, 1.0}));
}

// Requires of rock_k_per_m2, which takes the place of terrain.rocks.k_per_m2, what that field
// requires.
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

// Returns whether the sensor can be built with the emitters at this baseline.
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

// Refuses emitters that the study "precision" cannot move, and planes that no scan would find.
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

std::vector<CellFactor> HazardDetectionParams::Factors() const {
  std::vector<CellFactor> factors;
  switch (study) {
    case HazardStudy::kDetection:
    case HazardStudy::kApproach:
      factors.push_back({"height_m", heights_m});
      if (proportions == RockProportions::kListed) factors.push_back({"diameter_m", diameters_m});
      factors.push_back({"lateral_offset_m", lateral_offsets_m});
      if (study == HazardStudy::kDetection) factors.push_back({"distance_m", distances_m});
      break;
    case HazardStudy::kFalseAlarm:
      if (!wrong_place_probabilities.empty()) {
        factors.push_back({"wrong_place_probability", wrong_place_probabilities});
      }
      if (!outlier_persistences.empty()) {
        factors.push_back({"outlier_persistence", outlier_persistences});
      }
      if (!sun_elevations_deg.empty()) factors.push_back({"sun_elevation_deg", sun_elevations_deg});
      if (!laser_powers_w.empty()) factors.push_back({"laser_power_w", laser_powers_w});
      break;
    case HazardStudy::kMissed:
      factors.push_back({"rock_k_per_m2", rock_k_per_m2});
      break;
    case HazardStudy::kPrecision:
      factors.push_back({"baseline_m", baselines_m});
      factors.push_back({"row", rows});
      factors.push_back({"plane_height_m", plane_heights_m});
      break;
  }
  return factors;
}

void HazardDetectionParams::Visit(core::FieldVisitor& v) {
  v.Choice("study", study, Setting("what is measured"));
  v.Integer(
      "scenes_per_run", scenes_per_run,
      Setting(
          "independent scenes of one cell in one run; run i belongs to cell i modulo their number",
          {1, 100000}));
  VisitRocks(*this, v);
  VisitApproach(*this, v);
  VisitAlarms(*this, v);
  VisitFields(*this, v);
  VisitPlanes(*this, v);
  v.Require("study", Cells() <= kMaxCells, "spans more than 2000 cells",
            "shorten the lists of this study");
}

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

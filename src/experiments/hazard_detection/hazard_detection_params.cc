#include "experiments/hazard_detection/hazard_detection_params.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/sources.h"

namespace rockyard::experiments {
namespace {

using core::FieldInfo;
using core::Origin;

using core::kMatthiesSection6;
// Nearer emitters are looked at by the camera of the other side (sensing/stripe_layout_params.h).
constexpr double kMinBaseline_m = 0.05;
constexpr double kLeastHeight_m = 0.001;  // far below what any sensor tells from the ground

bool AtLeast(const std::vector<double>& values, double low) {
  return std::all_of(values.begin(), values.end(), [&](double value) { return value >= low; });
}

// Each value 0, or no less than `low`.
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
           {.doc = "listed: every height with every diameter; natural: the diameter follows from "
                   "the height by terrain.rocks' ratios, diameters_m is not used",
            .origin = Origin::kSetting});
  VisitList(v, "heights_m", p.heights_m,
            {.doc = "heights of the rock above the ground; 0 is no rock",
             .min = 0.0,
             .max = 2.0,
             .origin = Origin::kSetting});
  v.Require("heights_m", AreNoneOrAtLeast(p.heights_m, kLeastHeight_m),
            fmt::format("has a height between 0 and {} m", kLeastHeight_m),
            fmt::format("use 0 for no rock, or at least {}", kLeastHeight_m));
  VisitList(v, "diameters_m", p.diameters_m,
            {.doc = "largest horizontal diameters of the rock",
             .min = 0.01,
             .max = 5.0,
             .origin = Origin::kSetting});
  VisitList(v, "lateral_offsets_m", p.lateral_offsets_m,
            {.doc = "middle of the rock beside the rover's course, to the left or to the right",
             .min = 0.0,
             .max = 5.0,
             .origin = Origin::kSetting});
  VisitList(v, "distances_m", p.distances_m,
            {.doc = "from the rover's front to the nearest end of the rock; study detection",
             .min = -10.0,
             .max = 10.0,
             .origin = Origin::kSetting});
  v.Real("lateral_width_m", p.lateral_width_m,
         {.doc = "width of a cell of offsets: the offset is uniform within half of it on each side",
          .min = 0.0,
          .max = 5.0,
          .origin = Origin::kSetting});
  v.Real("distance_width_m", p.distance_width_m,
         {.doc = "the same for distances", .min = 0.0, .max = 5.0, .origin = Origin::kSetting});
  v.Angle("heading_jitter_deg", p.heading_jitter_rad,
          {.doc = "the rover's heading is uniform within this on each side of its course",
           .min = 0.0,
           .max = 90.0,
           .origin = Origin::kSetting});
  v.Require("distances_m", AtLeast(p.distances_m, 0.5 * p.distance_width_m),
            "puts a rock inside the rover: a cell reaches behind the rover's front",
            "use distances of at least half of distance_width_m");
}

void VisitApproach(HazardDetectionParams& p, core::FieldVisitor& v) {
  v.Real("scan_interval_m", p.scan_interval_m,
         {.doc = "distance driven between scans, at a random phase",
          .min = 0.001,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = kMatthiesSection6});
  v.Real("first_scan_m", p.first_scan_m,
         {.doc = "scans start this far before a rock",
          .min = 0.0,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "beyond the farthest row at 0.3 m",
          .study_low = 0.35,
          .study_high = 0.6});
  v.Require("first_scan_m", p.first_scan_m >= p.scan_interval_m,
            "is shorter than scan_interval_m, so that some drives hold no scan",
            "start at least one interval before the rock");
}

void VisitAlarms(HazardDetectionParams& p, core::FieldVisitor& v) {
  v.Reals("wrong_place_probabilities", p.wrong_place_probabilities,
          {.doc = "values of sensors.light_stripe.wrong_place_probability, geometric level only; "
                  "empty: the sensor's own; study false_alarm",
           .min = 0.0,
           .max = 1.0,
           .origin = Origin::kSetting});
  v.Reals("outlier_persistences", p.outlier_persistences,
          {.doc = "values of sensors.light_stripe.outlier_persistence, geometric level only; "
                  "empty: the sensor's own",
           .min = 0.0,
           .max = 0.99,
           .origin = Origin::kSetting});
  v.Reals("sun_elevations_deg", p.sun_elevations_deg,
          {.doc = "elevations of the sun, image level only; empty: the sensor's own",
           .min = 0.0,
           .max = 90.0,
           .origin = Origin::kSetting});
  v.Reals("laser_powers_w", p.laser_powers_w,
          {.doc = "electrical inputs of a laser, image level only; empty: the sensor's own",
           .min = 1e-6,
           .max = 100.0,
           .origin = Origin::kSetting});
}

void VisitFields(HazardDetectionParams& p, core::FieldVisitor& v) {
  VisitList(v, "rock_k_per_m2", p.rock_k_per_m2,
            {.doc = "values of terrain.rocks.k_per_m2; study missed",
             .min = 0.0,
             .max = 0.1,
             .origin = Origin::kSetting});
  v.Real("hazard_height_m", p.hazard_height_m,
         {.doc = "a rock in the way is a hazard from this height",
          .min = 0.001,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 6: the undercarriage is 13 cm off the ground"});
}

void VisitPlanes(HazardDetectionParams& p, core::FieldVisitor& v) {
  VisitList(v, "baselines_m", p.baselines_m,
            {.doc = "camera-to-emitter baselines to which the emitters are moved; study precision",
             .min = kMinBaseline_m,
             .max = 1.0,
             .origin = Origin::kPublished,
             .source = "Matthies 1995 table 3: 5 to 10 cm; cameras 12 cm apart"});
  VisitList(v, "plane_heights_m", p.plane_heights_m,
            {.doc = "heights of the plane against the wheels",
             .min = -5.0,
             .max = 5.0,
             .origin = Origin::kSetting});
  VisitList(v, "rows", p.rows,
            {.doc = "rows of the array, 0 is the nearest",
             .min = 0.0,
             .max = 6.0,
             .origin = Origin::kSetting});
  v.Real("plane_width_m", p.plane_width_m,
         {.doc = "the height is uniform within half of this on each side: without it a plane meets "
                 "one part of a pixel only",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kSetting});
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
  v.Choice("study", study, {.doc = "what is measured", .origin = Origin::kSetting});
  v.Integer("scenes_per_run", scenes_per_run,
            {.doc = "independent scenes of one cell in one run; run i belongs to cell i modulo "
                    "their number",
             .min = 1,
             .max = 100000,
             .origin = Origin::kSetting});
  VisitRocks(*this, v);
  VisitApproach(*this, v);
  VisitAlarms(*this, v);
  VisitFields(*this, v);
  VisitPlanes(*this, v);
  v.Require("study", Cells() <= kMaxCells, "spans more than 2000 cells",
            "shorten the lists of this study");
}

}  // namespace rockyard::experiments

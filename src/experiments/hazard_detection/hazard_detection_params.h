// Parameters of the experiment "hazard_detection", on the detection performance of the light stripe
// sensor. A default decides the records of scenarios that leave it out; a bound only refuses files.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/fields.h"
#include "experiments/cell_factor_params.h"
#include "math/angles.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// What is measured.
enum class HazardStudy {
  kDetection,   // one rock before a rover that stands
  kApproach,    // one rock on the course of a rover that drives on to it
  kFalseAlarm,  // flat sand
  kMissed,      // hazards on straight drives through random fields
  kPrecision,   // range and elevation of a plane
};

// How the rock of a scene is proportioned.
enum class RockProportions {
  kListed,   // every height with every diameter
  kNatural,  // the diameter follows from the height by the terrain's height ratios and burial
};

// Returns y of the left emitter that stands on the cameras' axis, baseline_m outwards from the left
// camera. The study "precision" moves emitters there (WithBaseline), and the condition on
// baselines_m asks whether the sensor works there (HoldsBaseline).
constexpr double BaselineEmitterY(double camera_separation_m, double baseline_m) {
  return 0.5 * camera_separation_m + baseline_m;
}

struct HazardDetectionParams {
  HazardStudy study = HazardStudy::kDetection;
  std::int64_t scenes_per_run = 500;

  RockProportions proportions = RockProportions::kListed;
  std::vector<double> heights_m{0.05, 0.10, 0.15};
  std::vector<double> diameters_m{0.15, 0.25};
  std::vector<double> lateral_offsets_m{0.0, 0.15};
  std::vector<double> distances_m{0.08, 0.20};
  double lateral_width_m = 0.0;
  double distance_width_m = 0.0;
  double heading_jitter_rad = 0.0;

  double scan_interval_m = 0.065;
  double first_scan_m = 0.40;

  std::vector<double> wrong_place_probabilities;
  std::vector<double> outlier_persistences;
  std::vector<double> sun_elevations_deg;
  std::vector<double> laser_powers_w;

  std::vector<double> rock_k_per_m2{0.00415, 0.013};
  double hazard_height_m = 0.13;

  std::vector<double> baselines_m{0.05, 0.08};
  std::vector<double> plane_heights_m{0.0};
  double plane_width_m = 0.01;
  std::vector<double> rows{0.0, 1.0, 2.0, 3.0};

  // Returns the factors of the chosen study in the order of their columns, the last one changing
  // fastest. Studies read their values by place.
  std::vector<CellFactor> Factors() const;
  double Cells() const { return CellsOf(Factors()); }

  void Visit(core::FieldVisitor& v);
};

// Requires that the light stripe is the sensor in use, on flat ground, with scans that each pose
// takes for itself, and that the lists of the study in use ask for what sensor, rocks and course
// can show. Each failure names the parameter, what is wrong and a remedy.
void RequireMeasurable(const HazardDetectionParams& study, const trial::DriveParams& drive,
                       core::FieldVisitor& v);

}  // namespace rockyard::experiments

template <>
struct rockyard::core::EnumNames<rockyard::experiments::HazardStudy> {
  static constexpr std::array<std::string_view, 5> kNames{"detection", "approach", "false_alarm",
                                                          "missed", "precision"};
};

template <>
struct rockyard::core::EnumNames<rockyard::experiments::RockProportions> {
  static constexpr std::array<std::string_view, 2> kNames{"listed", "natural"};
};

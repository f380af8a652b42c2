// Parameters of hazard detection with the light stripe sensor (Matthies 1995, section 6), or with
// stereo points that are binned to an array like its own (cloud_elevations.h); and thresholds of
// the hazards that the Pathfinder rover feels rather than sees. HazardDetector and
// VehicleHazardDetector read them. The paper gives the three criteria and one threshold, and for
// felt hazards the sensors alone; what is assumed says so. Defaults decide records and baselines.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::perception {

// Which stripes a too large difference between two neighbouring points is charged to.
enum class NeighbourBlame {
  kFartherFromDatum,  // the stripe of the point farther from the datum plane; both on a tie
  kHigher,            // the stripe of the higher point
  kBoth,              // the stripes of both points
};

// Which stripes a too large range of elevations over the whole array is charged to.
enum class RangeBlame {
  kFartherFromDatum,  // the stripe of the extreme farther from the datum plane; both on a tie
  kExtremes,          // the stripes of the highest and of the lowest point
  kAllStripes,
};

// Which scans have to agree before a detected hazard is believed.
enum class ScanAgreement {
  kSingleScan,         // none: every detection is believed
  kRescanSamePose,     // a detection triggers another scan at the same pose
  kConsecutiveMoving,  // a scan has to agree with the one before it, taken wherever it was
};

// What follows when two scans that both show a hazard do not agree. A later scan without a hazard
// is clear at once, whatever this says.
enum class Disagreement {
  kScanAgain,      // look again and compare with the newest, up to max_scans; then as on_exhausted
  kTrustLast,      // believe the newest scan alone
  kTreatAsHazard,  // believe the hazards of both scans
  kTreatAsClear,   // believe none
};

struct HazardParams {
  bool enabled = true;
  double neighbour_threshold_m = 0.05;
  double range_threshold_m = 0.13;
  std::int64_t neighbour_reach = 1;
  NeighbourBlame neighbour_blame = NeighbourBlame::kFartherFromDatum;
  RangeBlame range_blame = RangeBlame::kFartherFromDatum;
  ScanAgreement agreement = ScanAgreement::kRescanSamePose;
  double agree_m = 0.02;
  Disagreement on_disagreement = Disagreement::kScanAgain;
  std::int64_t max_scans = 5;
  Disagreement on_exhausted = Disagreement::kTrustLast;

  void Visit(core::FieldVisitor& v);
};

// Thresholds of felt hazards. A criterion works where its sensor is on board (sensors.vehicle).
struct VehicleHazardParams {
  double max_tilt_rad = math::DegToRad(25.0);
  double max_rocker_rad = math::DegToRad(15.0);
  double max_bogie_rad = math::DegToRad(44.0);
  double max_current_A = 0.18;
  double max_turn_share = 0.2;
  std::int64_t tilt_ticks = 2;
  std::int64_t articulation_ticks = 2;
  std::int64_t current_ticks = 30;
  std::int64_t contact_ticks = 1;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::perception

template <>
struct rockyard::core::EnumNames<rockyard::perception::NeighbourBlame> {
  static constexpr std::array<std::string_view, 3> kNames{"farther_from_datum", "higher", "both"};
};

template <>
struct rockyard::core::EnumNames<rockyard::perception::RangeBlame> {
  static constexpr std::array<std::string_view, 3> kNames{"farther_from_datum", "extremes",
                                                          "all_stripes"};
};

template <>
struct rockyard::core::EnumNames<rockyard::perception::ScanAgreement> {
  static constexpr std::array<std::string_view, 3> kNames{"single_scan", "rescan_same_pose",
                                                          "consecutive_moving"};
};

template <>
struct rockyard::core::EnumNames<rockyard::perception::Disagreement> {
  static constexpr std::array<std::string_view, 4> kNames{"scan_again", "trust_last",
                                                          "treat_as_hazard", "treat_as_clear"};
};

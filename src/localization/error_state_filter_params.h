// Parameters of the error-state filter: how well it believes to know its sensors. The simulated
// sensors have parameters of their own (sensors.gyro and others); where a scenario changes a
// simulated sensor, nothing makes the filter's belief follow. Meanings and sources stand in the
// .cc.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::localization {

// How far off things may be when a drive begins: standard deviations.
struct PriorParams {
  double position_sd_m = 0.0;
  double heading_sd_rad = 0.0;
  double gyro_bias_sd_rad_s = 0.0;
  double gyro_scale_sd = 0.06;
  double wheel_scale_sd = 0.05;

  void Visit(core::FieldVisitor& v);
};

// How the error grows on the way.
struct DriftParams {
  double heading_variance_deg2_per_m = 0.70;
  double reference_speed_m_s = 0.15;
  bool drifts_at_rest = false;
  double gyro_bias_walk_rad_s = 0.0;
  double distance_variance_m2_per_m = 0.0039;
  double scrapes_per_m = 0.0;
  double scrape_jump_rad = math::DegToRad(5.0);
  double height_variance_m2_per_m = 1e-4;
  double tilt_sd_rad = math::DegToRad(1.0);
  double tilt_length_m = 0.1;

  // Returns the growth of the heading's variance in time, while the rover moves, rad2/s.
  double heading_variance_rad2_per_s() const {
    const double rad_per_deg = math::DegToRad(1.0);
    return heading_variance_deg2_per_m * rad_per_deg * rad_per_deg * reference_speed_m_s;
  }

  void Visit(core::FieldVisitor& v);
};

// Which measurements are believed (aid_fixes.h).
struct GateParams {
  double chance = 1e-3;
  std::int64_t patience = 3;

  void Visit(core::FieldVisitor& v);
};

// What the filter makes of a motion between two moments that is too far from what it believes.
enum class MotionDisagreement {
  kDoubtWheels,  // takes the motion: wheels slipped, or the gyro was shaken, by the difference
  kTurnAway,     // takes the motion for wrong, however many are turned away in a row
};

// All parameters of the filter.
struct ErrorStateFilterParams {
  PriorParams prior{};
  DriftParams drift{};
  GateParams gate{};
  MotionDisagreement motion_disagreement = MotionDisagreement::kDoubtWheels;
  double stretch_m = 0.067;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::localization

template <>
struct rockyard::core::EnumNames<rockyard::localization::MotionDisagreement> {
  static constexpr std::array<std::string_view, 2> kNames{"doubt_wheels", "turn_away"};
};

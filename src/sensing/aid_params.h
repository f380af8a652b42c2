// Parameters of the aids of localization.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "sensing/cylinder_law_params.h"

namespace rockyard::sensing {

// When an aid takes its data, and how long these take to reach the estimator.
struct AidScheduleParams {
  bool enabled = false;
  double every_m = 0.0;  // of odometer; 0: not by way
  double every_s = 0.0;  // of simulated time; 0: not by time
  double delay_s = 0.0;

  void Visit(core::FieldVisitor& v);
};

enum class LanderFixLaw {
  kConstant,  // one deviation each, whatever the lander sees of the rover
  kCylinder,  // as the coloured cylinder is seen (sensing/cylinder_law.h)
};

// The lander finds the rover in its stereo images (Matthies 1995, section 5).
struct LanderFixParams {
  AidScheduleParams schedule{.every_m = 10.0};
  double heading_sd_rad = math::DegToRad(5.0);
  double range_sd_fraction = 0.05;
  double bearing_sd_rad = 0.001;
  double common_share = 0.0;
  double range_m = 40.0;
  double mast_height_m = 1.5;
  double rover_height_m = 0.3;
  bool shares_pan_error = true;
  LanderFixLaw law = LanderFixLaw::kConstant;
  CylinderLawParams cylinder;

  void Visit(core::FieldVisitor& v);
};

// Where the sun stands and how well it is seen.
struct SunSensorParams {
  AidScheduleParams schedule{.every_m = 1.0};
  double half_field_of_view_rad = math::DegToRad(75.0);
  double noise_sd_rad = math::DegToRad(0.5);
  double optical_depth = 0.5;
  double dropout_probability = 0.02;
  double tilt_sd_rad = math::DegToRad(1.0);
  double latitude_rad = math::DegToRad(19.3);
  double areocentric_longitude_rad = math::DegToRad(142.7);
  double start_solar_time_h = 10.0;
  double north_heading_rad = math::DegToRad(90.0);

  void Visit(core::FieldVisitor& v);
};

// A beacon on the lander and its answerer on the rover.
struct RadioBeaconParams {
  AidScheduleParams schedule{.every_m = 1.0};
  double range_sd_m = 1.0;
  double bearing_sd_rad = math::DegToRad(3.0);
  double range_m = 500.0;

  void Visit(core::FieldVisitor& v);
};

struct AidParams {
  LanderFixParams lander_fix;
  SunSensorParams sun;
  RadioBeaconParams beacon;

  bool AnyEnabled() const {
    return lander_fix.schedule.enabled || sun.schedule.enabled || beacon.schedule.enabled;
  }

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::sensing

template <>
struct rockyard::core::EnumNames<rockyard::sensing::LanderFixLaw> {
  static constexpr std::array<std::string_view, 2> kNames{"constant", "cylinder"};
};

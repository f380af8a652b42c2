// Parameters of the aids of localization (scenario group sensors.aids): the trial keeps the
// schedules, the sensors of aids.h take the rest. All aids are off by default; where one is on,
// defaults decide records. The numbers of CylinderLawParams are one fit (fit_lander_fix.py) and
// must be changed together.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::sensing {

// The log odds of a chance are intercept + width ln(m / 20) + no_blue B + pink_aside sin(2 theta)
// + light sin(e) for a cylinder m pixels wide under a sun at elevation e; B and theta are those of
// CylinderLaw in aids.h. The 20 pixels are kWidthOfIntercept_px in aids.cc.
struct CylinderChanceParams {
  double intercept = 0.0;
  double width = 0.0;
  double no_blue = 0.0;
  double pink_aside = 0.0;
  double light = 0.0;

  void Visit(core::FieldVisitor& v);
};

// A deviation: sd^2 = least^2 + (pixels times what one pixel is worth)^2.
struct CylinderDeviationParams {
  double least = 0.0;  // rad, or a share of the range
  double pixels = 0.0;
};
struct CylinderAngleDeviationParams : CylinderDeviationParams {
  void Visit(core::FieldVisitor& v);
};
struct CylinderRangeDeviationParams : CylinderDeviationParams {
  void Visit(core::FieldVisitor& v);
};

struct CylinderLawParams {
  double image_width_px = 512.0;
  double field_of_view_rad = math::DegToRad(29.33);
  double nearest_m = 0.838;
  double mounting_rad = 0.0;
  double sun_elevation_rad = math::DegToRad(60.0);
  // Both chances are those of the published finder.
  CylinderChanceParams found{
      .intercept = 2.53, .width = 0.355, .no_blue = 0.255, .pink_aside = 0.576, .light = -0.891};
  CylinderChanceParams wrong{
      .intercept = -1.06, .width = -0.318, .no_blue = 0.348, .pink_aside = -0.658, .light = 1.67};
  CylinderAngleDeviationParams heading{{.least = math::DegToRad(3.25), .pixels = 1.41}};
  CylinderRangeDeviationParams range{{.least = 0.0105, .pixels = 0.471}};
  CylinderAngleDeviationParams bearing{{.pixels = 1.46}};
  double heading_bias_rad = 0.0;
  double range_bias = 0.0;
  double wrong_turn_rad = math::DegToRad(141.0);
  double wrong_range = 0.436;

  void Visit(core::FieldVisitor& v);
};

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
  kCylinder,  // as the coloured cylinder is seen (CylinderLaw in sensing/aids.h)
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
  CylinderLawParams cylinder{};

  void Visit(core::FieldVisitor& v);
};

// The sun sensor on the rover: where the sun stands and how well it is seen.
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

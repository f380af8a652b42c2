/// @file
/// What the rover believes of its own geometry. Odometry, the wheel driver, the finder of light
/// stripes and triangulation go by it; the simulated hardware has a geometry of its own, so that a
/// scenario can make a calibration wrong on purpose. Must stay: every on-board copy is made in one
/// place (trial/sight/onboard_calibration.h), from the truth and the errors that the scenario
/// states, so that all parts of one rover believe the same. The words row, scanline, stripe and
/// point are those of stripe_array.h.
#pragma once

#include <array>
#include <vector>

#include "math/pose.h"
#include "messages/camera.h"
#include "messages/measurements.h"
#include "messages/wheels.h"

namespace rockyard::messages {

/// Drive geometry for steering and odometry.
struct DriveCalibration {
  double wheel_radius_m = 0.065;
  PerWheel<double> radius_ratio{1.0, 1.0, 1.0, 1.0, 1.0, 1.0};  ///< of each wheel to wheel_radius_m
  PerWheel<double> wheel_x_m{};                                 ///< wheel centre in R
  PerWheel<double> wheel_y_m{};                                 ///< positive left
  PerWheel<bool> steered{};                                     ///< whether the wheel is steered
  /// Added to the set point of every steered wheel, positive left: the true angle of a wheel that
  /// the rover believes to stand straight.
  double steering_offset_rad = 0.0;
  double max_steer_rad = 1.0;         ///< largest steering angle, either way
  double max_wheel_speed_m_s = 0.15;  ///< rim speed of the fastest wheel
};

/// The rocker-bogie and the underside of the chassis as the rover stands on level ground, in R;
/// both sides are alike.
struct SuspensionBelief {
  bool bogies_at_front = false;  ///< the end that stands on the bogies, two wheels a side
  double rocker_pivot_x_m = 0.0;
  double rocker_pivot_z_m = 0.0;
  double bogie_pivot_x_m = 0.0;
  double bogie_pivot_z_m = 0.0;
  double pivot_y_m = 0.0;       ///< of the rocker pivots from the middle plane
  double belly_length_m = 0.0;  ///< of the underside, centred
  double belly_width_m = 0.0;
};

/// What the rover believes of its body, beside its wheels. Lengths are those of the design; a
/// scenario states no errors of them.
struct RoverBelief {
  DriveCalibration drive;
  double length_m = 0.0;           ///< of the outline, along x of R
  double width_m = 0.0;            ///< along y of R, over the wheels
  double belly_clearance_m = 0.0;  ///< of the belly above level ground
  double wheel_width_m = 0.0;
  double max_rocker_rad = 0.0;  ///< stops of the passive joints, either way
  double max_bogie_rad = 0.0;
  double max_tilt_rad = 0.0;  ///< above it the rover feels a hazard (perception.vehicle_hazard)
  SuspensionBelief suspension = {};  ///< plugins and processes are not told
};

/// One laser fan: the directions from the emitter within half_fan of axis_R, in the light plane
/// n . (p - e) = 0 with the normal n and the emitter e.
struct StripeLaser {
  math::Vector3 p_RoE_R = math::Vector3::Zero();    ///< emitter
  math::Vector3 normal_R = math::Vector3::UnitY();  ///< of the light plane
  math::Vector3 axis_R = math::Vector3::UnitX();    ///< centre ray of the fan
  double half_fan_rad = 0.5;                        ///< half of its opening angle
  int camera = 0;                                   ///< index of the camera that finds this stripe
  int group = 0;  ///< lasers of one group are on in the same image
};

/// What the rover believes of its light stripe sensor.
struct StripeCalibration {
  std::array<Camera, 2> cameras{};  ///< by StripeLaser::camera
  std::vector<StripeLaser> lasers;  ///< left to right
  /// Image row of each scanline, counted down from the optical axis; nearest point first.
  std::vector<int> scanline_px;
  double datum_z_m = 0.0;  ///< height in R of the datum plane, from which elevations count
  /// Elevations above the datum plane between which stripes are looked for.
  double search_low_m = -0.30;
  double search_high_m = 0.20;

  /// Returns the rows and stripes of the array: one row for each scanline, one stripe for each
  /// laser.
  StripeArraySize size() const { return {scanline_px.size(), lasers.size()}; }
};

}  // namespace rockyard::messages

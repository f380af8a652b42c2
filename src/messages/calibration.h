// What the rover believes of its own geometry. On-board code uses these copies; the simulated
// hardware has its own, so that a scenario can make a calibration wrong on purpose.
#pragma once

#include <array>

#include "math/pose.h"
#include "messages/measurements.h"
#include "messages/wheels.h"

namespace rockyard::messages {

// Drive geometry for steering and odometry.
struct DriveCalibration {
  double wheel_radius_m = 0.065;
  PerWheel<double> radius_ratio{1.0, 1.0, 1.0, 1.0, 1.0, 1.0};  // of each wheel to wheel_radius_m
  PerWheel<double> wheel_x_m{};                                 // contact point in R
  PerWheel<double> wheel_y_m{};
  PerWheel<bool> steered{};
  // Added to the set point of every steered wheel, positive left: where its straight lies.
  double steering_offset_rad = 0.0;
  double max_steer_rad = 1.0;
  double max_wheel_speed_m_s = 0.15;  // rim speed of the fastest wheel
};

// One camera of the light stripe sensor. Rows are read as planes through the lateral axis; angles
// grow in proportion to pixels (f-theta lens).
struct StripeCamera {
  math::Transform X_RC = math::Transform::Identity();  // x along the optical axis, y left, z up
  double column_pitch_rad = 0.0;  // angle per column; positive columns look to the camera's right
  double row_pitch_rad = 0.0;
};

// One laser fan: a plane through the emitter that contains the rover's z axis direction tilted into
// the fan, given by its normal.
struct StripeLaser {
  math::Vector3 p_RoE_R = math::Vector3::Zero();    // emitter
  math::Vector3 normal_R = math::Vector3::UnitY();  // of the light plane
  math::Vector3 axis_R = math::Vector3::UnitX();    // centre ray of the fan
  double half_fan_rad = 0.5;
  int camera = 0;  // index of the camera that finds this stripe
};

struct StripeCalibration {
  std::array<StripeCamera, 2> cameras{};
  std::array<StripeLaser, kStripes> lasers{};
  // Depression of the scanline plane of each row below the camera's optical axis, per row.
  std::array<double, kStripeRows> row_angle_rad{};
  double datum_z_m = 0.0;  // height in R of the plane from which elevations count
};

}  // namespace rockyard::messages

// How wrong the rover is about its own geometry (scenario group perception.calibration). All zero
// by default: on-board code then works with the truth. Every error is what the rover believes less
// what is true, except steering_offset_rad. A trial joins truth and errors in one place
// (trial/sight/onboard_calibration.h), from which all on-board code must take its geometry; sensors
// and physics keep the true geometry.
#pragma once

#include <array>

#include "core/fields.h"
#include "messages/measurements.h"

namespace rockyard::perception {

// Errors of the drive geometry.
struct DriveCalibrationErrors {
  double wheel_radius_percent = 0.0;  // of all wheels, > 0: believed too large
  // The error of the left wheels against the right ones: half of it is added to the left wheels,
  // half is taken from the right ones.
  double wheel_radius_left_right_percent = 0.0;
  double track_percent = 0.0;      // > 0: believed too wide
  double wheelbase_percent = 0.0;  // > 0: believed too long
  // The offset of every steered wheel: what is true less what the rover believes.
  double steering_offset_rad = 0.0;

  void Visit(core::FieldVisitor& v);
};

// Errors of one camera of the light stripe sensor, or of one rigid pair of stereo cameras about its
// middle. It is turned about its own axes (yaw, then pitch, then roll) and shifted along the axes
// of R. Roll, pitch, yaw > 0: believed turned too far right side down, down, left, as seen from
// behind the camera. Shifts > 0: believed too far forward, left, up, as seen by the rover.
struct CameraCalibrationErrors {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;

  void Visit(core::FieldVisitor& v);
};

// Errors of light planes, turned about the vertical through their emitters; > 0: believed turned
// too far left.
struct LaserCalibrationErrors {
  std::array<double, messages::kStripes> angle_rad{};

  void Visit(core::FieldVisitor& v);
};

// All errors of calibration.
struct CalibrationErrorParams {
  DriveCalibrationErrors drive;
  CameraCalibrationErrors left_camera;
  CameraCalibrationErrors right_camera;
  LaserCalibrationErrors lasers;
  CameraCalibrationErrors stereo_front;
  CameraCalibrationErrors stereo_rear;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::perception

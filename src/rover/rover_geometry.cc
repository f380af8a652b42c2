#include "rover/rover_geometry.h"

namespace rockyard::rover {
namespace {

Outline Rectangle(double x_m, double y_m, double length_m, double width_m) {
  const double dx = 0.5 * length_m;
  const double dy = 0.5 * width_m;
  return {{x_m - dx, y_m - dy}, {x_m + dx, y_m - dy}, {x_m + dx, y_m + dy}, {x_m - dx, y_m + dy}};
}

}  // namespace

messages::DriveCalibration MakeDriveCalibration(const RoverParams& params) {
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  messages::DriveCalibration calibration;
  calibration.wheel_radius_m = params.geometry.wheel_radius_m;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    calibration.wheel_x_m[i] = geometry.wheel_R[i].x();
    calibration.wheel_y_m[i] = geometry.wheel_R[i].y();
  }
  calibration.steered = geometry.steered;
  calibration.max_steer_rad = params.drive.max_steer_rad;
  calibration.max_wheel_speed_m_s = params.drive.speed_m_s;
  return calibration;
}

Outline BodyOutline(const RoverGeometryParams& params) {
  return Rectangle(0.0, 0.0, params.length_m, params.width_m);
}

Outline BellyOutline(const RoverGeometryParams& params) {
  return Rectangle(0.0, 0.0, params.belly_length_m, params.belly_width_m);
}

std::array<Outline, messages::kWheelCount> WheelOutlines(const RoverGeometryParams& params) {
  const RoverGeometry geometry = MakeRoverGeometry(params);
  std::array<Outline, messages::kWheelCount> outlines;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    outlines[i] = Rectangle(geometry.wheel_R[i].x(), geometry.wheel_R[i].y(),
                            2.0 * params.wheel_radius_m, params.wheel_width_m);
  }
  return outlines;
}

}  // namespace rockyard::rover

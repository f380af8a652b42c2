#include "rover/rover_layout_params.h"

namespace rockyard::rover {

using math::Vector3;

RoverGeometry MakeRoverGeometry(const RoverGeometryParams& params) {
  RoverGeometry geometry;
  const double outer_x = 0.5 * params.wheelbase_m;
  // The overall width runs from outer face to outer face.
  const double wheel_y = 0.5 * (params.width_m - params.wheel_width_m);
  const bool bogie_in_front = params.bogie_end == BogieEnd::kFront;
  // The parameters give x of the middle wheels and pivots for a bogie at the rear; in front is its
  // mirror image in the plane x = 0 of R.
  const double mirror = bogie_in_front ? -1.0 : 1.0;
  const std::array<double, 3> x{outer_x, mirror * params.middle_wheel_x_m, -outer_x};
  const std::array<bool, 3> on_bogie{bogie_in_front, true, !bogie_in_front};
  // messages::Wheel runs front, middle, rear on the left (+y), then the same on the right.
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const std::size_t axle = i % 3;
    const double y = i < 3 ? wheel_y : -wheel_y;
    geometry.wheel_R[i] = Vector3(x[axle], y, params.wheel_radius_m);
    // The middle wheels (axle 1) steer where all do.
    geometry.steered[i] = axle != 1 || params.steered_wheels == SteeredWheels::kAll;
    geometry.on_bogie[i] = on_bogie[axle];
  }
  // The bogie's pivot stands midway between the bogie's two wheels, the middle one and the outer
  // one at -outer_x (before mirroring).
  const double bogie_x = 0.5 * (params.middle_wheel_x_m - outer_x);
  for (std::size_t side = 0; side < 2; ++side) {
    const double y = side == 0 ? params.arm_y_m : -params.arm_y_m;
    geometry.rocker_pivot_R[side] =
        Vector3(mirror * params.rocker_pivot_x_m, y, params.rocker_pivot_z_m);
    geometry.bogie_pivot_R[side] = Vector3(mirror * bogie_x, y, params.bogie_pivot_z_m);
  }
  return geometry;
}

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
  const double dx = 0.5 * params.length_m;
  const double dy = 0.5 * params.width_m;
  return {{-dx, -dy}, {dx, -dy}, {dx, dy}, {-dx, dy}};
}

namespace {

using math::Vector3;

// Width and height of rockers and bogies, m.
constexpr double kBarWidth_m = 0.02;
constexpr double kBarHeight_m = 0.1;

// Returns the principal moments of a solid box about its centre: I_x = m (y^2 + z^2) / 12, and I_y
// and I_z accordingly.
Vector3 BoxInertia(double mass_kg, double x_m, double y_m, double z_m) {
  const double k = mass_kg / 12.0;
  return {k * (y_m * y_m + z_m * z_m), k * (x_m * x_m + z_m * z_m), k * (x_m * x_m + y_m * y_m)};
}

// Returns the principal moments of a solid cylinder along y: I_y = m r^2 / 2,
// I_x = I_z = m (3 r^2 + w^2) / 12.
Vector3 CylinderInertia(double mass_kg, double radius_m, double width_m) {
  const double across = mass_kg * (3.0 * radius_m * radius_m + width_m * width_m) / 12.0;
  return {across, 0.5 * mass_kg * radius_m * radius_m, across};
}

}  // namespace

RoverMasses MakeRoverMasses(const RoverParams& params) {
  const RoverMassParams& mass = params.mass;
  const RoverGeometryParams& size = params.geometry;
  // The chassis has what the other ten bodies leave of the rover's total mass.
  const double chassis_kg =
      mass.total_kg - 6.0 * mass.wheel_kg - 2.0 * (mass.rocker_kg + mass.bogie_kg);
  const double arm_m = 0.5 * size.length_m;
  RoverMasses masses;
  masses.chassis = {chassis_kg, Vector3(mass.chassis_com_x_m, 0.0, mass.chassis_com_z_m),
                    BoxInertia(chassis_kg, size.belly_length_m, size.belly_width_m,
                               size.height_m - size.belly_clearance_m)};
  masses.rocker = {mass.rocker_kg, Vector3::Zero(),
                   BoxInertia(mass.rocker_kg, arm_m, kBarWidth_m, kBarHeight_m)};
  masses.bogie = {mass.bogie_kg, Vector3::Zero(),
                  BoxInertia(mass.bogie_kg, 0.5 * arm_m, kBarWidth_m, kBarHeight_m)};
  masses.wheel = {mass.wheel_kg, Vector3::Zero(),
                  CylinderInertia(mass.wheel_kg, size.wheel_radius_m, size.wheel_width_m)};
  return masses;
}

}  // namespace rockyard::rover

#include "rover/mass_properties_params.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

// Width and height of rockers and bogies, m.
constexpr double kBarWidth_m = 0.02;
constexpr double kBarHeight_m = 0.1;

// Principal moments of a solid box about its centre: I_x = m (y^2 + z^2) / 12 and so on in a
// circle.
Vector3 BoxInertia(double mass_kg, double x_m, double y_m, double z_m) {
  const double k = mass_kg / 12.0;
  return {k * (y_m * y_m + z_m * z_m), k * (x_m * x_m + z_m * z_m), k * (x_m * x_m + y_m * y_m)};
}

// Principal moments of a solid cylinder along y: I_y = m r^2 / 2, I_x = I_z = m (3 r^2 + w^2) / 12.
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

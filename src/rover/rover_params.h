// Parameters of the six-wheel rocker-bogie rover. The defaults describe Rocky 3.2.
//
// Frame R: x forward, y left, z up, origin on the ground under the chassis centre while the rover
// stands on level ground. The pivots of Rocky 3.2 are not public: the defaults take most
// lateral and vertical dimensions of Rocky 7, whose wheels have the same size, and spread the
// wheels over the published length. Every such value is marked as assumed with a range.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::rover {

// Which end of the rover stands on the bogies, the other stands on the rockers.
enum class BogieEnd { kRear, kFront };

struct RoverGeometryParams {
  double length_m = 0.65;
  double width_m = 0.48;
  double height_m = 0.30;
  double belly_clearance_m = 0.13;
  double wheel_radius_m = 0.065;
  double wheel_width_m = 0.08;
  double middle_wheel_x_m = 0.0;
  BogieEnd bogie_end = BogieEnd::kFront;
  double rocker_pivot_x_m = -0.015;
  double rocker_pivot_z_m = 0.19;
  double bogie_pivot_z_m = 0.13;
  double knee_z_m = 0.145;
  double belly_length_m = 0.40;
  double belly_width_m = 0.26;
  double arm_y_m = 0.147;
  double arm_radius_m = 0.012;
  double hub_radius_m = 0.025;
  double rocker_limit_rad = math::DegToRad(25.0);
  double bogie_limit_rad = math::DegToRad(50.0);

  void Visit(core::FieldVisitor& v);
};

struct RoverMassParams {
  double total_kg = 20.0;
  double wheel_kg = 0.5;
  double rocker_kg = 0.8;
  double bogie_kg = 0.5;
  double chassis_com_x_m = 0.0;
  double chassis_com_z_m = 0.19;

  void Visit(core::FieldVisitor& v);
};

struct RoverDriveParams {
  double speed_m_s = 0.15;
  double stall_torque_Nm = 4.0;
  double steer_rate_rad_s = math::DegToRad(60.0);
  double max_steer_rad = math::DegToRad(60.0);

  void Visit(core::FieldVisitor& v);
};

struct RoverContactParams {
  double wheel_soil_friction = 0.65;
  double wheel_rock_friction = 0.8;
  double body_rock_friction = 0.4;
  double soil_slip = 0.2;
  double soil_drag = 0.05;
  double stiffness_N_m = 5e4;
  double damping_Ns_m = 800.0;

  void Visit(core::FieldVisitor& v);
};

struct RoverPhysicsParams {
  double step_s = 1.0 / 60.0;
  std::int64_t solver_iterations = 10;
  double gravity_m_s2 = 9.81;

  void Visit(core::FieldVisitor& v);
};

struct RoverParams {
  RoverGeometryParams geometry;
  RoverMassParams mass;
  RoverDriveParams drive;
  RoverContactParams contact;
  RoverPhysicsParams physics;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::rover

template <>
struct rockyard::core::EnumNames<rockyard::rover::BogieEnd> {
  static constexpr std::array<std::string_view, 2> kNames{"rear", "front"};
};

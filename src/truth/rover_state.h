// The true state of the rover. Both fidelities of the rover fill all of it; sensors measure from
// it, referee and counters judge by it. On-board code never includes this file. No file holds it:
// members may be added, and both fidelities then have to fill them.
#pragma once

#include <vector>

#include "math/pose.h"
#include "messages/wheels.h"

namespace rockyard::truth {

// What can touch something; sensors and referee tell these apart.
enum class BodyPart { kBelly, kRocker, kHub, kPanelEdge, kWheel };

// Touch of a part of the rover with a rock, the ground or a wall. Contacts of wheels are not
// listed.
struct BodyContact {
  BodyPart part = BodyPart::kBelly;
  int rock = -1;  // index in Terrain::rocks(); -1: ground or wall
  double normal_force_N = 0.0;
  double sliding_speed_m_s = 0.0;
  double lift_share = 0.0;  // vertical part of the normal force: 1 where the rock bears the rover
  math::Vector3 p_RoC_R = math::Vector3::Zero();  // where, on the rover
};

// The state after a step of the rover.
struct RoverState {
  math::Transform X_WR = math::Transform::Identity();
  math::Vector3 v_WR_m_s = math::Vector3::Zero();
  math::Vector3 w_WR_rad_s = math::Vector3::Zero();
  messages::PerWheel<double> wheel_angle_rad{};  // accumulated, positive forward
  messages::PerWheel<double> wheel_load_N{};     // normal force on each wheel
  // Depth of each wheel's lowest point below the soil's surface beneath it; 0 where it stands on
  // rock or on nothing.
  messages::PerWheel<double> wheel_sinkage_m{};
  messages::PerWheel<double> motor_torque_Nm{};
  messages::PerWheel<double> steer_rad{};
  double left_rocker_rad = 0.0;
  double right_rocker_rad = 0.0;
  double left_bogie_rad = 0.0;
  double right_bogie_rad = 0.0;
  std::vector<BodyContact> contacts;  // of the last step
};

}  // namespace rockyard::truth

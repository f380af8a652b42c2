/// @file
/// What the rover feels of itself, by the sensors of Matthies 1995, section 6, beside the light
/// stripe. Estimators take the attitude from it, the detectors of felt hazards and of a stuck rover
/// judge it, and navigators are told of hazards.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "math/pose.h"
#include "messages/wheels.h"

namespace rockyard::messages {

/// Angles of the passive joints, positive where the front end goes down against the chassis
/// (rockers) or the rocker (bogies): rotations about the rover's y axis.
struct Articulation {
  double left_rocker_rad = 0.0;
  double right_rocker_rad = 0.0;
  double left_bogie_rad = 0.0;
  double right_bogie_rad = 0.0;
};

/// Strips that close where something presses on the edge of the solar panel or on the leading edge
/// of the undercarriage. Records depend on the order: false touches are drawn strip by strip in it.
enum class ContactSwitch : std::size_t {
  kFrontLeft,
  kFrontCentre,
  kFrontRight,
  kLeftEdge,
  kRightEdge,
  kRearEdge,
  kUndercarriage,
};
/// How many strips there are.
inline constexpr std::size_t kContactSwitchCount = 7;
/// One value per strip, by Index; true: pressed.
using ContactSwitches = std::array<bool, kContactSwitchCount>;

/// Returns the place of a strip in ContactSwitches.
constexpr std::size_t Index(ContactSwitch contact) { return static_cast<std::size_t>(contact); }

/// What is felt over one on-board tick. What the rover has no sensor for is empty.
struct VehicleState {
  std::optional<Articulation> articulation;
  /// Specific force along the rover's axes, m/s2: at rest the upward reaction to gravity, (0, 0, g)
  /// on level ground.
  std::optional<math::Vector3> specific_force_R;
  std::optional<PerWheel<double>> motor_current_A;  ///< magnitudes
  std::optional<ContactSwitches> contact;
};

/// What the rover feels and has to get away from. Records depend on the order: of hazards felt at
/// once, navigators are told the first (perception/vehicle_hazards.h). kSlip comes from no sensor
/// of VehicleState but from visual odometry: the wheels roll farther than the cameras see the rover
/// move.
enum class VehicleHazardKind { kContact, kTilt, kArticulation, kMotorCurrent, kSlip };
/// How many kinds there are.
inline constexpr std::size_t kVehicleHazardKindCount = 5;

/// Where the cause of a hazard lies, as far as the sensor tells.
enum class HazardSide { kLeft, kAhead, kRight, kBehind };

/// A hazard that the rover feels, not sees.
struct VehicleHazard {
  VehicleHazardKind kind = VehicleHazardKind::kContact;
  HazardSide side = HazardSide::kAhead;
};

}  // namespace rockyard::messages

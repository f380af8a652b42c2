#include "perception/vehicle_hazards.h"

#include <algorithm>
#include <cmath>

#include "math/functions.h"

namespace rockyard::perception {
namespace {

using messages::ContactSwitch;
using messages::HazardSide;

// Returns the side of a hazard: both sides at once count as ahead.
HazardSide SideOf(bool left, bool right) {
  if (left == right) return HazardSide::kAhead;
  return left ? HazardSide::kLeft : HazardSide::kRight;
}

// Returns where the rover is touched: sides count before the front, the rear counts only where
// nothing else is touched.
std::optional<HazardSide> Touched(const messages::ContactSwitches& closed) {
  const auto is_closed = [&](ContactSwitch contact) { return closed[messages::Index(contact)]; };
  const bool left = is_closed(ContactSwitch::kFrontLeft) || is_closed(ContactSwitch::kLeftEdge);
  const bool right = is_closed(ContactSwitch::kFrontRight) || is_closed(ContactSwitch::kRightEdge);
  const bool ahead =
      is_closed(ContactSwitch::kFrontCentre) || is_closed(ContactSwitch::kUndercarriage);
  if (left || right) return SideOf(left, right);
  if (ahead) return HazardSide::kAhead;
  if (is_closed(ContactSwitch::kRearEdge)) return HazardSide::kBehind;
  return std::nullopt;
}

}  // namespace

double TiltOf(const math::Vector3& specific_force_R) {
  // The angle between the specific force, which points up at rest, and the rover's z axis.
  return math::Atan2(specific_force_R.head<2>().norm(), specific_force_R.z());
}

std::optional<messages::VehicleHazard> HazardToAvoid(const FeltHazards& felt) {
  const auto first = std::find_if(felt.by_kind.begin(), felt.by_kind.end(), [](const auto& hazard) {
    return hazard && hazard->side != HazardSide::kBehind;
  });
  return first == felt.by_kind.end() ? std::nullopt : *first;
}

std::optional<HazardSide> VehicleHazardDetector::Tilted(const math::Vector3& force_R) const {
  if (TiltOf(force_R) <= params_.max_tilt_rad) return std::nullopt;
  if (std::abs(force_R.x()) >= std::abs(force_R.y())) return HazardSide::kAhead;
  // f_y > 0: the left side is up (roll positive), so the cause is there.
  return force_R.y() > 0.0 ? HazardSide::kLeft : HazardSide::kRight;
}

std::optional<HazardSide> VehicleHazardDetector::Bent(const messages::Articulation& angles) const {
  const bool left = std::abs(angles.left_bogie_rad) > params_.max_bogie_rad;
  const bool right = std::abs(angles.right_bogie_rad) > params_.max_bogie_rad;
  if (left || right) return SideOf(left, right);
  const double max_rad =
      std::max(std::abs(angles.left_rocker_rad), std::abs(angles.right_rocker_rad));
  if (max_rad <= params_.max_rocker_rad) return std::nullopt;
  // Positive angles lower the front: the smaller one has its front up.
  return angles.left_rocker_rad < angles.right_rocker_rad ? HazardSide::kLeft : HazardSide::kRight;
}

std::optional<HazardSide> VehicleHazardDetector::Stalled(
    const messages::PerWheel<double>& current_A, const WheelTurns& turns) {
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    const double told_rad = turns.told_rad[wheel];
    // A wheel at rest says nothing: stops between legs do not hide a wheel that is stuck in each.
    if (told_rad == 0.0) continue;
    // Turns count the way that the wheel was told: a wheel that is pushed back turns less than 0.
    const double obeyed_rad = std::copysign(1.0, told_rad) * turns.turned_rad[wheel];
    const bool stalls = current_A[wheel] > params_.max_current_A &&
                        obeyed_rad < params_.max_turn_share * std::abs(told_rad);
    stalled_ticks_[wheel] = stalls ? stalled_ticks_[wheel] + 1 : 0;
  }
  const auto middle = stalled_ticks_.begin() + messages::kWheelCount / 2;  // left wheels come first
  const auto long_enough = [&](std::int64_t ticks) { return ticks >= params_.current_ticks; };
  const bool left = std::any_of(stalled_ticks_.begin(), middle, long_enough);
  const bool right = std::any_of(middle, stalled_ticks_.end(), long_enough);
  if (!left && !right) return std::nullopt;
  return SideOf(left, right);
}

std::optional<messages::VehicleHazard> VehicleHazardDetector::Debounced(
    Kind kind, std::optional<HazardSide> now, std::int64_t ticks) {
  std::int64_t& held = ticks_[static_cast<std::size_t>(kind)];
  // Ticks in a row count; one tick without the hazard begins anew.
  held = now ? held + 1 : 0;
  if (!now || held < ticks) return std::nullopt;
  return messages::VehicleHazard{kind, *now};
}

FeltHazards VehicleHazardDetector::Observe(const messages::VehicleState& state,
                                           const WheelTurns& turns) {
  std::optional<HazardSide> touched, tilted, bent, stalled;
  if (state.contact) touched = Touched(*state.contact);
  if (state.specific_force_R) tilted = Tilted(*state.specific_force_R);
  if (state.articulation) bent = Bent(*state.articulation);
  if (state.motor_current_A) stalled = Stalled(*state.motor_current_A, turns);
  // A touch behind is counted by itself, whatever else is touched.
  const bool behind = state.contact && (*state.contact)[messages::Index(ContactSwitch::kRearEdge)];
  ticks_behind_ = behind ? ticks_behind_ + 1 : 0;
  return {{Debounced(Kind::kContact, touched, params_.contact_ticks),
           Debounced(Kind::kTilt, tilted, params_.tilt_ticks),
           Debounced(Kind::kArticulation, bent, params_.articulation_ticks),
           Debounced(Kind::kMotorCurrent, stalled, 1)},  // Stalled has counted its ticks
          behind && ticks_behind_ >= params_.contact_ticks};
}

void VehicleHazardDetector::Reset() {
  ticks_.fill(0);
  stalled_ticks_.fill(0);
  ticks_behind_ = 0;
}

}  // namespace rockyard::perception

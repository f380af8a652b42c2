#include "trial/drive/vehicle_guard.h"

namespace rockyard::trial {
namespace {

std::string Name(messages::VehicleHazardKind kind) {
  switch (kind) {
    case messages::VehicleHazardKind::kContact:
      return "contact";
    case messages::VehicleHazardKind::kTilt:
      return "tilt";
    case messages::VehicleHazardKind::kArticulation:
      return "articulation";
    case messages::VehicleHazardKind::kMotorCurrent:
      return "motor current";
    case messages::VehicleHazardKind::kSlip:
      return "slip";
  }
  return "";
}

std::string Name(messages::HazardSide side) {
  switch (side) {
    case messages::HazardSide::kLeft:
      return "left";
    case messages::HazardSide::kAhead:
      return "ahead";
    case messages::HazardSide::kRight:
      return "right";
    case messages::HazardSide::kBehind:
      return "behind";
  }
  return "";
}

perception::WheelTurns TurnsOf(const messages::WheelCommand& command,
                               const messages::MotionMeasurement& motion) {
  perception::WheelTurns turns;
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    turns.told_rad[wheel] = command.rate_rad_s[wheel] * motion.duration_s;
    turns.turned_rad[wheel] = motion.wheel_turn_rad[wheel];
  }
  return turns;
}

}  // namespace

VehicleGuard::VehicleGuard(const DriveParams& drive)
    : on_(drive.sensors.vehicle.any()), detector_(drive.perception.vehicle_hazard) {}

std::vector<messages::VehicleHazard> VehicleGuard::Feel(const messages::VehicleState& felt,
                                                        const messages::WheelCommand& command,
                                                        const messages::MotionMeasurement& motion) {
  std::vector<messages::VehicleHazard> appeared;
  if (!on_) return appeared;
  const perception::FeltHazards before = felt_;
  measured_ = felt;
  felt_ = detector_.Observe(measured_, TurnsOf(command, motion));
  const bool avoided_before = hazard_.has_value();
  hazard_ = perception::HazardToAvoid(felt_);
  if (hazard_ && !avoided_before) ++stops_;
  for (std::size_t kind = 0; kind < counts_.size(); ++kind) {
    if (!felt_.by_kind[kind] || before.by_kind[kind]) continue;
    ++counts_[kind];
    appeared.push_back(*felt_.by_kind[kind]);
  }
  return appeared;
}

void VehicleGuard::OnPlaced() {
  detector_.Reset();
  felt_ = {};
  hazard_.reset();
}

std::string Describe(const messages::VehicleHazard& hazard) {
  return Name(hazard.kind) + " " + Name(hazard.side);
}

}  // namespace rockyard::trial

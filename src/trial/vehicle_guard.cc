#include "trial/vehicle_guard.h"

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

}  // namespace

VehicleGuard::VehicleGuard(const scenario::Scenario& scenario, core::TrialKey key)
    : on_(scenario.sensors.vehicle.any()),
      sensors_(scenario.sensors.vehicle, scenario.rover, key),
      detector_(scenario.perception.vehicle_hazard) {}

bool VehicleGuard::Feel(const truth::RoverState& state, const messages::WheelCommand& command,
                        double duration_s) {
  if (!on_) return false;
  const std::optional<messages::VehicleHazard> before = felt_;
  felt_ = detector_.Observe(sensors_.Measure(state, command, duration_s));
  if (!felt_ || (before && before->kind == felt_->kind)) return false;
  ++counts_[static_cast<std::size_t>(felt_->kind)];
  return true;
}

void VehicleGuard::Resume(const truth::RoverState& state) {
  if (on_) sensors_.Resume(state);
  detector_.Reset();
  felt_.reset();
}

std::string Describe(const messages::VehicleHazard& hazard) {
  return Name(hazard.kind) + " " + Name(hazard.side);
}

}  // namespace rockyard::trial

// What the rover makes of what it feels: the hazard criteria of the vehicle sensors, and counts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "messages/commands.h"
#include "messages/measurements.h"
#include "perception/vehicle_hazards.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Costs nothing where the rover has none of these sensors.
class VehicleGuard {
 public:
  explicit VehicleGuard(const DriveParams& drive);

  // Once a control tick, with what was felt, what the wheels were told and what was measured of
  // their motion meanwhile. The hazards of kinds that were not felt at the tick before.
  std::vector<messages::VehicleHazard> Feel(const messages::VehicleState& felt,
                                            const messages::WheelCommand& command,
                                            const messages::MotionMeasurement& motion);

  // Operators moved the rover by hand: nothing is felt, and nothing of what was felt before counts
  // towards a hazard.
  void OnPlaced();

  // Of the last tick: what the rover has to get away from, null where there is nothing.
  const messages::VehicleHazard* hazard() const { return hazard_ ? &*hazard_ : nullptr; }
  bool touches_behind() const { return felt_.touches_behind; }
  // What was measured at the last tick.
  const messages::VehicleState& measured() const { return measured_; }

  // How often a hazard of that kind appeared, whatever else was felt.
  std::int64_t count(messages::VehicleHazardKind kind) const {
    return counts_[static_cast<std::size_t>(kind)];
  }

  // How often there came to be something to get away from.
  std::int64_t stops() const { return stops_; }

 private:
  bool on_;
  perception::VehicleHazardDetector detector_;
  messages::VehicleState measured_;
  perception::FeltHazards felt_;
  std::optional<messages::VehicleHazard> hazard_;
  std::array<std::int64_t, messages::kVehicleHazardKindCount> counts_{};
  std::int64_t stops_ = 0;
};

// "contact left" and so on.
std::string Describe(const messages::VehicleHazard& hazard);

}  // namespace rockyard::trial

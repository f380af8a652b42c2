// What the rover feels, as the closed loop uses it: the vehicle sensors and their hazard criteria.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "messages/commands.h"
#include "messages/measurements.h"
#include "perception/vehicle_hazards.h"
#include "sensing/vehicle_sensors.h"
#include "trial/drive_params.h"
#include "truth/rover_state.h"

namespace rockyard::trial {

// Costs nothing where the rover has none of these sensors.
class VehicleGuard {
 public:
  VehicleGuard(const DriveParams& drive, core::TrialKey key);

  // Once a physics step.
  void Observe(const truth::RoverState& state) {
    if (on_) sensors_.Observe(state);
  }

  // Once a control tick, with what the wheels were told and what was measured of their motion
  // meanwhile. The hazards of kinds that were not felt at the tick before.
  std::vector<messages::VehicleHazard> Feel(const truth::RoverState& state,
                                            const messages::WheelCommand& command,
                                            const messages::MotionMeasurement& motion);

  // Operators moved the rover by hand: nothing is felt, and nothing of what was felt before counts
  // towards a hazard.
  void Restart(const truth::RoverState& state);

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
  sensing::VehicleSensors sensors_;
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

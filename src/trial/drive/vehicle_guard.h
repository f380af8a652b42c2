// What the rover makes of what it feels, on board: the hazard criteria of the vehicle sensors. The
// navigator is told of its hazards, and the record of a drive takes its counts.
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

// Judges what is felt; it costs nothing where the rover has none of these sensors.
class VehicleGuard {
 public:
  explicit VehicleGuard(const DriveParams& drive);

  // Takes what was felt over one control tick, what the wheels were told and what was measured of
  // their motion. Returns the hazards of kinds that were not felt at the tick before.
  std::vector<messages::VehicleHazard> Feel(const messages::VehicleState& felt,
                                            const messages::WheelCommand& command,
                                            const messages::MotionMeasurement& motion);

  // Operators moved the rover by hand: nothing is felt, and nothing of what was felt before counts
  // towards a hazard.
  void OnPlaced();

  // Return what the rover felt at the last tick: what it has to get away from, null where there is
  // nothing, and whether something touches it behind.
  const messages::VehicleHazard* hazard() const { return hazard_ ? &*hazard_ : nullptr; }
  bool touches_behind() const { return felt_.touches_behind; }
  // Returns what was measured at the last tick.
  const messages::VehicleState& measured() const { return measured_; }

  // Returns how often a hazard of that kind appeared, whatever else was felt.
  std::int64_t count(messages::VehicleHazardKind kind) const {
    return counts_[static_cast<std::size_t>(kind)];
  }

  // Returns how often there came to be something to get away from.
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

// Returns "contact left" and so on, for traces: no record holds these texts.
std::string Describe(const messages::VehicleHazard& hazard);

}  // namespace rockyard::trial

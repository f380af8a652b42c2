// What becomes of the alarms of the slip check in a drive (navigation.on_slip): the drive ends, or
// the navigator is told. Onboard keeps it.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "messages/vehicle_state.h"
#include "navigation/reaction_params.h"

namespace rockyard::trial {

// An alarm as the navigator is told of it, at one tick.
struct ToldSlip {
  std::optional<messages::VehicleHazard> hazard;  // ahead, where the navigator is to plan anew
  bool as_stuck = false;                          // where the rover takes itself for stuck
};

// An alarm is raised by what was seen; at the next decision it ends the drive or is told. EndsDrive
// has to be asked before Take, which takes the alarm back. Records depend on max_alarms: the alarm
// after so many ends the drive.
class SlipAlarms {
 public:
  explicit SlipAlarms(const navigation::SlipReactionParams& params) : params_(params) {}

  void Raise() {
    raised_ = true;
    ++count_;
  }
  // The rover was moved by hand.
  void OnPlaced() { raised_ = false; }

  // Returns whether the drive ends by the alarm that is raised.
  bool EndsDrive() const {
    return raised_ &&
           (params_.reaction == navigation::SlipResponse::kStop || count_ > params_.max_alarms);
  }

  // Returns what the navigator is told, once for each alarm; nothing where none is raised.
  std::optional<ToldSlip> Take() {
    if (!std::exchange(raised_, false)) return std::nullopt;
    if (params_.reaction == navigation::SlipResponse::kAsStuck) return ToldSlip{{}, true};
    return ToldSlip{
        messages::VehicleHazard{messages::VehicleHazardKind::kSlip, messages::HazardSide::kAhead},
        false};
  }

 private:
  navigation::SlipReactionParams params_;
  bool raised_ = false;
  std::int64_t count_ = 0;
};

}  // namespace rockyard::trial

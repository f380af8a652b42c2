// What becomes of the alarms of the slip check in a drive (navigation.on_slip).
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "messages/vehicle_state.h"
#include "navigation/reaction_params.h"

namespace rockyard::trial {

// An alarm as the navigator is told of it, at one tick.
struct ToldSlip {
  std::optional<messages::VehicleHazard> hazard;  // ahead, where it is to plan anew
  bool as_stuck = false;
};

// Raised by what was seen, ended or told at the next decision.
class SlipAlarms {
 public:
  explicit SlipAlarms(const navigation::SlipReactionParams& params) : params_(params) {}

  void Raise() {
    raised_ = true;
    ++count_;
  }
  // The rover was moved by hand.
  void OnPlaced() { raised_ = false; }

  // Whether the drive ends by the alarm that is raised.
  bool EndsDrive() const {
    return raised_ &&
           (params_.reaction == navigation::SlipResponse::kStop || count_ > params_.max_alarms);
  }

  // What the navigator is told, once an alarm; nothing where none is raised.
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

// Parameters of what a rover does that notices that it is stuck, or whose check of slip raises an
// alarm. StuckReaction and the on-board side of a drive (trial/aids/slip_alarms.h) read them. The
// defaults add no manoeuvre to those of the papers. They decide records of scenarios that leave
// them out; a bound only refuses files. Scenario files hold the names of the responses.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"

namespace rockyard::navigation {

// What follows where the rover notices that it is stuck (perception.stuck_detector). Neither paper
// has a rule for it, so all of this is assumed.
enum class StuckResponse {
  kOff,      // the rover does not look for signs of it
  kGiveUp,   // the rover stops and waits for its operators
  kBackOff,  // the rover drives back once, and gives up where it notices again that it is stuck
};

struct StuckReactionParams {
  StuckResponse reaction = StuckResponse::kOff;
  double back_off_m = 0.20;

  void Visit(core::FieldVisitor& v);
};

// What follows an alarm of the slip check (perception/visual_motion.h).
enum class SlipResponse {
  kStop,     // the rover stops where it is and waits for its operators
  kAsStuck,  // what on_board_stuck.reaction says
  kReplan,   // the navigator takes it as a hazard that the rover feels ahead
};

struct SlipReactionParams {
  SlipResponse reaction = SlipResponse::kStop;
  std::int64_t max_alarms = 3;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::StuckResponse> {
  static constexpr std::array<std::string_view, 3> kNames{"off", "give_up", "back_off"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::SlipResponse> {
  static constexpr std::array<std::string_view, 3> kNames{"stop", "as_stuck", "replan"};
};

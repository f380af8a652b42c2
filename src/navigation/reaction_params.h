// What a rover does that notices that it is stuck, or whose check of slip raises an alarm. The
// defaults add no manoeuvre to those of the papers.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"

namespace rockyard::navigation {

// What follows where the rover notices that it is stuck (perception.stuck_detector). Neither paper
// has a rule for it, so all of this is assumed.
enum class StuckResponse {
  kOff,      // it does not look for it
  kGiveUp,   // it stops and waits for its operators
  kBackOff,  // it drives back once, and gives up where it notices it again
};

struct StuckReactionParams {
  StuckResponse reaction = StuckResponse::kOff;
  double back_off_m = 0.20;

  void Visit(core::FieldVisitor& v);
};

// What follows an alarm (perception/visual_motion.h).
enum class SlipResponse {
  kStop,     // it stops where it is and waits for its operators
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

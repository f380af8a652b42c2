// What a rover does whose check of slip raises an alarm (perception/visual_motion.h).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"

namespace rockyard::navigation {

// What follows an alarm.
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
struct rockyard::core::EnumNames<rockyard::navigation::SlipResponse> {
  static constexpr std::array<std::string_view, 3> kNames{"stop", "as_stuck", "replan"};
};

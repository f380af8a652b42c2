// What a rover does that notices that it is stuck (perception.stuck_detector). Neither paper has a
// rule for it, so all of this is assumed.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"

namespace rockyard::navigation {

// What follows where the rover notices that it is stuck.
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

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::StuckResponse> {
  static constexpr std::array<std::string_view, 3> kNames{"off", "give_up", "back_off"};
};

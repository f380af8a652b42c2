// What the Pathfinder controller does about a hazard that the rover feels. Matthies 1995, section
// 6, names the sensors; section 7 has rules for what is seen only. All of this is assumed.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::navigation {

// What follows when max_repeats reactions have brought no progress.
enum class ReactionsExhausted {
  kGiveUp,
  kGoOn,  // felt hazards are ignored for ignore_m of driving
};

struct VehicleReactionParams {
  double back_off_m = 0.20;
  double turn_rad = math::DegToRad(45.0);
  double straight_m = 0.30;
  std::int64_t max_repeats = 6;
  double progress_m = 0.25;
  ReactionsExhausted on_exhausted = ReactionsExhausted::kGiveUp;
  double ignore_m = 0.50;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::ReactionsExhausted> {
  static constexpr std::array<std::string_view, 2> kNames{"give_up", "go_on"};
};

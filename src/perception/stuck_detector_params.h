// When the rover takes itself for stuck (stuck_detector.h; scenario group
// perception.stuck_detector). Neither paper has such a rule, so every value is assumed. Defaults
// decide records where navigation.on_board_stuck asks for the rule.
#pragma once

#include <cstdint>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::perception {

struct StuckDetectorParams {
  double window_s = 5.0;
  double min_told_turn_rad = math::DegToRad(20.0);
  double min_turn_share = 0.2;
  double strain_current_A = 0.05;
  std::int64_t strained_wheels = 4;
  double strain_share = 0.9;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::perception

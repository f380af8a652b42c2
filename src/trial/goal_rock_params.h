// A rock at the goal that a drive has to find.
#pragma once

#include <cstdint>
#include <vector>

#include "core/fields.h"
#include "messages/estimates.h"

namespace rockyard::trial {

// Further places that a rover drives to that has not found the rock where it was told: corners of
// squares around the told place, one square after the other, each as much larger as the first.
struct LocalSearchParams {
  std::int64_t squares = 0;  // 0: none
  double spacing_m = 0.5;    // half the side of the first square, and what each later one adds

  // The corners in the order of driving, in the frame of the told place: square i = 1, 2, ... has
  // its corners i spacing_m off along x and y, begun where x and y are positive and driven
  // counter-clockwise.
  std::vector<messages::Goal> Places(const messages::Goal& told) const;

  void Visit(core::FieldVisitor& v);
};

struct GoalRockParams {
  bool enabled = false;
  double diameter_m = 0.30;
  double height_m = 0.20;
  double recognition_m = 0.0;  // 0: never recognized
  LocalSearchParams search;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial

// A path whose curvature goes from knot to knot.
#pragma once

namespace rockyard::messages {

// A spline of two clothoids (Howard 2012, section 3): the curvature at the start, at the knot in
// the middle and at the one at the end, positive turns left. Between them it is linear.
struct Spline {
  double start_per_m = 0.0;
  double first_knot_per_m = 0.0;   // after half of the length
  double second_knot_per_m = 0.0;  // after all of it, and beyond
  double length_m = 0.0;

  bool operator==(const Spline&) const = default;
};

}  // namespace rockyard::messages

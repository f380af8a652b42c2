// Angles beyond the reach of quick reduction, and close to multiples of pi/2: for trigonometry.cc.
#pragma once

#include "math/double_double.h"

namespace rockyard::math {

// An angle is quadrant pi/2 + rest, modulo 2 pi.
struct ReducedAngle {
  DoubleDouble rest;  // within pi/4 and a bit
  int quadrant = 0;   // 0 to 3
};

// Returns so of any angle of 2^-27 or more, with a rest to 100 bits; of what is no number or
// infinite, a rest that is no number.
ReducedAngle ReduceLargeAngle(double radians);

}  // namespace rockyard::math

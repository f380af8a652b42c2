// What functions.h is put together from where a double holds too few bits on the way.
#pragma once

#include "math/double_double.h"

namespace rockyard::math {

// Added to a number below 2^51 and taken off again, it leaves the nearest whole number; the sum
// ends in its bits.
inline constexpr double kToWhole = 0x1.8p52;

inline constexpr DoubleDouble kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

// Returns the natural logarithm of a number that is positive and finite, to about 66 bits.
DoubleDouble LogParts(double x);

// Returns e^(x.high + x.low).
double ExpOf(const DoubleDouble& x);

}  // namespace rockyard::math

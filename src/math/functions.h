/// @file
/// Elementary functions that give the same bits on every processor, operating system and compiler:
/// additions, multiplications, divisions and square roots in a fixed order, none of them fused, and
/// operations on integers. The C library chooses code with or without fused operations by the
/// processor that it meets, so that its last bits differ among machines; every record, image and
/// table of a trial is computed by the functions here. scripts/check_layers.py holds modules of
/// trials to that. Header only, so that plugins, which link nothing of rockyard, have them too.
///
/// Angles are in radians. Errors are below 1 unit in the last place but where a function says
/// otherwise; results that are subnormal are rounded twice. Arguments that
/// are not numbers, infinite, zeros of either sign and subnormal are answered as IEEE 754 and C
/// (annex F) ask, but that no flag and no errno is set. Rounding must be to the nearest.
#pragma once

#include <cmath>

#include "math/arcs.h"
#include "math/exponentials.h"
#include "math/logarithms.h"
#include "math/trigonometry.h"

namespace rockyard::math {

/// Returns 1 - erf(x) to 4 units in the last place; less where it is subnormal.
double Erfc(double x);

/// Returns E1(x), the integral of exp(-t)/t from x > 0 on, to 2e-15 of itself.
double ExponentialIntegral(double x);

/// Returns the square root of x^2 + y^2 to 1.5 units in the last place, as Eigen's norm does: it
/// overflows above 1e154 and loses digits below 1e-146.
inline double Hypot(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace rockyard::math

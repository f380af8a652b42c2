/// @file
/// Elementary functions that give the same bits on every processor, operating system and compiler:
/// additions, multiplications, divisions and square roots in a fixed order, none of them fused, and
/// operations on integers. The C library chooses code with or without fused operations by the
/// processor that it meets, so that its last bits differ among machines; every record, image and
/// table of a trial is computed by the functions here. scripts/check_layers.py holds modules of
/// trials to that.
///
/// Errors are below 1 unit in the last place but where a function says otherwise. Arguments that
/// are not numbers, infinite, zeros of either sign and subnormal are answered as IEEE 754 and C
/// (annex F) ask, but that no flag and no errno is set. Rounding must be to the nearest.
#pragma once

#include <cmath>

namespace rockyard::math {

/// Sine and cosine of one angle, for about the price of one of them.
struct SineCosine {
  double sin = 0.0;
  double cos = 1.0;
};
SineCosine SinCos(double radians);

double Sin(double radians);
double Cos(double radians);
double Tan(double radians);

/// Return radians, in [-pi/2, pi/2], [0, pi], [-pi/2, pi/2] and [-pi, pi].
double Asin(double x);
double Acos(double x);
double Atan(double x);
double Atan2(double y, double x);

/// Return e^x, 2^x and e^x - 1. Results that are subnormal are rounded twice.
double Exp(double x);
double Exp2(double x);
double Expm1(double x);

/// Return the natural logarithm, that to the bases 2 and 10, and that of 1 + x.
double Log(double x);
double Log2(double x);
double Log10(double x);
double Log1p(double x);

/// Returns x^y. Small whole powers are quicker as products.
double Pow(double x, double y);

/// Returns 1 - erf(x) to 4 units in the last place; less where it is subnormal.
double Erfc(double x);

/// Returns the square root of x^2 + y^2 to 1.5 units in the last place, as Eigen's norm does: it
/// overflows above 1e154 and loses digits below 1e-146.
inline double Hypot(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace rockyard::math

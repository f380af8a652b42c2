/// @file
/// Inverse functions of sine, cosine and tangent: a table of arctangents of sixteenths and a short
/// series; for arcsines a polynomial. Part of math/functions.h.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "math/double_double.h"

namespace rockyard::math {
namespace functions {

/// pi/2.
inline constexpr DoubleDouble kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// arctan(k/16): each is the one before and the arctangent of 16/(256 + k(k - 1)), by its series.
inline constexpr std::size_t kSixteenths = 16;
constexpr std::array<DoubleDouble, kSixteenths + 1> MakeArcs() {
  std::array<DoubleDouble, kSixteenths + 1> arcs{};
  for (std::size_t k = 1; k <= kSixteenths; ++k) {
    const DoubleDouble t = DoubleDouble{16.0} / static_cast<double>(256 + k * (k - 1));
    const DoubleDouble minus_t2 = DoubleDouble{-t.high, -t.low} * t;
    DoubleDouble sum;
    for (int n = 27; n > 0; n -= 2) sum = DoubleDouble{1.0} / n + minus_t2 * sum;
    arcs[k] = arcs[k - 1] + t * sum;
  }
  return arcs;
}
inline constexpr std::array<DoubleDouble, kSixteenths + 1> kArcs = MakeArcs();

/// Returns arctan(y/x), in parts, of x >= y >= 0, x > 0, neither so large nor so small that 17 x or
/// the last bits of y are lost.
inline DoubleDouble ArcParts(double y, double x) {
  const double ratio = y / x;
  const double nearest = ratio * kSixteenths + 0.5;
  const auto k = static_cast<std::size_t>(nearest);
  double t = ratio;
  if (k > 0) {
    /// x c is exact in two parts, so that a difference that cancels keeps its bits.
    const double c = static_cast<double>(k) / kSixteenths;
    const double x_high = (x * 0x1p6 + x) - x * 0x1p6;
    t = ((y - x_high * c) - (x - x_high) * c) / (x + y * c);
  }
  const double t2 = t * t;
  const double p = (-1.0 / 3.0 + t2 * (1.0 / 5.0)) +
                   t2 * t2 * ((-1.0 / 7.0 + t2 * (1.0 / 9.0)) + t2 * t2 * (-1.0 / 11.0));
  const DoubleDouble& arc = kArcs[k];
  const DoubleDouble sum = FastSum(arc.high, t);
  return {sum.high, sum.low + (arc.low + t * t2 * p)};
}

/// Returns the arctangent of y/x, both positive or zero but not both zero, in [0, pi/2], in parts.
inline DoubleDouble ArcOfQuotient(double y, double x) {
  if (y <= x) return ArcParts(y, x);
  const DoubleDouble arc = ArcParts(x, y);
  const DoubleDouble sum = FastSum(kHalfPi.high, -arc.high);
  return {sum.high, sum.low + (kHalfPi.low - arc.low)};
}

}  // namespace functions

/// Returns the angle in [-pi, pi] from the x axis to the point (x, y), to 1.5 units in the last
/// place.
inline double Atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  double height = std::abs(y);
  double length = std::abs(x);
  if (std::isinf(height) && std::isinf(length)) height = length = 1.0;
  const double most = height > length ? height : length;
  DoubleDouble arc;
  if (most == 0.0 || std::isinf(length)) {
    arc = {};
  } else if (std::isinf(height)) {
    arc = functions::kHalfPi;
  } else {
    if (most > 0x1p1000) {
      height *= 0x1p-60;
      length *= 0x1p-60;
    } else if (most < 0x1p-900) {
      height *= 0x1p110;
      length *= 0x1p110;
    }
    arc = functions::ArcOfQuotient(height, length);
  }
  if (std::signbit(x)) {
    const DoubleDouble sum = FastSum(2.0 * functions::kHalfPi.high, -arc.high);
    arc = {sum.high, sum.low + (2.0 * functions::kHalfPi.low - arc.low)};
  }
  return std::copysign(arc.high + arc.low, y);
}

/// Returns the angle in [-pi/2, pi/2] whose tangent is x, to 1.5 units in the last place.
inline double Atan(double x) {
  if (std::isnan(x)) return x;
  const double size = std::abs(x);
  if (size > 0x1p60) return std::copysign(functions::kHalfPi.high, x);
  const DoubleDouble arc = functions::ArcOfQuotient(size, 1.0);
  return std::copysign(arc.high + arc.low, x);
}

namespace functions {

/// Returns (arcsin(x) - x)/x^3 of |x| <= 1/2, given z = x^2: a minimax polynomial, by Remez'
/// exchange in 400 bits, which leaves 2^-60 of the arcsine.
inline double ArcsineRest(double z) {
  const double z2 = z * z;
  const double z4 = z2 * z2;
  const double low = (0x1.5555555555578p-3 + z * 0x1.333333332df7ep-4) +
                     z2 * (0x1.6db6db7226100p-5 + z * 0x1.f1c71a8dc27c4p-6);
  const double middle = (0x1.6e8bdfa6759bbp-6 + z * 0x1.1c49e2bba2e27p-6) +
                        z2 * (0x1.ca20cdfe68b9ep-7 + z * 0x1.757b7ae34dfbep-7);
  const double high = (0x1.6173ed8e93cdap-7 + z * 0x1.e2befe6c3eedep-9) +
                      z2 * (0x1.649288035fc50p-6 + z * -0x1.595446318c19bp-6);
  return low + z4 * (middle + z4 * (high + z4 * 0x1.0bb04f15b7868p-5));
}

/// Returns 2 arcsin(sqrt((1 - x)/2)) = arccos(x) of x in [1/2, 1], in parts.
inline DoubleDouble ArccosineAbove(double x) {
  const double z = 0.5 - 0.5 * x;  ///< exact
  const double root = std::sqrt(z);
  if (root == 0.0) return {};
  const DoubleDouble square = ExactProduct(root, root);
  const double missing = ((z - square.high) - square.low) / (2.0 * root);
  return {2.0 * root, 2.0 * (missing + root * z * ArcsineRest(z))};
}

}  // namespace functions

/// Returns the angle in [-pi/2, pi/2] whose sine is x.
inline double Asin(double x) {
  const double size = std::abs(x);
  if (!(size <= 1.0)) return std::numeric_limits<double>::quiet_NaN();
  if (size < 0x1p-27) return x;
  if (size <= 0.5) return x + x * (x * x) * functions::ArcsineRest(x * x);
  const DoubleDouble cosine = functions::ArccosineAbove(size);
  const DoubleDouble sum = FastSum(functions::kHalfPi.high, -cosine.high);
  return std::copysign(sum.high + (sum.low + (functions::kHalfPi.low - cosine.low)), x);
}

/// Returns the angle in [0, pi] whose cosine is x.
inline double Acos(double x) {
  const double size = std::abs(x);
  if (!(size <= 1.0)) return std::numeric_limits<double>::quiet_NaN();
  if (size <= 0.5) {
    const DoubleDouble sum = FastSum(functions::kHalfPi.high, -x);
    return sum.high +
           (sum.low + (functions::kHalfPi.low - x * (x * x) * functions::ArcsineRest(x * x)));
  }
  const DoubleDouble arc = functions::ArccosineAbove(size);
  if (x > 0.0) return arc.high + arc.low;
  const DoubleDouble sum = FastSum(2.0 * functions::kHalfPi.high, -arc.high);
  return sum.high + (sum.low + (2.0 * functions::kHalfPi.low - arc.low));
}

}  // namespace rockyard::math

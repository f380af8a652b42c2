// Sine, cosine and tangent: the angle less a multiple of pi/2, then a polynomial.

#include <bit>
#include <cmath>
#include <cstdint>

#include "math/double_double.h"
#include "math/function_parts.h"
#include "math/functions.h"
#include "math/large_angle.h"

namespace rockyard::math {
namespace {

// An angle of which less is its own sine, and an angle from which on the first steps below are not
// exact any more.
constexpr double kTiny = 0x1p-27;
constexpr double kLarge = 0x1p20;

// Returns the angle less the nearest multiple of pi/2 (Cody & Waite 1980). pi/2 comes in parts of
// 33, 30 and 53 bits, so that the first two products are exact. What is left of an angle close to a
// multiple has lost too many bits, and goes through ReduceLargeAngle.
ReducedAngle Reduce(double radians) {
  constexpr double kPart1 = 0x1.921fb544p+0;
  constexpr double kPart2 = 0x1.0b4611ap-34;
  constexpr double kPart3 = 0x1.898cc51701b84p-64;
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  if (!(std::abs(radians) < kLarge)) return ReduceLargeAngle(radians);
  const double shifted = radians * kTwoOverPi + kToWhole;
  const double n = shifted - kToWhole;
  const double rest = radians - n * kPart1;
  const double second = n * kPart2;
  const double first = rest - second;
  const double low = ((rest - first) - second) - n * kPart3;
  const double high = first + low;
  if (std::abs(high) < kTiny && n != 0.0) return ReduceLargeAngle(radians);
  return {{high, (first - high) + low},
          static_cast<int>(std::bit_cast<std::uint64_t>(shifted) & 3)};
}

// Sine and cosine of an angle within pi/4 and a bit, as a double and what is missing of it. The
// polynomials are minimax ones: by Remez' exchange, in 400 bits, with errors of 2^-58 and 2^-64.
DoubleDouble SineParts(const DoubleDouble& angle) {
  const double x = angle.high;
  const double z = x * x;
  const double z2 = z * z;
  const double p = (-0x1.5555555555549p-3 + z * 0x1.111111110f87ap-7) +
                   z2 * ((-0x1.a01a019c119cap-13 + z * 0x1.71de3577b8c74p-19) +
                         z2 * (-0x1.ae5e663bf0fbfp-26 + z * 0x1.5d9301523a4bap-33));
  return {x, x * z * p + angle.low * (1.0 - 0.5 * z)};
}

DoubleDouble CosineParts(const DoubleDouble& angle) {
  const double x = angle.high;
  const double z = x * x;
  const double z2 = z * z;
  const double p = (0x1.555555555554cp-5 + z * -0x1.6c16c16c1517ep-10) +
                   z2 * ((0x1.a01a019cb1be1p-16 + z * -0x1.27e4f809f01f7p-22) +
                         z2 * (0x1.1ee9ebe86e706p-29 + z * -0x1.8fae9bea5625dp-37));
  const double half = 0.5 * z;
  const double most = 1.0 - half;
  return {most, ((1.0 - most) - half) + (z2 * p - x * angle.low)};
}

double SineWithin(const DoubleDouble& angle) {
  const DoubleDouble parts = SineParts(angle);
  return parts.high + parts.low;
}

double CosineWithin(const DoubleDouble& angle) {
  const DoubleDouble parts = CosineParts(angle);
  return parts.high + parts.low;
}

// Returns a/b. The first quotient is corrected by what it leaves of a, and by the low parts.
double Quotient(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble above = FastSum(a.high, a.low);
  const DoubleDouble below = FastSum(b.high, b.low);
  const double first = above.high / below.high;
  const DoubleDouble product = ExactProduct(first, below.high);
  const double rest = (above.high - product.high) - product.low + above.low - first * below.low;
  return first + rest / below.high;
}

}  // namespace

double Sin(double radians) {
  if (std::abs(radians) < kTiny) return radians;
  const ReducedAngle reduced = Reduce(radians);
  const double value = reduced.quadrant & 1 ? CosineWithin(reduced.rest) : SineWithin(reduced.rest);
  return reduced.quadrant & 2 ? -value : value;
}

double Cos(double radians) {
  const ReducedAngle reduced = Reduce(radians);
  const double value = reduced.quadrant & 1 ? SineWithin(reduced.rest) : CosineWithin(reduced.rest);
  return (reduced.quadrant + 1) & 2 ? -value : value;
}

SineCosine SinCos(double radians) {
  if (std::abs(radians) < kTiny) return {radians, 1.0};
  const ReducedAngle reduced = Reduce(radians);
  const double s = SineWithin(reduced.rest);
  const double c = CosineWithin(reduced.rest);
  const double sine = reduced.quadrant & 1 ? c : s;
  const double cosine = reduced.quadrant & 1 ? s : c;
  return {reduced.quadrant & 2 ? -sine : sine, (reduced.quadrant + 1) & 2 ? -cosine : cosine};
}

double Tan(double radians) {
  if (std::abs(radians) < kTiny) return radians;
  const ReducedAngle reduced = Reduce(radians);
  const DoubleDouble s = SineParts(reduced.rest);
  const DoubleDouble c = CosineParts(reduced.rest);
  return reduced.quadrant & 1 ? -Quotient(c, s) : Quotient(s, c);
}

}  // namespace rockyard::math

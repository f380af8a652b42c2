/// @file
/// Sine, cosine and tangent: the angle less a multiple of pi/2, then a polynomial. Part of
/// math/functions.h.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "math/double_double.h"

namespace rockyard::math {
namespace functions {

/// An angle is quadrant pi/2 + rest, modulo 2 pi.
struct ReducedAngle {
  DoubleDouble rest;  ///< within pi/4 and a bit
  int quadrant = 0;   ///< 0 to 3
};

/// Products of 64 bits.
__extension__ using Wide = unsigned __int128;

/// 2/pi = 0.a2f9836e... in base 16: 1280 bits, more than the largest double needs.
inline constexpr std::array<std::uint64_t, 20> kTwoOverPiBits = {
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
    0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484,
    0xe99c7026b45f7e41, 0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f,
    0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d, 0x7527bac7ebe5f17b,
    0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d};

/// pi/2 in units of 2^-127.
inline constexpr std::uint64_t kHalfPiHigh = 0xc90fdaa22168c234;
inline constexpr std::uint64_t kHalfPiLow = 0xc4c6628b80dc1cd1;

/// Returns 64 bits of 2/pi from the bit of weight 2^-(first + 1) on; bits before the point are 0.
inline std::uint64_t BitsFrom(int first) {
  const auto word = [](int i) {
    return i < 0 || i >= static_cast<int>(kTwoOverPiBits.size())
               ? std::uint64_t{0}
               : kTwoOverPiBits[static_cast<std::size_t>(i)];
  };
  const int at = first >> 6;  ///< rounds down
  const int shift = first & 63;
  return shift == 0 ? word(at) : (word(at) << shift) | (word(at + 1) >> (64 - shift));
}

/// Returns the product of two numbers in units of 2^-128 and 2^-127 over 2^127, rounded down.
inline Wide TimesHalfPi(Wide x) {
  const std::uint64_t high = static_cast<std::uint64_t>(x >> 64);
  const std::uint64_t low = static_cast<std::uint64_t>(x);
  const Wide middle1 = Wide{high} * kHalfPiLow;
  const Wide middle2 = Wide{low} * kHalfPiHigh;
  const Wide carry = ((Wide{low} * kHalfPiLow) >> 64) + static_cast<std::uint64_t>(middle1) +
                     static_cast<std::uint64_t>(middle2);
  return Wide{high} * kHalfPiHigh + (middle1 >> 64) + (middle2 >> 64) + (carry >> 64);
}

/// Payne & Hanek 1983, in whole numbers: of the product with 2/pi only the bits from weight 2 on,
/// 192 of them, are computed. Takes angles of 2^-27 or more; of what is no number or infinite, the
/// rest is no number.
[[gnu::cold, gnu::noinline]] inline ReducedAngle ReduceLargeAngle(double radians) {
  if (!std::isfinite(radians)) return {.rest = {radians - radians, 0.0}};
  const auto bits = std::bit_cast<std::uint64_t>(std::abs(radians));
  const std::uint64_t mantissa = (bits & 0xfffffffffffff) | 0x10000000000000;
  const int exponent = static_cast<int>(bits >> 52) - 1075;  ///< of the mantissa's last bit
  /// Bits of 2/pi of a weight above 2 / 2^exponent add whole turns.
  const int first = exponent - 2;
  std::array<std::uint64_t, 3> part{};  ///< of x 2/pi modulo 4, in units of 2^-190, highest first
  Wide carry = 0;
  for (int i = 2; i >= 0; --i) {
    const Wide product = Wide{mantissa} * BitsFrom(first + 64 * i) + carry;
    part[static_cast<std::size_t>(i)] = static_cast<std::uint64_t>(product);
    carry = product >> 64;
  }
  /// What is above half a quadrant belongs to the next one, from which it is missing.
  int quadrant = static_cast<int>(part[0] >> 62);
  const bool from_above = (part[0] >> 61) & 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint64_t next = i < 2 ? part[i + 1] >> 62 : 0;
    part[i] = (part[i] << 2) | next;
    if (from_above) part[i] = ~part[i];
  }
  if (from_above) ++quadrant;
  int shift = 0;
  while (part[0] == 0 && shift < 128) {
    part = {part[1], part[2], 0};
    shift += 64;
  }
  Wide fraction = (Wide{part[0]} << 64) | part[1];
  const int lead = part[0] == 0 ? 0 : std::countl_zero(part[0]);
  if (lead > 0) fraction = (fraction << lead) | (part[2] >> (64 - lead));
  shift += lead;
  /// In units of 2^-127 of pi/2, over 2^shift.
  const Wide angle = TimesHalfPi(fraction);
  const double unit = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - 127 - shift) << 52);
  const Wide top = angle >> 75;
  const double high = static_cast<double>(static_cast<std::uint64_t>(top)) * 0x1p75 * unit;
  const Wide remaining = angle - (top << 75);
  const double low =
      (static_cast<double>(static_cast<std::uint64_t>(remaining >> 22)) * 0x1p22) * unit;
  const DoubleDouble rest = FastSum(high, low);
  const bool negative = std::signbit(radians) != from_above;
  if (std::signbit(radians)) quadrant = -quadrant;
  return {.rest = negative ? DoubleDouble{-rest.high, -rest.low} : rest, .quadrant = quadrant & 3};
}

/// An angle of which less is its own sine, and an angle from which on the first steps below are not
/// exact any more.
inline constexpr double kTiny = 0x1p-27;
inline constexpr double kLarge = 0x1p20;

/// Returns the angle less the nearest multiple of pi/2 (Cody & Waite 1980). pi/2 comes in parts of
/// 33, 30 and 53 bits, so that the first two products are exact. What is left of an angle close to
/// a multiple has lost too many bits, and goes through ReduceLargeAngle.
inline ReducedAngle Reduce(double radians) {
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

/// Sine and cosine of an angle within pi/4 and a bit, as a double and what is missing of it. The
/// polynomials are minimax ones: by Remez' exchange, in 400 bits, with errors of 2^-58 and 2^-64.
inline DoubleDouble SineParts(const DoubleDouble& angle) {
  const double x = angle.high;
  const double z = x * x;
  const double z2 = z * z;
  const double p = (-0x1.5555555555549p-3 + z * 0x1.111111110f87ap-7) +
                   z2 * ((-0x1.a01a019c119cap-13 + z * 0x1.71de3577b8c74p-19) +
                         z2 * (-0x1.ae5e663bf0fbfp-26 + z * 0x1.5d9301523a4bap-33));
  return {x, x * z * p + angle.low * (1.0 - 0.5 * z)};
}

/// So for the cosine.
inline DoubleDouble CosineParts(const DoubleDouble& angle) {
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

/// Returns the sum of both parts.
inline double SineWithin(const DoubleDouble& angle) {
  const DoubleDouble parts = SineParts(angle);
  return parts.high + parts.low;
}

/// So for the cosine.
inline double CosineWithin(const DoubleDouble& angle) {
  const DoubleDouble parts = CosineParts(angle);
  return parts.high + parts.low;
}

/// Returns a/b. The first quotient is corrected by what it leaves of a, and by the low parts.
inline double Quotient(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble above = FastSum(a.high, a.low);
  const DoubleDouble below = FastSum(b.high, b.low);
  const double first = above.high / below.high;
  const DoubleDouble product = ExactProduct(first, below.high);
  const double rest = (above.high - product.high) - product.low + above.low - first * below.low;
  return first + rest / below.high;
}

}  // namespace functions

/// Returns the sine of an angle.
inline double Sin(double radians) {
  if (std::abs(radians) < functions::kTiny) return radians;
  const functions::ReducedAngle reduced = functions::Reduce(radians);
  const double value = reduced.quadrant & 1 ? functions::CosineWithin(reduced.rest)
                                            : functions::SineWithin(reduced.rest);
  return reduced.quadrant & 2 ? -value : value;
}

/// Returns the cosine of an angle.
inline double Cos(double radians) {
  const functions::ReducedAngle reduced = functions::Reduce(radians);
  const double value = reduced.quadrant & 1 ? functions::SineWithin(reduced.rest)
                                            : functions::CosineWithin(reduced.rest);
  return (reduced.quadrant + 1) & 2 ? -value : value;
}

/// Sine and cosine of one angle.
struct SineCosine {
  double sin = 0.0;
  double cos = 1.0;
};

/// Returns both, the bits of Sin and Cos, for little more than the price of one.
inline SineCosine SinCos(double radians) {
  if (std::abs(radians) < functions::kTiny) return {radians, 1.0};
  const functions::ReducedAngle reduced = functions::Reduce(radians);
  const double s = functions::SineWithin(reduced.rest);
  const double c = functions::CosineWithin(reduced.rest);
  const double sine = reduced.quadrant & 1 ? c : s;
  const double cosine = reduced.quadrant & 1 ? s : c;
  return {reduced.quadrant & 2 ? -sine : sine, (reduced.quadrant + 1) & 2 ? -cosine : cosine};
}

/// Returns the tangent of an angle, to 1.1 units in the last place.
inline double Tan(double radians) {
  if (std::abs(radians) < functions::kTiny) return radians;
  const functions::ReducedAngle reduced = functions::Reduce(radians);
  const DoubleDouble s = functions::SineParts(reduced.rest);
  const DoubleDouble c = functions::CosineParts(reduced.rest);
  return reduced.quadrant & 1 ? -functions::Quotient(c, s) : functions::Quotient(s, c);
}

}  // namespace rockyard::math

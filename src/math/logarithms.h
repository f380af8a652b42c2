/// @file
/// Logarithms: a table of the logarithms of 65 numbers between 1 and 2, and a short series. Part of
/// math/functions.h.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "math/double_double.h"

namespace rockyard::math {
namespace functions {

/// The natural logarithm of 2.
inline constexpr DoubleDouble kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

/// log x = exponent ln 2 - log c + log(1 + r) with r = m c - 1, where x = 2^exponent m. c is close
/// to 1/m and has so few bits that m c is exact in two parts. Around m = 1, c is 1.
inline constexpr std::size_t kSteps = 64;
inline constexpr std::size_t kFirstHalved = 27;  ///< numbers from 1.41 on are halved

/// Parts of 42 bits behind the point for sums with `exponent` that are exact.
struct Centre {
  double c = 1.0;
  double high = 0.0;  ///< of -log c
  double low = 0.0;
};
inline constexpr double kLn2High = 0x1.62e42fefa38p-1;
inline constexpr double kLn2Low = 0x1.ef35793c7673p-45;

/// Returns log c by the series of artanh((c - 1)/(c + 1)).
constexpr DoubleDouble LogOfCentre(double c) {
  const DoubleDouble t = DoubleDouble{c - 1.0} / (c + 1.0);
  const DoubleDouble t2 = t * t;
  DoubleDouble sum;
  for (int n = 47; n > 0; n -= 2) sum = DoubleDouble{1.0} / n + t2 * sum;
  sum = t * sum;
  return {2.0 * sum.high, 2.0 * sum.low};
}

/// Returns what is known of each 64th from 1 to 2.
constexpr std::array<Centre, kSteps + 1> MakeCentres() {
  std::array<Centre, kSteps + 1> centres{};
  for (std::size_t j = 0; j <= kSteps; ++j) {
    const double m = (j < kFirstHalved ? 1.0 : 0.5) * (1.0 + static_cast<double>(j) / kSteps);
    const double nearest = 512.0 / m + 0.5;
    const double c = static_cast<double>(static_cast<int>(nearest)) / 512.0;
    const DoubleDouble log = LogOfCentre(c);
    constexpr double kRound42 = 0x1.8p10;  ///< its last bit is 2^-42
    const double high = (kRound42 - log.high) - kRound42;
    centres[j] = {c, high, (-log.high - high) - log.low};
  }
  return centres;
}
inline constexpr std::array<Centre, kSteps + 1> kCentres = MakeCentres();

/// What the logarithm of a positive, finite number is put together from.
struct Parts {
  double base;      ///< exponent ln 2 - log c
  double base_low;  ///< what its rounding to 42 bits left
  double r;
  double r_low;
};

/// Returns so of a number that is positive and finite.
inline Parts Split(double x) {
  auto bits = std::bit_cast<std::uint64_t>(x);
  int exponent = -1023;
  if (x < std::numeric_limits<double>::min()) {
    bits = std::bit_cast<std::uint64_t>(x * 0x1p54);
    exponent -= 54;
  }
  exponent += static_cast<int>(bits >> 52);
  const std::uint64_t fraction = bits & 0xfffffffffffff;
  const std::size_t j = static_cast<std::size_t>((fraction + (std::uint64_t{1} << 45)) >> 46);
  const std::uint64_t halved = j >= kFirstHalved ? 1 : 0;
  exponent += static_cast<int>(halved);
  const double m = std::bit_cast<double>(fraction | ((1023 - halved) << 52));
  const double m_high =
      std::bit_cast<double>(std::bit_cast<std::uint64_t>(m) & ~std::uint64_t{0x3ff});
  const Centre& centre = kCentres[j];
  const double first = m_high * centre.c - 1.0;
  const double second = (m - m_high) * centre.c;
  const double r = first + second;
  return {exponent * kLn2High + centre.high, exponent * kLn2Low + centre.low, r,
          (first - r) + second};
}

/// Returns (log(1 + r) - r + r^2/2)/r^3: a series, as |r| < 2^-6.7.
inline double CubicRest(double r) {
  const double r2 = r * r;
  return ((1.0 / 3.0 - r * (1.0 / 4.0)) + r2 * (1.0 / 5.0 - r * (1.0 / 6.0))) +
         r2 * r2 * ((1.0 / 7.0 - r * (1.0 / 8.0)) + r2 * (1.0 / 9.0));
}

/// Returns their sum with log(1 + r).
inline double LogOf(const Parts& parts) {
  const double r = parts.r;
  const DoubleDouble sum = FastSum(parts.base, r);
  const double r2 = r * r;
  return sum.high + (sum.low + (parts.r_low + parts.base_low + r2 * (r * CubicRest(r) - 0.5)));
}

/// Answers a logarithm of what is no positive, finite number.
inline double LogOfSpecial(double x) {
  if (x == 0.0) return -std::numeric_limits<double>::infinity();
  if (x < 0.0) return std::numeric_limits<double>::quiet_NaN();
  return x;
}

/// Returns whether LogOfSpecial answers.
inline bool IsSpecial(double x) {
  return !(x > 0.0 && x < std::numeric_limits<double>::infinity());
}

/// Returns the natural logarithm of a number that is positive and finite, to about 66 bits.
inline DoubleDouble LogParts(double x) {
  const Parts parts = Split(x);
  const double r = parts.r;
  const DoubleDouble square = ExactProduct(r, r);
  const DoubleDouble quadratic = ExactSum(r, -0.5 * square.high);
  const DoubleDouble sum = ExactSum(parts.base, quadratic.high);
  const double low = (quadratic.low - 0.5 * square.low) + parts.r_low * (1.0 - r) + parts.base_low +
                     r * square.high * CubicRest(r);
  return FastSum(sum.high, sum.low + low);
}

}  // namespace functions

/// Returns the natural logarithm.
inline double Log(double x) {
  return functions::IsSpecial(x) ? functions::LogOfSpecial(x)
                                 : functions::LogOf(functions::Split(x));
}

/// Returns the natural logarithm of 1 + x.
inline double Log1p(double x) {
  if (std::abs(x) < 0x1p-54) return x;
  const double sum = 1.0 + x;
  if (functions::IsSpecial(sum)) return functions::LogOfSpecial(sum);
  functions::Parts parts = functions::Split(sum);
  /// What the sum was rounded by is exact up to 2^53, and above it is nothing beside x.
  const double left = x < 1.0 ? x - (sum - 1.0) : 1.0 - (sum - x);
  const DoubleDouble r = FastSum(parts.r, parts.r_low + left / sum * (1.0 + parts.r));
  parts.r = r.high;
  parts.r_low = r.low;
  return functions::LogOf(parts);
}

/// Returns the logarithm to the base 2.
inline double Log2(double x) {
  if (functions::IsSpecial(x)) return functions::LogOfSpecial(x);
  constexpr DoubleDouble kPerLn2{0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};
  return (functions::LogParts(x) * kPerLn2).high;
}

/// Returns the logarithm to the base 10.
inline double Log10(double x) {
  if (functions::IsSpecial(x)) return functions::LogOfSpecial(x);
  constexpr DoubleDouble kPerLn10{0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};
  return (functions::LogParts(x) * kPerLn10).high;
}

}  // namespace rockyard::math

/// @file
/// Exponential functions and powers: a table of 2^(j/32) and a short series. Part of
/// math/functions.h.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "math/double_double.h"
#include "math/logarithms.h"

namespace rockyard::math {
namespace functions {

/// What e^x is from 710 on.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// 2^(j/32), by the series of exp(j/32 ln 2).
inline constexpr std::size_t kPowers = 32;
constexpr std::array<DoubleDouble, kPowers> MakePowers() {
  std::array<DoubleDouble, kPowers> powers{};
  for (std::size_t j = 0; j < kPowers; ++j) {
    const DoubleDouble x = kLn2 * DoubleDouble{static_cast<double>(j) / kPowers};
    DoubleDouble sum{1.0};
    for (int n = 28; n > 0; --n) sum = DoubleDouble{1.0} + x * sum / n;
    powers[j] = sum;
  }
  return powers;
}
inline constexpr std::array<DoubleDouble, kPowers> kPowersOf2 = MakePowers();

/// A power of 2 in parts: 2^exponent (high + low), where high is in [1, 2).
struct PowerOf2 {
  double high;
  double low;
  int exponent;

  double Value() const;
};

/// Returns 2^exponent, which must be normal.
inline double TwoTo(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

/// Returns the double next to it.
inline double PowerOf2::Value() const {
  const double value = high + low;
  if (exponent > -1022 && exponent < 1023) return value * TwoTo(exponent);
  const int half = exponent / 2;
  return value * TwoTo(half) * TwoTo(exponent - half);
}

/// Returns 2^(n/32) (1 + more), where `more` is small: what an exponential function has reduced its
/// argument to. `shifted` is n + kToWhole.
inline PowerOf2 Assemble(double shifted, double more) {
  const auto bits = std::bit_cast<std::uint64_t>(shifted);
  const auto n = static_cast<std::int32_t>(static_cast<std::uint32_t>(bits));
  const DoubleDouble& power = kPowersOf2[static_cast<std::size_t>(n & 31)];
  return {power.high, power.low + power.high * more, n >> 5};
}

/// Returns e^(high + low) of arguments for which it is neither infinite nor rounded to zero. ln
/// 2/32 comes in parts of 36 and 53 bits, so that its first product with n is exact.
inline PowerOf2 ExpParts(double high, double low) {
  constexpr double kPerLn2 = 0x1.71547652b82fep+5;
  constexpr double kPart1 = 0x1.62e42fefap-6;
  constexpr double kPart2 = 0x1.cf79abc9e3b3ap-45;
  const double shifted = high * kPerLn2 + kToWhole;
  const double n = shifted - kToWhole;
  const double r = ((high - n * kPart1) - n * kPart2) + low;
  const double r2 = r * r;
  const double p =
      (1.0 / 2.0 + r * (1.0 / 6.0)) + r2 * ((1.0 / 24.0 + r * (1.0 / 120.0)) + r2 * (1.0 / 720.0));
  return Assemble(shifted, r + r2 * p);
}

/// From here on e^x is infinite, and up to here it rounds to zero.
inline constexpr double kOverflow = 710.0;
inline constexpr double kUnderflow = -746.0;

/// Returns e^(x.high + x.low).
inline double ExpOf(const DoubleDouble& x) {
  if (x.high >= kOverflow) return kInfinity;
  if (x.high <= kUnderflow) return 0.0;
  if (std::isnan(x.high)) return x.high;
  return ExpParts(x.high, x.low).Value();
}

}  // namespace functions

/// Returns e^x.
inline double Exp(double x) { return functions::ExpOf({x, 0.0}); }

/// Returns 2^x.
inline double Exp2(double x) {
  if (x >= 1024.0) return functions::kInfinity;
  if (x <= -1076.0) return 0.0;
  if (std::isnan(x)) return x;
  const double shifted = x * 32.0 + kToWhole;
  const double r = (x - (shifted - kToWhole) * (1.0 / 32.0)) * functions::kLn2.high;
  const double r2 = r * r;
  const double p =
      (1.0 / 2.0 + r * (1.0 / 6.0)) + r2 * ((1.0 / 24.0 + r * (1.0 / 120.0)) + r2 * (1.0 / 720.0));
  return functions::Assemble(shifted, r + r2 * p).Value();
}

/// Returns e^x - 1.
inline double Expm1(double x) {
  if (std::abs(x) < 0x1p-54) return x;
  if (x >= functions::kOverflow) return functions::kInfinity;
  if (x <= -40.0) return -1.0;
  if (std::isnan(x)) return x;
  if (std::abs(x) < 0.17) {
    double p = 1.0 / 6227020800.0;  ///< 1/13!, the last of the series
    double factorial = 6227020800.0;
    for (int n = 13; n > 3; --n) {
      factorial /= n;
      p = 1.0 / factorial + x * p;
    }
    const double x2 = x * x;
    return x + (0.5 * x2 + x2 * x * p);
  }
  const functions::PowerOf2 power = functions::ExpParts(x, 0.0);
  if (power.exponent > 60) return power.Value();
  const double unit = functions::TwoTo(power.exponent);
  const DoubleDouble less_one = ExactSum(power.high * unit, -1.0);
  return less_one.high + (less_one.low + power.low * unit);
}

namespace functions {

/// Of an exponent, by which the power of a negative number has its sign.
enum class Parity { kNoWholeNumber, kEven, kOdd };

/// Returns that of any double: large ones are even.
inline Parity ParityOf(double y) {
  if (std::abs(y) >= 0x1p53) return Parity::kEven;
  const auto whole = static_cast<std::int64_t>(y);
  if (static_cast<double>(whole) != y) return Parity::kNoWholeNumber;
  return whole & 1 ? Parity::kOdd : Parity::kEven;
}

/// Returns x^y of x > 0 and y, neither of them infinite.
inline double PositivePower(double x, double y) {
  /// The logarithm has up to 2^10 as its value and 2^63 as its inverse: beyond, x^y is infinite, 0
  /// or rounds to 1.
  if (std::abs(y) > 0x1p64) return x == 1.0 ? 1.0 : (x > 1.0) == (y > 0.0) ? kInfinity : 0.0;
  if (std::abs(y) < 0x1p-64) return 1.0;
  const DoubleDouble log = LogParts(x);
  const DoubleDouble product = ExactProduct(y, log.high);
  return ExpOf({product.high, product.low + y * log.low});
}

}  // namespace functions

/// Returns x^y. Small whole powers are quicker as products.
inline double Pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const double size = std::abs(x);
  if (std::isinf(y)) {
    if (size == 1.0) return 1.0;
    return (size > 1.0) == (y > 0.0) ? functions::kInfinity : 0.0;
  }
  const functions::Parity parity = x > 0.0 ? functions::Parity::kEven : functions::ParityOf(y);
  double power = 0.0;
  if (size == 0.0 || std::isinf(size)) {
    power = (size == 0.0) == (y > 0.0) ? 0.0 : functions::kInfinity;
  } else if (parity == functions::Parity::kNoWholeNumber) {
    return std::numeric_limits<double>::quiet_NaN();
  } else {
    power = functions::PositivePower(size, y);
  }
  return parity == functions::Parity::kOdd && std::signbit(x) ? -power : power;
}

}  // namespace rockyard::math

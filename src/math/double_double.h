/// @file
/// Sums of two doubles, which hold about 106 bits, for tables of functions.h and where a function
/// needs more than 53 bits on the way. They overflow and underflow before doubles do.
#pragma once

namespace rockyard::math {

/// Added to a number below 2^51 and taken off again, it leaves the nearest whole number; the sum
/// ends in the bits of that.
inline constexpr double kToWhole = 0x1.8p52;

/// A sum of two numbers.
struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;  ///< at most half a unit in the last place of high
};

/// Returns a + b exactly, where |a| >= |b| or a is 0 (Dekker 1971).
constexpr DoubleDouble FastSum(double a, double b) {
  const double sum = a + b;
  return {sum, (a - sum) + b};
}

/// Returns a + b exactly (Knuth, The Art of Computer Programming 2, 4.2.2).
constexpr DoubleDouble ExactSum(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// Returns a b exactly, below 2^996 (Dekker 1971, after Veltkamp).
constexpr DoubleDouble ExactProduct(double a, double b) {
  constexpr double kSplit = 0x1p27 + 1.0;
  const double a_split = a * kSplit;
  const double b_split = b * kSplit;
  const double a1 = a_split - (a_split - a);
  const double b1 = b_split - (b_split - b);
  const double a2 = a - a1;
  const double b2 = b - b1;
  const double product = a * b;
  return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
}

/// Return sums, products and quotients to about 100 bits.
constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble sum = ExactSum(a.high, b.high);
  return FastSum(sum.high, sum.low + (a.low + b.low));
}

/// So does this product.
constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = ExactProduct(a.high, b.high);
  return FastSum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

/// So does this quotient.
constexpr DoubleDouble operator/(const DoubleDouble& a, double b) {
  const double quotient = a.high / b;
  const DoubleDouble product = ExactProduct(quotient, b);
  return FastSum(quotient, ((a.high - product.high) - product.low + a.low) / b);
}

}  // namespace rockyard::math

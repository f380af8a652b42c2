#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "math/functions.h"

namespace rockyard::math {
namespace {

// Both are minimax polynomials, by Remez' exchange in 400 bits: of erf(x)/x in x^2 up to 1/2, with
// an error of 2^-65, ...
constexpr std::array kErf = {0x1.20dd750429b6dp+0,  -0x1.812746b0379e6p-2,  0x1.ce2f21a042b2ap-4,
                             -0x1.b82ce3127f806p-6, 0x1.565bcd0aaa4eep-8,   -0x1.c02db23ebc2d2p-11,
                             0x1.f9a2a6b3c1ff3p-14, -0x1.f4bba96220248p-17, 0x1.b776edab6ab9ep-20,
                             -0x1.3a00073fe21fep-23};
// ... and of (1 + 2 x) e^(x^2) erfc(x) in (x - 3)/(x + 3) from 1/2 to 28, with one of 2^-60.
constexpr std::array kErfc = {
    0x1.40c522d7e4987p+0,  -0x1.15c084bb9e8f3p-3,  -0x1.85a15c58aa5cap-5,  0x1.098366a5b46e3p-3,
    -0x1.e88b803a493efp-4, 0x1.17ca2877f0601p-4,   -0x1.8574c40bc5fb6p-6,  0x1.4b884e45b16c0p-9,
    0x1.ef1bdd3c1af2fp-10, -0x1.98db5154eb881p-11, -0x1.b9126bd5532f6p-14, 0x1.065a3d6df9e94p-13,
    0x1.4c20f00eeb467p-18, -0x1.513c04b9827efp-16, -0x1.87cb5247af027p-21, 0x1.d212ba96c802dp-19,
    0x1.79eac79dcaa4ep-22, -0x1.4ab686cb31578p-21, -0x1.1df597929e71ep-23, 0x1.ad3bd585db07ap-24,
    0x1.1d2ad2e4713e4p-25, -0x1.7ce674f65a293p-27, -0x1.0e2479a4eb377p-28};

template <std::size_t kTerms>
double Polynomial(const std::array<double, kTerms>& coefficients, double x) {
  double sum = 0.0;
  for (std::size_t i = kTerms; i-- > 0;) sum = coefficients[i] + x * sum;
  return sum;
}

}  // namespace

double Erfc(double x) {
  if (std::isnan(x)) return x;
  const double size = std::abs(x);
  if (size < 0.5) return 1.0 - x * Polynomial(kErf, x * x);
  if (size > 28.0) return x > 0.0 ? 0.0 : 2.0;
  const DoubleDouble square = ExactProduct(size, size);
  const double tail = functions::ExpOf({-square.high, -square.low}) *
                      (Polynomial(kErfc, (size - 3.0) / (size + 3.0)) / (1.0 + 2.0 * size));
  return x > 0.0 ? tail : 2.0 - tail;
}

// Abramowitz & Stegun 1964, 5.1.11: -gamma - ln x - sum of (-x)^n/(n n!); and 5.1.22, the even part
// of the continued fraction, of which 100 terms are good to 1e-16 from 1 on.
double ExponentialIntegral(double x) {
  if (!(x > 0.0)) {
    return x == 0.0 ? std::numeric_limits<double>::infinity()
                    : std::numeric_limits<double>::quiet_NaN();
  }
  if (x <= 1.0) {
    double sum = 0.0;
    double term = 1.0;
    for (int n = 1; n <= 20; ++n) {
      term *= -x / n;
      sum -= term / n;
    }
    return sum - (std::numbers::egamma + Log(x));
  }
  constexpr int kTerms = 100;
  double below = x + 2.0 * kTerms + 1.0;
  for (int n = kTerms; n >= 1; --n) below = x + 2.0 * n - 1.0 - n * (n / below);
  return Exp(-x) / below;
}

}  // namespace rockyard::math

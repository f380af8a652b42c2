// Quantiles of random.h, by operations that round alike on every processor.

#include <array>
#include <cmath>
#include <cstddef>

#include "core/check.h"
#include "core/random.h"
#include "math/functions.h"

namespace rockyard::core {
namespace {

// Wichura 1988, algorithm AS 241 (PPND16), Applied Statistics 37, 477: ratios of polynomials of
// degree 7, lowest power first.
using Coefficients = std::array<double, 8>;
struct Ratio {
  Coefficients above;
  Coefficients below;
};
constexpr Ratio kCentre = {
    {3.3871328727963666080e0, 1.3314166789178437745e+2, 1.9715909503065514427e+3,
     1.3731693765509461125e+4, 4.5921953931549871457e+4, 6.7265770927008700853e+4,
     3.3430575583588128105e+4, 2.5090809287301226727e+3},
    {1.0, 4.2313330701600911252e+1, 6.8718700749205790830e+2, 5.3941960214247511077e+3,
     2.1213794301586595867e+4, 3.9307895800092710610e+4, 2.8729085735721942674e+4,
     5.2264952788528545610e+3}};
constexpr Ratio kTail = {
    {1.42343711074968357734e0, 4.63033784615654529590e0, 5.76949722146069140550e0,
     3.64784832476320460504e0, 1.27045825245236838258e0, 2.41780725177450611770e-1,
     2.27238449892691845833e-2, 7.74545014278341407640e-4},
    {1.0, 2.05319162663775882187e0, 1.67638483018380384940e0, 6.89767334985100004550e-1,
     1.48103976427480074590e-1, 1.51986665636164571966e-2, 5.47593808499534494600e-4,
     1.05075007164441684324e-9}};
constexpr Ratio kFarTail = {
    {6.65790464350110377720e0, 5.46378491116411436990e0, 1.78482653991729133580e0,
     2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
     2.71155556874348757815e-5, 2.01033439929228813265e-7},
    {1.0, 5.99832206555887937690e-1, 1.36929880922735805310e-1, 1.48753612908506148525e-2,
     7.86869131145613259100e-4, 1.84631831751005468180e-5, 1.42151175831644588870e-7,
     2.04426310338993978564e-15}};

// Pairs of terms side by side, which a processor need not wait for one by one.
double Polynomial(const Coefficients& a, double x) {
  const double x2 = x * x;
  const double low = (a[0] + a[1] * x) + x2 * (a[2] + a[3] * x);
  const double high = (a[4] + a[5] * x) + x2 * (a[6] + a[7] * x);
  return low + x2 * x2 * high;
}

double ValueOf(const Ratio& ratio, double x) {
  return Polynomial(ratio.above, x) / Polynomial(ratio.below, x);
}

// Returns the probability that a chi-squared number exceeds x > 0: the sum of the terms
// h^j e^-h / Gamma(j + 1), h = x/2, with j = 0, 1, ... below degrees/2 where the degrees are even,
// and j = 1/2, 3/2, ... after erfc(sqrt(h)) where they are odd (Abramowitz & Stegun 1964, 26.4.4
// and 26.4.5).
double ChiSquaredTail(double x, int degrees) {
  const double half = 0.5 * x;
  const double log_half = math::Log(half);
  const bool odd = degrees % 2 == 1;
  constexpr double kLogOfGamma = -0.1207822376352452223;  // log Gamma(3/2)
  double sum = odd ? math::Erfc(std::sqrt(half)) : 0.0;
  double log_term = odd ? 0.5 * log_half - half - kLogOfGamma : -half;
  for (double j = odd ? 0.5 : 0.0; j < 0.5 * degrees - 0.25; j += 1.0) {
    sum += math::Exp(log_term);
    log_term += log_half - math::Log(j + 1.0);
  }
  return sum;
}

}  // namespace

double NormalQuantile(double p) {
  EXPECT(p > 0.0 && p < 1.0);
  const double central = p - 0.5;
  if (std::abs(central) <= 0.425) {
    return central * ValueOf(kCentre, 0.180625 - central * central);
  }
  const double tail = central < 0.0 ? p : 1.0 - p;
  const double root = std::sqrt(-math::Log(tail));
  const double size = root <= 5.0 ? ValueOf(kTail, root - 1.6) : ValueOf(kFarTail, root - 5.0);
  return central < 0.0 ? -size : size;
}

double ChiSquaredQuantile(double p, int degrees) {
  EXPECT(p >= 0.0 && p < 1.0 && degrees >= 1);
  if (p == 0.0) return 0.0;
  double low = 0.0;
  double high = degrees;
  while (ChiSquaredTail(high, degrees) > 1.0 - p) high *= 2.0;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    (ChiSquaredTail(middle, degrees) > 1.0 - p ? low : high) = middle;
  }
}

}  // namespace rockyard::core

#include "core/distributions.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

#include "core/check.h"

namespace rockyard::core {
namespace {

// exp(-200) is far above the smallest double, so sequential inversion stays exact below this mean.
constexpr double kLargestInvertedMean = 200.0;

// Boost evaluates functions of double in long double by default: three times slower, and other bits
// where long double is another type.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

std::int64_t InvertPoisson(RandomStream& stream, double mean) {
  const double u = stream.Uniform();
  double probability = std::exp(-mean);
  double cumulative = probability;
  std::int64_t count = 0;
  // The bound ends the loop where rounding keeps the sum below u: 1000 is 50 sigma above 200.
  while (u > cumulative && count < 1000) {
    ++count;
    probability *= mean / static_cast<double>(count);
    cumulative += probability;
  }
  return count;
}

}  // namespace

double ChiSquaredQuantile(double p, int degrees) {
  EXPECT(p >= 0.0 && p < 1.0 && degrees >= 1);
  return boost::math::quantile(boost::math::chi_squared(degrees), p);
}

double SampleUniform(RandomStream& stream, double low, double high) {
  EXPECT(low <= high);
  return low + (high - low) * stream.Uniform();
}

double NormalQuantile(double p) {
  EXPECT(p > 0.0 && p < 1.0);
  const double central = 2.0 * p - 1.0;
  // Below some 1e-17 the difference to -1 is lost. Elsewhere the other form has other last digits.
  if (central <= -1.0) return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * p, InDouble());
  return std::numbers::sqrt2 * boost::math::erf_inv(central, InDouble());
}

double SampleNormal(RandomStream& stream, double mean, double standard_deviation) {
  EXPECT(standard_deviation >= 0.0);
  return mean + standard_deviation * NormalQuantile(stream.Uniform());
}

double SampleExponential(RandomStream& stream, double mean) {
  EXPECT(mean > 0.0);
  return -mean * std::log(stream.Uniform());
}

bool SampleBernoulli(RandomStream& stream, double probability) {
  EXPECT(probability >= 0.0 && probability <= 1.0);
  return stream.Uniform() < probability;
}

std::int64_t SamplePoisson(RandomStream& stream, double mean) {
  EXPECT(mean >= 0.0 && std::isfinite(mean));
  std::int64_t count = 0;
  double rest = mean;
  for (; rest > kLargestInvertedMean; rest -= kLargestInvertedMean) {
    count += InvertPoisson(stream, kLargestInvertedMean);
  }
  return count + (rest > 0.0 ? InvertPoisson(stream, rest) : 0);
}

}  // namespace rockyard::core

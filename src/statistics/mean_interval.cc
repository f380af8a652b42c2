#include "statistics/mean_interval.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/check.h"
#include "core/numbers.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

using core::kNaN;

// Both chosen by coverage.py on the trials of the nominal scenario.
constexpr double kSkewnessOfLaw = 2.0;  // over that of the sample
constexpr double kFurthest = 1.75;      // end by Hall over end by Student

// Third central moment over the third power of the standard deviation, both with divisor n - 1 and
// n - 2 (Fisher's G1).
double Skewness(std::span<const double> values, const Moments& moments) {
  const double n = static_cast<double>(values.size());
  if (n < 3.0) return 0.0;
  double cubes = 0.0;
  for (const double value : values) {
    const double z = (value - moments.mean()) / moments.standard_deviation();
    cubes += z * z * z;
  }
  return n / ((n - 1.0) * (n - 2.0)) * cubes;
}

// Hall 1992: g(T) = T + r T^2 / 3 + r^2 T^3 / 27 + r / 6 is nearly symmetric about 0, T Student's
// statistic and r the skewness over the root of n. The T at which it is y:
//   T = 3 / r ((1 + r (y - r / 6))^(1/3) - 1).
double HallInverse(double y, double r) {
  constexpr double kNoSkewness = 1e-7;  // the formula loses all digits
  if (std::abs(r) < kNoSkewness) return y;
  return 3.0 / r * (std::cbrt(1.0 + r * (y - r / 6.0)) - 1.0);
}

// The commonest of ascending values and how many differ from it.
void CountApart(std::span<const double> sorted, double confidence, MeanEstimate& estimate) {
  std::size_t most = 0;
  estimate.usual = kNaN;
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t next = i + 1;
    while (next < sorted.size() && sorted[next] == sorted[i]) ++next;
    if (next - i > most) {
      most = next - i;
      estimate.usual = sorted[i];
    }
    i = next;
  }
  estimate.apart = MakeProportion(static_cast<std::int64_t>(sorted.size() - most),
                                  static_cast<std::int64_t>(sorted.size()), confidence,
                                  IntervalMethod::kClopperPearson);
}

MeanLack LackOf(const MeanEstimate& estimate, std::int64_t fewest) {
  if (estimate.apart.trials > 0 && estimate.apart.count == 0) return MeanLack::kNothingApart;
  if (fewest == kNeverForMean) return MeanLack::kNoBound;
  if (estimate.apart.trials < fewest) return MeanLack::kTooFewValues;
  return estimate.apart.count < kFewestApart ? MeanLack::kTooFewApart : MeanLack::kNone;
}

}  // namespace

Interval SkewedMeanInterval(std::span<const double> values, double confidence) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  const Moments moments = MomentsOf(values);
  if (!(moments.standard_deviation() > 0.0)) return {kNaN, kNaN};
  const double n = static_cast<double>(values.size());
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 0.5 + 0.5 * confidence);
  const double r = kSkewnessOfLaw * Skewness(values, moments) / std::sqrt(n);
  const double error = moments.standard_deviation() / std::sqrt(n);
  // T at or below HallInverse(t) is the mean at or above m - error HallInverse(t).
  const double below = std::clamp(HallInverse(t, r), t, kFurthest * t);
  const double above = std::clamp(-HallInverse(-t, r), t, kFurthest * t);
  return {moments.mean() - error * below, moments.mean() + error * above};
}

MeanEstimate EstimateMean(std::span<const double> sorted, std::int64_t fewest, double confidence) {
  EXPECT(fewest == kNeverForMean || fewest >= 2);
  MeanEstimate estimate;
  estimate.interval = {kNaN, kNaN};
  CountApart(sorted, confidence, estimate);
  estimate.lack = LackOf(estimate, fewest);
  if (estimate.lack == MeanLack::kNone) estimate.interval = SkewedMeanInterval(sorted, confidence);
  if (estimate.lack == MeanLack::kTooFewValues) estimate.needs = fewest;
  if (estimate.lack == MeanLack::kTooFewApart) estimate.needs = kFewestApart;
  return estimate;
}

Interval MeanDifferenceInterval(double first, const Interval& of_first, double second,
                                const Interval& of_second) {
  const double difference = second - first;
  return {difference - std::hypot(second - of_second.low, of_first.high - first),
          difference + std::hypot(of_second.high - second, first - of_first.low)};
}

}  // namespace rockyard::statistics

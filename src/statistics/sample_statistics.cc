#include "statistics/sample_statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "core/check.h"
#include "core/numbers.h"

namespace rockyard::statistics {

namespace {

using core::kNaN;

std::span<const double> ShortestHalf(std::span<const double> sorted) {
  const std::size_t half = (sorted.size() + 1) / 2;
  std::size_t best = 0;
  double best_width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + half <= sorted.size(); ++i) {
    const double width = sorted[i + half - 1] - sorted[i];
    // Of equally short halves the lowest stays.
    if (width < best_width) {
      best_width = width;
      best = i;
    }
  }
  return sorted.subspan(best, half);
}

double InterquartileRange(std::span<const double> sorted) {
  return Quantile(sorted, 0.75) - Quantile(sorted, 0.25);
}

// Position of the top of the parabola through three points one step apart, in steps from the
// middle: (l - r) / (2 (l - 2 m + r)).
double ParabolaTop(double left, double middle, double right) {
  const double curvature = left - 2.0 * middle + right;
  return curvature < 0.0 ? 0.5 * (left - right) / curvature : 0.0;
}

}  // namespace

void Moments::Add(double value) {
  if (!std::isfinite(value)) {
    ++not_finite_;
    return;
  }
  min_ = count_ == 0 ? value : std::min(min_, value);
  max_ = count_ == 0 ? value : std::max(max_, value);
  ++count_;
  // Welford 1962: m' = m + (x - m)/n, S' = S + (x - m)(x - m').
  const double before = value - mean_;
  mean_ += before / static_cast<double>(count_);
  sum_of_squares_ += before * (value - mean_);
}

void Moments::Merge(const Moments& other) {
  not_finite_ += other.not_finite_;
  if (other.count_ == 0) return;
  if (count_ == 0) {
    const std::int64_t not_finite = not_finite_;
    *this = other;
    not_finite_ = not_finite;
    return;
  }
  // Chan, Golub and LeVeque 1983: with the difference d of the means, m' = m + d n_2/(n_1 + n_2)
  // and S' = S_1 + S_2 + d^2 n_1 n_2/(n_1 + n_2).
  const double here = static_cast<double>(count_);
  const double there = static_cast<double>(other.count_);
  const double difference = other.mean_ - mean_;
  mean_ += difference * there / (here + there);
  sum_of_squares_ +=
      other.sum_of_squares_ + difference * difference * here * there / (here + there);
  count_ += other.count_;
  min_ = std::min(min_, other.min_);
  max_ = std::max(max_, other.max_);
}

double Moments::mean() const { return count_ == 0 ? kNaN : mean_; }
double Moments::variance() const {
  return count_ < 2 ? kNaN : sum_of_squares_ / static_cast<double>(count_ - 1);
}
double Moments::standard_deviation() const { return std::sqrt(variance()); }
double Moments::min() const { return count_ == 0 ? kNaN : min_; }
double Moments::max() const { return count_ == 0 ? kNaN : max_; }

Moments MomentsOf(std::span<const double> values) {
  Moments moments;
  for (const double value : values) moments.Add(value);
  return moments;
}

std::vector<double> SortedFinite(std::span<const double> values) {
  std::vector<double> sorted;
  sorted.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
               [](double x) { return std::isfinite(x); });
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

double Quantile(std::span<const double> sorted, double probability) {
  EXPECT(probability >= 0.0 && probability <= 1.0);
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  // Type 7 (Hyndman and Fan 1996): position p (n - 1), counted from 0, linear between order
  // statistics.
  const double position = probability * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double weight = position - static_cast<double>(below);
  return sorted[below] + weight * (sorted[above] - sorted[below]);
}

Interval MedianInterval(std::span<const double> sorted, double confidence) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  using core::kNaN;
  if (sorted.empty()) return {kNaN, kNaN};
  const boost::math::binomial below(static_cast<double>(sorted.size()), 0.5);
  const double tail = 0.5 * (1.0 - confidence);
  // Values that may be left out at each end: the most with P(at most so many below) <= tail.
  // Boost's quantile is that number or next to it.
  auto out = static_cast<std::size_t>(std::max(0.0, boost::math::quantile(below, tail) - 1.0));
  while (boost::math::cdf(below, static_cast<double>(out)) <= tail) ++out;
  // So few values that even the extremes do not cover the median with this confidence.
  if (out == 0) return {kNaN, kNaN};
  return {sorted[out - 1], sorted[sorted.size() - out]};
}

std::vector<EcdfPoint> Ecdf(std::span<const double> values, double confidence, BandMethod method,
                            std::optional<double> independent) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  const std::vector<double> sorted = SortedFinite(values);
  const double n = static_cast<double>(sorted.size());
  // Massart 1990: P(sup |F_n - F| > e) <= 2 e^(-2 n e^2), solved for e.
  const double half =
      std::sqrt(std::log(2.0 / (1.0 - confidence)) / (2.0 * independent.value_or(n)));
  std::vector<EcdfPoint> points;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    // One step for equal values, at the last of them.
    if (i + 1 < sorted.size() && sorted[i + 1] == sorted[i]) continue;
    const double fraction = static_cast<double>(i + 1) / n;
    const Interval band =
        method == BandMethod::kSimultaneous
            ? Interval{std::max(0.0, fraction - half), std::min(1.0, fraction + half)}
            : ProportionInterval(static_cast<std::int64_t>(i + 1),
                                 static_cast<std::int64_t>(sorted.size()), confidence,
                                 IntervalMethod::kClopperPearson);
    points.push_back({sorted[i], fraction, band});
  }
  return points;
}

double HalfSampleMode(std::span<const double> sorted) {
  if (sorted.empty()) return kNaN;
  // Each round keeps ceil(n/2) neighbouring values.
  while (sorted.size() > 3) sorted = ShortestHalf(sorted);
  if (sorted.size() == 1) return sorted[0];
  if (sorted.size() == 2) return 0.5 * (sorted[0] + sorted[1]);
  // Three are left: the middle of the closer two, or the middle one.
  const double low = sorted[1] - sorted[0];
  const double high = sorted[2] - sorted[1];
  if (low == high) return sorted[1];
  return low < high ? 0.5 * (sorted[0] + sorted[1]) : 0.5 * (sorted[1] + sorted[2]);
}

Interval HalfSampleModeRange(std::span<const double> values, double confidence) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  constexpr std::size_t kFewest = 30;
  constexpr std::size_t kMostBlocks = 100;
  constexpr double kLongestBlock = 1000.0;
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double x) { return std::isfinite(x); });
  if (finite.size() < kFewest) return {kNaN, kNaN};
  const double n = static_cast<double>(finite.size());
  const double length = std::min(kLongestBlock, std::ceil(std::cbrt(n * n)));
  const double mode = HalfSampleMode(SortedFinite(finite));
  const std::size_t last = finite.size() - static_cast<std::size_t>(length);
  const std::size_t blocks = std::min(kMostBlocks, last + 1);
  std::vector<double> offsets;
  for (std::size_t b = 0; b < blocks; ++b) {
    // Spread evenly, the first at the start and the last at the end.
    const std::size_t first = blocks == 1 ? 0 : b * last / (blocks - 1);
    const auto block = std::span(finite).subspan(first, static_cast<std::size_t>(length));
    offsets.push_back(HalfSampleMode(SortedFinite(block)) - mode);
  }
  std::sort(offsets.begin(), offsets.end());
  // The law of mode - true mode is that of the offsets times (length / n)^(1/3).
  const double shrink = std::cbrt(length / n);
  const double tail = 0.5 * (1.0 - confidence);
  return {mode - shrink * Quantile(offsets, 1.0 - tail), mode - shrink * Quantile(offsets, tail)};
}

double HistogramMode(std::span<const double> sorted) {
  if (sorted.empty()) return kNaN;
  const double low = sorted.front();
  const double range = sorted.back() - low;
  if (!(range > 0.0)) return low;
  const double n = static_cast<double>(sorted.size());
  // Width of a bin 2 IQR n^(-1/3) (Freedman and Diaconis 1981); without an IQR, log2(n) + 1 bins
  // (Sturges).
  const double freedman_diaconis = 2.0 * InterquartileRange(sorted) / std::cbrt(n);
  constexpr double kMaxBins = 1e5;  // keeps a sample with one far outlier affordable
  const double bins = freedman_diaconis > 0.0
                          ? std::clamp(std::ceil(range / freedman_diaconis), 1.0, kMaxBins)
                          : std::ceil(std::log2(n)) + 1.0;
  std::vector<std::size_t> counts(static_cast<std::size_t>(bins), 0);
  for (const double x : sorted) {
    const auto bin = static_cast<std::size_t>((x - low) / range * bins);
    ++counts[std::min(bin, counts.size() - 1)];
  }
  const auto fullest = std::max_element(counts.begin(), counts.end()) - counts.begin();
  return low + (static_cast<double>(fullest) + 0.5) * range / bins;
}

double KernelMode(std::span<const double> sorted) {
  if (sorted.empty()) return kNaN;
  const double low = sorted.front();
  const double range = sorted.back() - low;
  if (!(range > 0.0)) return low;
  const double deviation = MomentsOf(sorted).standard_deviation();
  // 0.9 min(s, IQR/1.34) n^(-1/5): 1.34 is the IQR of a standard normal law.
  const double robust = InterquartileRange(sorted) / 1.34;
  const double spread = robust > 0.0 ? std::min(deviation, robust) : deviation;
  const double bandwidth = 0.9 * spread * std::pow(static_cast<double>(sorted.size()), -0.2);
  constexpr std::size_t kGrid = 256;
  const double step = range / static_cast<double>(kGrid - 1);
  std::vector<double> density(kGrid, 0.0);
  for (std::size_t i = 0; i < kGrid; ++i) {
    const double at = low + step * static_cast<double>(i);
    for (const double x : sorted) {
      const double z = (at - x) / bandwidth;
      density[i] += std::exp(-0.5 * z * z);
    }
  }
  const auto top =
      static_cast<std::size_t>(std::max_element(density.begin(), density.end()) - density.begin());
  const double shift = top == 0 || top + 1 == kGrid
                           ? 0.0
                           : ParabolaTop(density[top - 1], density[top], density[top + 1]);
  return low + step * (static_cast<double>(top) + shift);
}

namespace {

using core::kNaN;

// kSkewnessOfLaw and kFurthest were chosen by scripts/studies/coverage/coverage.py on the trials of
// the nominal scenario. The fewest values that means ask for (kFewestForMean, metric_table.cc) were
// found with both: a change of either needs the study anew (results/studies/coverage.md).
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

#include "statistics/modes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "core/check.h"
#include "core/numbers.h"
#include "statistics/moments.h"
#include "statistics/quantiles.h"

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

}  // namespace rockyard::statistics

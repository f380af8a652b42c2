#include "statistics/kolmogorov.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/check.h"
#include "core/random.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

// A matrix times 10^exponent: powers of the transition matrix leave the range of double.
struct ScaledMatrix {
  Eigen::MatrixXd matrix;
  int exponent = 0;
};

ScaledMatrix Multiply(const ScaledMatrix& a, const ScaledMatrix& b) {
  ScaledMatrix product{a.matrix * b.matrix, a.exponent + b.exponent};
  const Eigen::Index middle = product.matrix.rows() / 2;
  constexpr int kShift = 140;
  // The middle element stands for the size of all, as in the authors' program.
  if (product.matrix(middle, middle) > 1e140) {
    product.matrix *= std::pow(10.0, -kShift);
    product.exponent += kShift;
  }
  return product;
}

ScaledMatrix Power(ScaledMatrix base, int exponent) {
  ScaledMatrix result{Eigen::MatrixXd::Identity(base.matrix.rows(), base.matrix.cols()), 0};
  // Square and multiply.
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) result = Multiply(result, base);
    base = Multiply(base, base);
  }
  return result;
}

// Transition matrix H of Marsaglia, Tsang and Wang (2003) for n d = k - h: ones on and below the
// first superdiagonal, corrected by powers of h in the first column and the last row, each entry
// over (i - j + 1)!.
Eigen::MatrixXd TransitionMatrix(Eigen::Index size, double h) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j <= std::min(i + 1, size - 1); ++j) H(i, j) = 1.0;
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    H(i, 0) -= std::pow(h, static_cast<double>(i + 1));
    H(size - 1, i) -= std::pow(h, static_cast<double>(size - i));
  }
  if (2.0 * h > 1.0) H(size - 1, 0) += std::pow(2.0 * h - 1.0, static_cast<double>(size));
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j <= std::min(i + 1, size - 1); ++j) {
      for (Eigen::Index g = 1; g <= i - j + 1; ++g) H(i, j) /= static_cast<double>(g);
    }
  }
  return H;
}

// D = max_i max(F(x_i) - (i - 1)/n, i/n - F(x_i)) over the ordered sample: the empirical function
// jumps at each value, so both sides of the jump count.
double OneSampleStatistic(std::span<const double> sorted,
                          const std::function<double(double)>& distribution_function) {
  const double n = static_cast<double>(sorted.size());
  double statistic = 0.0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double f = distribution_function(sorted[i]);
    statistic =
        std::max({statistic, f - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - f});
  }
  return statistic;
}

// D = max |F_a - F_b|. Equal values of both samples are stepped over together.
double TwoSampleStatistic(std::span<const double> a, std::span<const double> b) {
  double statistic = 0.0;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    const double at = std::min(a[i], b[j]);
    while (i < a.size() && a[i] == at) ++i;
    while (j < b.size() && b[j] == at) ++j;
    statistic =
        std::max(statistic, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                     static_cast<double>(j) / static_cast<double>(b.size())));
  }
  return statistic;
}

// P(D >= statistic) for samples of n and m: one minus the probability that a random lattice path
// from (0, 0) to (n, m) stays strictly inside the band |i/n - j/m| < statistic.
double TwoSampleExactPValue(double statistic, std::size_t n, std::size_t m) {
  const double rows = static_cast<double>(n);
  const double columns = static_cast<double>(m);
  // A distance equal to the statistic reaches it, whatever rounding made of the two quotients.
  const double limit = statistic * (1.0 - 1e-12);
  std::vector<double> inside(m + 1, 0.0);
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t j = 0; j <= m; ++j) {
      const double x = static_cast<double>(i);
      const double y = static_cast<double>(j);
      const double left = rows + columns - x - y + 1.0;  // steps still to go before this one
      double probability = i == 0 && j == 0 ? 1.0 : 0.0;
      // All orders of n and m steps are equally likely: the next step goes along i with the chance
      // of the steps along i that are left, over all that are left.
      if (i > 0) probability += inside[j] * (rows - x + 1.0) / left;
      if (j > 0) probability += inside[j - 1] * (columns - y + 1.0) / left;
      inside[j] = std::abs(x / rows - y / columns) < limit ? probability : 0.0;
    }
  }
  return std::clamp(1.0 - inside[m], 0.0, 1.0);
}

}  // namespace

double KolmogorovLimitPValue(double x) {
  if (x <= 0.0) return 1.0;
  constexpr double kPi = std::numbers::pi;
  double sum = 0.0;
  // P(K >= x) = 2 sum (-1)^(k - 1) e^(-2 k^2 x^2)
  //          = 1 - sqrt(2 pi)/x sum e^(-(2 k - 1)^2 pi^2 / (8 x^2)).
  if (x < 1.0) {  // Jacobi's other form converges fast where the first does not
    for (int k = 1; k <= 20; ++k) {
      const double odd = (2.0 * k - 1.0) * kPi / x;
      sum += std::exp(-odd * odd / 8.0);
    }
    return std::clamp(1.0 - std::sqrt(2.0 * kPi) / x * sum, 0.0, 1.0);
  }
  for (int k = 1; k <= 20; ++k) {
    sum += (k % 2 == 1 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * x * x);
  }
  return std::clamp(sum, 0.0, 1.0);
}

double KolmogorovExactPValue(double statistic, int n) {
  EXPECT(n > 0);
  const double nd = static_cast<double>(n) * statistic;
  if (nd <= 0.5) return 1.0;
  if (statistic >= 1.0) return 0.0;
  // P(D_n < d) = n!/n^n (H^n)_kk with k = floor(n d) + 1 and h = k - n d; the power of ten goes
  // apart.
  const int k = static_cast<int>(nd) + 1;
  const Eigen::Index size = 2 * k - 1;
  const ScaledMatrix power = Power({TransitionMatrix(size, k - nd), 0}, n);
  double inside = power.matrix(k - 1, k - 1);
  int exponent = power.exponent;
  for (int i = 1; i <= n; ++i) {
    inside *= static_cast<double>(i) / n;
    if (inside < 1e-140) {
      inside *= 1e140;
      exponent -= 140;
    }
  }
  return std::clamp(1.0 - inside * std::pow(10.0, exponent), 0.0, 1.0);
}

TestResult KolmogorovSmirnov(std::span<const double> sample,
                             const std::function<double(double)>& distribution_function) {
  const std::vector<double> sorted = SortedFinite(sample);
  if (sorted.empty()) return {};
  const double statistic = OneSampleStatistic(sorted, distribution_function);
  const double root = std::sqrt(static_cast<double>(sorted.size()));
  constexpr std::size_t kExactUpTo = 1000;
  // Far in the tail the exact formula is a difference of nearly equal numbers; the limit is not.
  constexpr double kFarTail = 3.0;
  if (sorted.size() <= kExactUpTo && root * statistic < kFarTail) {
    return {statistic, KolmogorovExactPValue(statistic, static_cast<int>(sorted.size()))};
  }
  // Stephens 1970: the limit law at (sqrt(n) + 0.12 + 0.11/sqrt(n)) D.
  return {statistic, KolmogorovLimitPValue((root + 0.12 + 0.11 / root) * statistic)};
}

TestResult KolmogorovSmirnov(std::span<const double> sample_1, std::span<const double> sample_2) {
  const std::vector<double> a = SortedFinite(sample_1);
  const std::vector<double> b = SortedFinite(sample_2);
  if (a.empty() || b.empty()) return {};
  const double statistic = TwoSampleStatistic(a, b);
  constexpr std::size_t kExactPairs = 4'000'000;
  if (a.size() * b.size() <= kExactPairs) {
    return {statistic, TwoSampleExactPValue(statistic, a.size(), b.size())};
  }
  const double n = static_cast<double>(a.size());
  const double m = static_cast<double>(b.size());
  // D of two samples behaves as that of one of n m / (n + m) values.
  return {statistic, KolmogorovLimitPValue(std::sqrt(n * m / (n + m)) * statistic)};
}

double ExponentialStatistic(std::span<const double> sorted, std::size_t skip) {
  constexpr std::size_t kFewest = 3;
  if (sorted.size() < skip + 1 + kFewest) return 0.0;
  const double offset = sorted[skip];
  const std::span<const double> above = sorted.subspan(skip + 1);
  const double n = static_cast<double>(above.size());
  double mean = 0.0;
  for (const double x : above) mean += (x - offset) / n;
  if (!(mean > 0.0)) return 0.0;
  double statistic = 0.0;
  for (std::size_t i = 0; i < above.size(); ++i) {
    // F = 1 - e^(-(x - offset)/mean), and D as in the one-sample test.
    const double f = -std::expm1(-(above[i] - offset) / mean);
    statistic =
        std::max({statistic, f - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - f});
  }
  return statistic;
}

std::vector<double> ExponentialNullLaw(std::size_t excesses, std::size_t replicates,
                                       std::uint64_t seed) {
  std::vector<double> null(replicates);
  std::vector<double> sample(excesses + 1);
  for (std::size_t b = 0; b < replicates; ++b) {
    core::RandomStream stream({.seed = seed, .trial = 0}, core::Purpose::kBootstrap,
                              static_cast<std::uint32_t>(b));
    // The offset is an order statistic: excesses over it are exponential again, so it may be 0 and
    // the mean 1 without loss.
    sample[0] = 0.0;
    for (std::size_t i = 1; i < sample.size(); ++i)
      sample[i] = core::SampleExponential(stream, 1.0);
    std::sort(sample.begin(), sample.end());
    null[b] = ExponentialStatistic(sample);
  }
  std::sort(null.begin(), null.end());
  return null;
}

double BootstrapPValue(std::span<const double> ascending_null, double statistic) {
  const auto first = std::lower_bound(ascending_null.begin(), ascending_null.end(), statistic);
  const auto reached = static_cast<double>(ascending_null.end() - first);
  // The observed statistic counts as one more replicate.
  return (1.0 + reached) / (1.0 + static_cast<double>(ascending_null.size()));
}

TestResult ExponentialTailTest(std::span<const double> sample, std::uint64_t seed, std::size_t skip,
                               std::size_t replicates) {
  const std::vector<double> sorted = SortedFinite(sample);
  if (sorted.size() <= skip + 1) return {};
  const double statistic = ExponentialStatistic(sorted, skip);
  // The null law depends on the number of excesses alone.
  const std::vector<double> null = ExponentialNullLaw(sorted.size() - skip - 1, replicates, seed);
  return {statistic, BootstrapPValue(null, statistic)};
}

}  // namespace rockyard::statistics

#include "statistics/layout_effect.h"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <cmath>
#include <vector>

#include "core/check.h"
#include "core/numbers.h"
#include "core/random.h"

namespace rockyard::statistics {
namespace {

struct Point {
  double x = 0.0;
  double y = 0.0;
};

// Upper (concave) hull of points in ascending x; with sign -1 the lower (convex) hull.
std::vector<Point> Hull(const std::vector<Point>& points, double sign) {
  std::vector<Point> hull;
  for (const Point& p : points) {
    while (hull.size() >= 2) {
      const Point& a = hull[hull.size() - 2];
      const Point& b = hull.back();
      // Cross product of a -> b and a -> p: its sign says to which side the hull bends at b.
      const double turn = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      if (sign * turn < 0.0) break;
      hull.pop_back();
    }
    hull.push_back(p);
  }
  return hull;
}

double Interpolate(const std::vector<Point>& line, double x) {
  // The two neighbours of x on a line of ascending points.
  const auto right = std::lower_bound(line.begin() + 1, line.end() - 1, x,
                                      [](const Point& p, double at) { return p.x < at; });
  const Point& a = *(right - 1);
  const Point& b = *right;
  return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

// The posterior of the rate as equally likely values.
std::vector<double> PosteriorRates(std::int64_t count, std::int64_t pool) {
  constexpr int kRates = 200;
  const boost::math::beta_distribution<double> posterior(static_cast<double>(count) + 0.5,
                                                         static_cast<double>(pool - count) + 0.5);
  std::vector<double> rates(kRates);
  for (int i = 0; i < kRates; ++i) {
    // Middles of equally likely parts of the posterior Beta(K + 1/2, N - K + 1/2).
    rates[static_cast<std::size_t>(i)] = boost::math::quantile(posterior, (i + 0.5) / kRates);
  }
  return rates;
}

struct TailCurves {
  std::vector<Point> lower;  // P(Binomial(trials, q) <= observed) over q
  std::vector<Point> upper;
};

TailCurves Curves(std::int64_t trials, std::int64_t observed) {
  constexpr int kSteps = 400;
  TailCurves curves;
  for (int i = 0; i <= kSteps; ++i) {
    const double q = static_cast<double>(i) / kSteps;
    // f(q) on a grid, from which the hulls are taken.
    const Tails tails = CountTails(BinomialLaw(trials, q), observed);
    curves.lower.push_back({q, tails.lower});
    curves.upper.push_back({q, tails.upper});
  }
  return curves;
}

double MeanOnHull(const std::vector<Point>& curve, double sign, const std::vector<double>& rates) {
  const std::vector<Point> hull = Hull(curve, sign);
  double sum = 0.0;
  // A mixture of f(q) with E q = p lies between the hulls of f at p; p itself is averaged over its
  // posterior.
  for (const double rate : rates) sum += Interpolate(hull, rate);
  return sum / static_cast<double>(rates.size());
}

CountLaw LawOf(std::int64_t trials, const LayoutEffect& effect) {
  constexpr double kAlmostNone = 1e-6;
  const double rho = std::clamp(effect.correlation, kAlmostNone, 1.0 - kAlmostNone);
  const double rate = std::clamp(effect.rate, kAlmostNone, 1.0 - kAlmostNone);
  // Two trials on one layout correlate by rho = 1 / (a + b + 1) under a beta law of the rate with
  // the mean a / (a + b).
  const double strength = (1.0 - rho) / rho;
  return BetaBinomialLaw(trials, rate * strength, (1.0 - rate) * strength);
}

}  // namespace

LayoutEffect EstimateLayoutEffect(std::span<const LayoutCount> layouts) {
  double successes = 0.0;
  double trials = 0.0;
  double squares = 0.0;
  for (const LayoutCount& layout : layouts) {
    successes += static_cast<double>(layout.successes);
    trials += static_cast<double>(layout.trials);
    squares += static_cast<double>(layout.trials) * static_cast<double>(layout.trials);
  }
  const double groups = static_cast<double>(layouts.size());
  using core::kNaN;
  if (trials == 0.0) return {kNaN, kNaN};
  const double rate = successes / trials;
  // No layout has two trials, or there is only one: nothing to tell layouts from chance by.
  if (groups < 2.0 || trials <= groups) return {rate, kNaN};
  // Fleiss 1981: with the mean squares between and within layouts and the mean size n_0 = (N - sum
  // n^2 / N) / (G - 1), rho = (MSB - MSW) / (MSB + (n_0 - 1) MSW).
  double between = 0.0;
  double within = 0.0;
  for (const LayoutCount& layout : layouts) {
    if (layout.trials == 0) continue;
    const double n = static_cast<double>(layout.trials);
    const double p = static_cast<double>(layout.successes) / n;
    between += n * (p - rate) * (p - rate);
    within += n * p * (1.0 - p);
  }
  between /= groups - 1.0;
  within /= trials - groups;
  const double size = (trials - squares / trials) / (groups - 1.0);
  const double total = between + (size - 1.0) * within;
  const double correlation = total > 0.0 ? (between - within) / total : 0.0;
  return {rate, std::clamp(correlation, 0.0, 1.0)};
}

CountLaw OneLayoutLaw(std::int64_t trials, std::span<const LayoutCount> layouts,
                      std::uint64_t seed) {
  EXPECT(std::isfinite(EstimateLayoutEffect(layouts).correlation));
  constexpr std::uint32_t kResamples = 400;
  CountLaw mean(static_cast<std::size_t>(trials) + 1, 0.0);
  std::vector<LayoutCount> resample(layouts.size());
  for (std::uint32_t b = 0; b < kResamples; ++b) {
    core::RandomStream stream({.seed = seed, .trial = 0}, core::Purpose::kBootstrap, b);
    for (LayoutCount& layout : resample) {
      const double u = stream.Uniform() * static_cast<double>(layouts.size());
      // Layouts are resampled, not trials: they are what is independent.
      layout = layouts[static_cast<std::size_t>(u)];
    }
    const CountLaw law = LawOf(trials, EstimateLayoutEffect(resample));
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += law[k] / kResamples;
  }
  return mean;
}

Interval OneLayoutPValueBounds(std::int64_t trials, std::int64_t observed, std::int64_t count,
                               std::int64_t pool) {
  const std::vector<double> rates = PosteriorRates(count, pool);
  const TailCurves curves = Curves(trials, observed);
  const auto two_sided = [&](double sign) {
    return TwoSided({MeanOnHull(curves.lower, sign, rates), MeanOnHull(curves.upper, sign, rates)});
  };
  // Lower hulls give the smallest p-value, upper hulls the largest.
  return {two_sided(-1.0), two_sided(1.0)};
}

}  // namespace rockyard::statistics

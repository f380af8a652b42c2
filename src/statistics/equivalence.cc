#include "statistics/equivalence.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/numbers.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

constexpr double kCorrection = 0.5;  // of a trial, where rates are held against a margin
using core::kInfinity;

double UpperTail(double z) {
  if (std::isinf(z)) return z > 0.0 ? 0.0 : 1.0;
  return boost::math::cdf(boost::math::complement(boost::math::normal(), z));
}

// Returns P(T >= t); without scatter, the chance of values that agree so well by accident.
double StudentUpperTail(double distance, const MeanDifference& means) {
  if (means.standard_error == 0.0) return distance > 0.0 ? 0.5 * means.accident : 1.0;
  const boost::math::students_t law(means.degrees_of_freedom);
  return boost::math::cdf(boost::math::complement(law, distance / means.standard_error));
}

// (distance from the value in question) / (standard error under it).
double Score(double distance, double variance) {
  if (variance > 0.0) return distance / std::sqrt(variance);
  if (distance == 0.0) return 0.0;
  return distance > 0.0 ? kInfinity : -kInfinity;
}

// A distance less a continuity correction, if it is as long.
double Shortened(double distance, double correction) {
  return std::copysign(std::max(0.0, std::abs(distance) - correction), distance);
}

// Tango 1998, equations 5 and 6: the variance at the likeliest rates whose difference is `delta`.
// With b pairs up, c down, the likeliest rate of c is the larger root of 2 n q^2 + B q + C = 0,
//   B = -b - c + (2 n - b + c) delta,  C = -c delta (1 - delta),
// and z = (b - c - n delta) / sqrt(n (2 q + delta (1 - delta))). `correction`: of pairs.
double PairedScore(const PairedCounts& counts, double delta, double correction = 0.0) {
  const auto n = static_cast<double>(counts.pairs());
  const auto up = static_cast<double>(counts.only_second);
  const auto down = static_cast<double>(counts.only_first);
  const double b = -up - down + (2.0 * n - up + down) * delta;
  const double c = -down * delta * (1.0 - delta);
  const double root = std::sqrt(std::max(0.0, b * b - 8.0 * n * c));
  const double likeliest_down = (root - b) / (4.0 * n);
  const double variance = n * (2.0 * likeliest_down + delta * (1.0 - delta));
  return Score(Shortened(up - down - n * delta, correction), variance);
}

// Farrington and Manning 1990, appendix: the likeliest rates q_1, q_2 = q_1 - delta solve the cubic
// equation a q^3 + b q^2 + c q + d = 0, here by its trigonometric root q_1 = 2 u cos(w) - b/3a, and
// z = (p_1 - p_2 - delta) / sqrt(q_1 (1 - q_1)/n_1 + q_2 (1 - q_2)/n_2). Index 1 is the second
// group of the table. `correction`: of trials of each group.
double UnpairedScore(const ContingencyTable& table, double delta, double correction = 0.0) {
  const auto n_1 = static_cast<double>(table.success_2 + table.failure_2);
  const auto n_2 = static_cast<double>(table.success_1 + table.failure_1);
  const double p_1 = static_cast<double>(table.success_2) / n_1;
  const double p_2 = static_cast<double>(table.success_1) / n_2;
  const double theta = n_2 / n_1;
  const double a = 1.0 + theta;
  const double b = -(1.0 + theta + p_1 + theta * p_2 + delta * (theta + 2.0));
  const double c = delta * delta + delta * (2.0 * p_1 + theta + 1.0) + p_1 + theta * p_2;
  const double d = -p_1 * delta * (1.0 + delta);
  const double third = b / (3.0 * a);
  const double v = third * third * third - b * c / (6.0 * a * a) + d / (2.0 * a);
  const double u = std::copysign(std::sqrt(std::max(0.0, third * third - c / (3.0 * a))), v);
  const double cosine = u == 0.0 ? 0.0 : std::clamp(v / (u * u * u), -1.0, 1.0);
  const double w = (std::numbers::pi + std::acos(cosine)) / 3.0;
  const double low = std::max(0.0, delta);
  const double high = std::min(1.0, 1.0 + delta);
  const double q_1 = std::clamp(2.0 * u * std::cos(w) - third, low, high);
  const double q_2 = std::clamp(q_1 - delta, 0.0, 1.0);
  return Score(Shortened(p_1 - p_2 - delta, 0.5 * correction * (1.0 / n_1 + 1.0 / n_2)),
               q_1 * (1.0 - q_1) / n_1 + q_2 * (1.0 - q_2) / n_2);
}

// The differences that the score does not reject; it falls as they grow.
template <typename ScoreOf>
Interval ScoreInterval(const ScoreOf& score, double observed, double confidence) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  const double z = boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * confidence);
  const boost::math::tools::eps_tolerance<double> precise(40);
  const auto solve = [&](double target, double low, double high) {
    const auto excess = [&](double delta) { return score(delta) - target; };
    const auto bracket = boost::math::tools::bisect(excess, low, high, precise);
    return 0.5 * (bracket.first + bracket.second);
  };
  constexpr double kEdge = 1.0 - 1e-12;
  Interval interval{-1.0, 1.0};
  // Bisection for the differences at which the score is +z and -z.
  if (observed > -kEdge && score(-kEdge) > z) interval.low = solve(z, -kEdge, observed);
  if (observed < kEdge && score(kEdge) < -z) interval.high = solve(-z, observed, kEdge);
  return interval;
}

double ObservedDifference(const PairedCounts& counts) {
  return static_cast<double>(counts.only_second - counts.only_first) /
         static_cast<double>(counts.pairs());
}

bool HasEmptyGroup(const ContingencyTable& table) {
  return table.success_1 + table.failure_1 == 0 || table.success_2 + table.failure_2 == 0;
}

double ObservedDifference(const ContingencyTable& table) {
  const auto rate = [](std::int64_t success, std::int64_t failure) {
    return static_cast<double>(success) / static_cast<double>(success + failure);
  };
  return rate(table.success_2, table.failure_2) - rate(table.success_1, table.failure_1);
}

}  // namespace

MeanDifference PairedMeans(std::span<const double> differences) {
  const Moments moments = MomentsOf(differences);
  EXPECT(moments.not_finite() == 0);
  const auto n = static_cast<double>(moments.count());
  if (moments.count() < 2) return {moments.mean(), 0.0, 0.0};
  // Without scatter: n equal signs come by accident with 2^(1 - n).
  return {moments.mean(), std::sqrt(moments.variance() / n), n - 1.0, std::exp2(1.0 - n)};
}

MeanDifference WelchMeans(std::span<const double> first, std::span<const double> second) {
  const Moments a = MomentsOf(first);
  const Moments b = MomentsOf(second);
  EXPECT(a.not_finite() == 0 && b.not_finite() == 0);
  const double difference = b.mean() - a.mean();
  if (a.count() < 2 || b.count() < 2) return {difference, 0.0, 0.0};
  const double n_a = static_cast<double>(a.count());
  const double n_b = static_cast<double>(b.count());
  const double square_a = a.variance() / n_a;
  const double square_b = b.variance() / n_b;
  const double square = square_a + square_b;
  // Both groups are constant: Student's law does not apply.
  if (square == 0.0) {
    // Nothing scatters: two groups apart by accident have the chance 2 / C(n_a + n_b, n_a).
    const double ways =
        std::lgamma(n_a + n_b + 1.0) - std::lgamma(n_a + 1.0) - std::lgamma(n_b + 1.0);
    return {difference, 0.0, n_a + n_b - 2.0, std::min(1.0, 2.0 * std::exp(-ways))};
  }
  // Welch and Satterthwaite: (s_a + s_b)^2 / (s_a^2/(n_a - 1) + s_b^2/(n_b - 1)), s = variance / n.
  const double freedom =
      square * square / (square_a * square_a / (n_a - 1.0) + square_b * square_b / (n_b - 1.0));
  return {difference, std::sqrt(square), freedom};
}

Interval DifferenceInterval(const MeanDifference& means, double confidence) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  if (!means.known()) return {-kInfinity, kInfinity};
  const boost::math::students_t law(means.degrees_of_freedom);
  const double half = boost::math::quantile(law, 0.5 + 0.5 * confidence) * means.standard_error;
  return {means.difference - half, means.difference + half};
}

double ChangePValue(const MeanDifference& means) {
  if (!means.known()) return 1.0;
  return std::min(1.0, 2.0 * StudentUpperTail(std::abs(means.difference), means));
}

double EquivalencePValue(const MeanDifference& means, double margin) {
  EXPECT(margin > 0.0);
  if (!means.known()) return 1.0;
  // TOST: the larger p of "difference <= -margin" and "difference >= margin".
  return std::max(StudentUpperTail(means.difference + margin, means),
                  StudentUpperTail(margin - means.difference, means));
}

double SparseEquivalencePValue(std::int64_t pairs, std::int64_t differing, double margin,
                               double range) {
  EXPECT(margin > 0.0 && range >= 0.0 && differing >= 0 && differing <= pairs);
  if (pairs == 0 || differing == pairs) return 1.0;
  constexpr double kShareThatShows = 0.05;
  // The share of pairs that must differ, each by `range` at most, to move the mean by the margin.
  const double share = range > 0.0 ? margin / range : kShareThatShows;
  if (share >= 1.0) return 0.0;
  const boost::math::binomial law(static_cast<double>(pairs), share);
  return boost::math::cdf(law, static_cast<double>(differing));
}

Interval DifferenceInterval(const PairedCounts& counts, double confidence) {
  if (counts.pairs() == 0) return {-1.0, 1.0};
  return ScoreInterval([&](double delta) { return PairedScore(counts, delta); },
                       ObservedDifference(counts), confidence);
}

double EquivalencePValue(const PairedCounts& counts, double margin) {
  EXPECT(margin > 0.0);
  if (counts.pairs() == 0 || margin >= 1.0) return counts.pairs() == 0 ? 1.0 : 0.0;
  return std::max(UpperTail(PairedScore(counts, -margin, kCorrection)),
                  UpperTail(-PairedScore(counts, margin, kCorrection)));
}

Interval DifferenceInterval(const ContingencyTable& table, double confidence) {
  if (HasEmptyGroup(table)) return {-1.0, 1.0};
  return ScoreInterval([&](double delta) { return UnpairedScore(table, delta); },
                       ObservedDifference(table), confidence);
}

double EquivalencePValue(const ContingencyTable& table, double margin) {
  EXPECT(margin > 0.0);
  if (HasEmptyGroup(table) || margin >= 1.0) return HasEmptyGroup(table) ? 1.0 : 0.0;
  return std::max(UpperTail(UnpairedScore(table, -margin, kCorrection)),
                  UpperTail(-UnpairedScore(table, margin, kCorrection)));
}

}  // namespace rockyard::statistics

#include "statistics/straight_drift.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/check.h"

namespace rockyard::statistics {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

double Square(double value) { return value * value; }

}  // namespace

DriftMoments ExactMoments(const StraightDrift& drift) {
  const double s = drift.step_m;
  EXPECT(s > 0.0);
  const std::int64_t steps = std::llround(drift.distance_m / s);
  EXPECT(steps >= 1);
  const double length_variance = drift.distance_variance_m2_per_m * s;
  const double turn_variance = drift.heading_variance_deg2_per_m * s * Square(kRadPerDeg);
  // x = (1 + c) sum s cos(h_i) + sum n_i cos(h_i), y the same with sines; h_i is a sum of i normal
  // turns, of variance V_i = i q. For i <= j: cos cos and sin sin are (cos(h_j - h_i) +- cos(h_j +
  // h_i)) / 2, whose arguments have the variances V_j - V_i and V_j + 3 V_i; E[cos] of a normal
  // angle of variance V is exp(-V/2). Both sums over i < j go on from one j to the next.
  const double pair = s * s * (1.0 + Square(drift.scale_deviation));
  const double decay = std::exp(-0.5 * turn_variance);
  double mean_x = 0.0;
  double square_x = 0.0;
  double square_y = 0.0;
  double differences = 0.0;  // sum of exp(-(V_j - V_i) / 2)
  double triples = 0.0;      // sum of exp(-3 V_i / 2)
  for (std::int64_t j = 0; j < steps; ++j) {
    const double v_j = static_cast<double>(j) * turn_variance;
    const double cosine = std::exp(-0.5 * v_j);
    const double twice = std::exp(-2.0 * v_j);  // E[cos(2 h_j)]
    const double sums = cosine * triples;       // sum of exp(-(V_j + 3 V_i) / 2)
    mean_x += s * cosine;
    // Pairs of different steps count twice, and so cancel the half.
    square_x += pair * (differences + sums) + 0.5 * (pair + length_variance) * (1.0 + twice);
    square_y += pair * (differences - sums) + 0.5 * (pair + length_variance) * (1.0 - twice);
    differences = decay * (differences + 1.0);
    triples += std::exp(-1.5 * v_j);
  }
  const double end_m = static_cast<double>(steps) * s;
  return {.along_bias_m = mean_x - end_m,
          .along_m = std::sqrt(square_x - Square(mean_x)),
          .across_m = std::sqrt(square_y),
          .heading_deg = std::sqrt(drift.heading_variance_deg2_per_m * end_m)};
}

DriftMoments SecondOrderMoments(const StraightDrift& drift) {
  const double length_m = drift.distance_m;
  const double q = drift.heading_variance_deg2_per_m * Square(kRadPerDeg);
  // With a Wiener process h of variance q a metre:
  //   heading     h(L)                    variance q L          (the walk itself)
  //   across      integral of h           variance q L^3 / 3    (integrated once more)
  //   along       -1/2 integral of h^2    mean -q L^2 / 4, variance q^2 L^4 / 12
  // the last because h_s^2 and h_t^2 have the covariance 2 q^2 min(s, t)^2, whose integral over the
  // square is q^2 L^4 / 3. What the steps' own lengths add lies along to this order.
  const double lengths =
      drift.distance_variance_m2_per_m * length_m + Square(drift.scale_deviation * length_m);
  return {.along_bias_m = -0.25 * q * Square(length_m),
          .along_m = std::sqrt(lengths + Square(q) * std::pow(length_m, 4) / 12.0),
          .across_m = std::sqrt(q * std::pow(length_m, 3) / 3.0),
          .heading_deg = std::sqrt(drift.heading_variance_deg2_per_m * length_m)};
}

}  // namespace rockyard::statistics

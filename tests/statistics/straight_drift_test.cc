#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "statistics/closed_forms.h"

namespace rockyard::statistics {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

double Deg2(double rad2) { return rad2 / (kRadPerDeg * kRadPerDeg); }

// One step, two steps: by hand. The first step lies along, whatever follows.
TEST(ExactMomentsTest, OneAndTwoStepsByHand) {
  const StraightDrift one{0.5, 0.5, 0.02, Deg2(0.4), 0.1};
  EXPECT_NEAR(ExactMoments(one).along_bias_m, 0.0, 1e-15);
  // (1 + c) s + n: c^2 s^2 + r s.
  EXPECT_NEAR(ExactMoments(one).along_m, std::sqrt(0.01 * 0.25 + 0.02 * 0.5), 1e-12);
  EXPECT_NEAR(ExactMoments(one).across_m, 0.0, 1e-12);
  EXPECT_NEAR(ExactMoments(one).heading_deg, std::sqrt(Deg2(0.4) * 0.5), 1e-12);

  const StraightDrift two{0.5, 1.0, 0.02, Deg2(0.4), 0.0};
  const double turn = 0.4 * 0.5;  // rad2
  const double cosine = std::exp(-0.5 * turn);
  const double sine2 = 0.5 * (1.0 - std::exp(-2.0 * turn));
  EXPECT_NEAR(ExactMoments(two).along_bias_m, 0.5 * (cosine - 1.0), 1e-12);
  EXPECT_NEAR(ExactMoments(two).across_m, std::sqrt((0.25 + 0.01) * sine2), 1e-12);
  // Two lengths of variance 0.01, of which the second lies along by cos^2, and Var(cos) s^2.
  const double along2 = 0.01 + 0.01 * (1.0 - sine2) + 0.25 * (1.0 - sine2 - cosine * cosine);
  EXPECT_NEAR(ExactMoments(two).along_m, std::sqrt(along2), 1e-12);
}

// Without turns nothing goes across, and lengths add up.
TEST(ExactMomentsTest, WithoutTurnsVariancesAddUp) {
  const DriftMoments moments = ExactMoments({0.067, 6.7, 0.0039, 0.0, 0.02});
  EXPECT_NEAR(moments.along_m, std::sqrt(0.0039 * 6.7 + 0.02 * 0.02 * 6.7 * 6.7), 1e-9);
  EXPECT_NEAR(moments.across_m, 0.0, 1e-9);
  EXPECT_NEAR(moments.along_bias_m, 0.0, 1e-12);
}

// A walk of short steps is the worm-like chain of Kratky and Porod (1949), of persistence length
// P = 2 / q: <r^2> = 2 P L (1 - P / L (1 - exp(-L / P))), <x> = P (1 - exp(-L / P)). Here it turns
// round several times.
TEST(ExactMomentsTest, ShortStepsAreAWormLikeChain) {
  const double q = 0.8;  // rad2/m
  const double p_m = 2.0 / q;
  for (const double length_m : {0.5, 2.0, 10.0, 40.0}) {
    const DriftMoments moments = ExactMoments({1e-4, length_m, 0.0, Deg2(q), 0.0});
    const double mean_m = p_m * (1.0 - std::exp(-length_m / p_m));
    EXPECT_NEAR(moments.along_bias_m + length_m, mean_m, 2e-4 * mean_m);
    const double square_m2 = moments.along_m * moments.along_m +
                             std::pow(moments.along_bias_m + length_m, 2) +
                             moments.across_m * moments.across_m;
    EXPECT_NEAR(square_m2, 2.0 * p_m * length_m * (1.0 - mean_m / length_m), 3e-4 * square_m2)
        << length_m;
  }
  // The same in every direction after many persistence lengths.
  const DriftMoments round = ExactMoments({1e-2, 2000.0 * p_m, 0.0, Deg2(q), 0.0});
  EXPECT_NEAR(round.along_m / round.across_m, 1.0, 1e-2);
}

// Figure 6 as section 5 prints it, of simulated runs and to a centimetre. Two of them are nearer to
// the continuous walk than to 149 steps, 9.983 m: 26.7 against 26.4 cm, and 19.7 cm along.
TEST(StraightDriftTest, Figure6) {
  const auto exact = [](double distance_m, double heading_deg2_per_m) {
    return ExactMoments({0.067, distance_m, 0.0039, heading_deg2_per_m, 0.0});
  };
  EXPECT_NEAR(exact(10.0, 0.70).across_m, 0.264, 0.0005);
  EXPECT_NEAR(exact(10.0, 0.70).along_m, 0.197, 0.0005);
  EXPECT_NEAR(exact(20.0, 0.70).across_m, 0.76, 0.01);
  EXPECT_NEAR(exact(20.0, 0.70).along_m, 0.29, 0.01);
  EXPECT_NEAR(exact(10.0, 16.0).across_m, 1.25, 0.01);
  EXPECT_NEAR(exact(10.0, 16.0).along_m, 0.24, 0.01);
  EXPECT_NEAR(exact(5.0, 16.0).across_m, 0.45, 0.01);
  EXPECT_NEAR(exact(5.0, 16.0).along_m, 0.15, 0.01);
}

}  // namespace
}  // namespace rockyard::statistics

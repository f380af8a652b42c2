// results/reference/matthies1995_dead_reckoning.json: what its computed rows are computed from, and
// that its rows of runs ask for cells that the scenarios have.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "report/comparison_reference.h"
#include "statistics/closed_forms.h"

namespace rockyard::statistics {
namespace {

const PublishedReference& Reference() {
  static const PublishedReference reference = report::LoadReference(
      ROCKYARD_SOURCE_DIR "/results/reference/matthies1995_dead_reckoning.json");
  return reference;
}

const PublishedValue& RowOf(const std::string& id) {
  const auto& values = Reference().values;
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const PublishedValue& value) { return value.id == id; });
  EXPECT_NE(found, values.end()) << id;
  return *found;
}

double NormalTail(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

constexpr double kSlope_m2_per_m = 0.0039;
constexpr double kLength_m = 7.0;
// Footnote 4, rounded towards the mode.
constexpr double kLeast = -0.035;
constexpr double kMode = 0.002;
constexpr double kMost = 0.095;

// A variance of 0.0039 m2/m over 7 m; one that grows with the square and has that slope when a line
// through the origin is fitted to it at many distances.
double LinearDeviation() { return std::sqrt(kSlope_m2_per_m * kLength_m) / kLength_m; }

double ScaleDeviation() {
  double moment = 0.0, weight = 0.0;
  for (int i = 1; i <= 100000; ++i) {
    const double x_m = kLength_m * (i - 0.5) / 100000.0;
    moment += x_m * x_m * x_m;
    weight += x_m * x_m;
  }
  return std::sqrt(kSlope_m2_per_m / (moment / weight));
}

TEST(SandReference, Footnote4IsComputedFromTheTwoLaws) {
  EXPECT_NEAR(LinearDeviation(), 0.0236, 5e-5);
  EXPECT_NEAR(ScaleDeviation(), 0.0273, 5e-5);
  EXPECT_NEAR(RowOf("sand.footnote4.largest").inputs[0],
              NormalTail((kMost - kMode) / LinearDeviation()), 1e-7);
  EXPECT_NEAR(RowOf("sand.footnote4.largest_scale").inputs[0],
              NormalTail((kMost - kMode) / ScaleDeviation()), 1e-6);
  EXPECT_NEAR(RowOf("sand.footnote4.smallest").inputs[0],
              NormalTail((kMode - kLeast) / LinearDeviation()), 1e-4);
  // As the list of misprints says: once in so many sets of twenty.
  const auto sets = [](double chance) { return 1.0 / AnyOf(chance, 20.0); };
  EXPECT_NEAR(sets(NormalTail((kMost - kMode) / LinearDeviation())), 1200.0, 50.0);
  EXPECT_NEAR(sets(NormalTail((kMost - kMode) / ScaleDeviation())), 160.0, 8.0);
  // Student's t of three degrees of freedom has the variance 3.
  const double t = (kMost - kMode) / LinearDeviation() * std::sqrt(3.0);
  EXPECT_NEAR(sets(boost::math::cdf(boost::math::complement(boost::math::students_t(3.0), t))),
              16.0, 0.5);
}

TEST(SandReference, TwoRunsMakeNearlyAllOfTheVariance) {
  std::vector<double> errors(20, kMode);
  errors.front() = kLeast;
  errors.back() = kMost;
  double mean = 0.0, squares = 0.0;
  for (const double error : errors) mean += error / 20.0;
  for (const double error : errors) squares += (error - mean) * (error - mean);
  const double variance_m2 = squares / 19.0 * kLength_m * kLength_m;
  EXPECT_NEAR(RowOf("sand.footnote4.extremes").inputs[0], variance_m2, 1e-5);
  EXPECT_EQ(RowOf("sand.footnote4.extremes").inputs[1], kLength_m);
  EXPECT_NEAR(variance_m2 / (kSlope_m2_per_m * kLength_m), 0.93, 0.005);
  // What is left for the other eighteen.
  const double rest_m2 = (kSlope_m2_per_m * kLength_m - variance_m2) * 19.0 / 18.0;
  EXPECT_NEAR(std::sqrt(rest_m2) / kLength_m, 0.0064, 0.0001);
}

// The published numbers of figure 6 are the closed forms to a centimetre, and so are the
// tolerances.
TEST(SandReference, Figure6LiesByTheExactMoments) {
  int rows = 0;
  for (const PublishedValue& value : Reference().values) {
    if (value.id.find("sand.fig6") != 0) continue;
    ++rows;
    const double distance_m = value.where.at(0).low + 0.001;
    const double heading_deg2_per_m = value.where.at(1).low + 0.001;
    const DriftMoments exact =
        ExactMoments({0.067, distance_m, kSlope_m2_per_m, heading_deg2_per_m, 0.0});
    const bool across = value.column == "across_deviation_m";
    const double exact_m = across ? exact.across_m : exact.along_m;
    EXPECT_NEAR(exact_m, value.value, 0.01) << value.id;
    EXPECT_EQ(std::ceil(100.0 * exact_m), std::round(100.0 * value.value)) << value.id;
    EXPECT_NEAR(value.low, value.value - 0.01, 1e-12);
    EXPECT_NEAR(value.high, value.value + 0.01, 1e-12);
  }
  EXPECT_EQ(rows, 8);
}

// 16 deg2/m in steps of 10 s, and scans of 20 s at rest: three times as much.
TEST(SandReference, NoiseAtRest) {
  const PublishedValue& row = RowOf("sand.mfex.at_rest_computed");
  EXPECT_NEAR(Evaluate(row.formula, row.inputs), 0.70 * 15.0 / 0.67 * (10.0 + 20.0) / 10.0, 1e-9);
  EXPECT_NEAR(0.067 / 0.0067, 10.0, 1e-12);
  EXPECT_EQ(RowOf("sand.mfex.at_rest").value, 3.0 * RowOf("sand.mfex.driving").value);
}

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

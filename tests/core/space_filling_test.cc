// Designs that fill the unit cube.
#include "core/space_filling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace rockyard::core {
namespace {

// Plain random points: what both designs must beat.
UnitPoints RandomPoints(std::size_t points, std::size_t dimensions, std::uint64_t seed) {
  UnitPoints design(points, std::vector<double>(dimensions));
  RandomStream stream({.seed = seed}, Purpose::kTest);
  for (auto& point : design) {
    for (double& x : point) x = stream.Uniform();
  }
  return design;
}

// Whether each of as many equal slices of every axis as there are points holds exactly one.
bool OnePerSlice(const UnitPoints& design) {
  for (std::size_t d = 0; d < design.front().size(); ++d) {
    std::vector<int> counts(design.size());
    for (const auto& point : design) {
      if (point[d] < 0.0 || point[d] >= 1.0) return false;
      ++counts[static_cast<std::size_t>(point[d] * static_cast<double>(design.size()))];
    }
    if (std::any_of(counts.begin(), counts.end(), [](int count) { return count != 1; })) {
      return false;
    }
  }
  return true;
}

// Root mean square distance between the share of points and the volume, over all boxes at the
// origin: the L2 star discrepancy, by Warnock's formula (1972).
double Discrepancy(const UnitPoints& design) {
  const auto n = static_cast<double>(design.size());
  const auto dimensions = static_cast<double>(design.front().size());
  double single = 0.0;
  double pairs = 0.0;
  for (const auto& a : design) {
    double product = 1.0;
    for (const double x : a) product *= 1.0 - x * x;
    single += product;
    for (const auto& b : design) {
      double overlap = 1.0;
      for (std::size_t d = 0; d < a.size(); ++d) overlap *= 1.0 - std::max(a[d], b[d]);
      pairs += overlap;
    }
  }
  return std::sqrt(std::pow(3.0, -dimensions) - std::pow(2.0, 1.0 - dimensions) * single / n +
                   pairs / (n * n));
}

TEST(SpaceFillingTest, ALatinHypercubeHasOnePointPerSlice) {
  for (const std::size_t points : {1u, 2u, 7u, 50u}) {
    EXPECT_TRUE(OnePerSlice(LatinHypercube(points, 6, 3))) << points;
  }
  EXPECT_FALSE(OnePerSlice(RandomPoints(7, 6, 3))) << "the check could not fail";
}

TEST(SpaceFillingTest, SobolPointsOfAPowerOfTwoHaveOnePointPerSlice) {
  for (const std::size_t points : {1u, 2u, 16u, 128u}) {
    EXPECT_TRUE(OnePerSlice(SobolPoints(points, 10, 3))) << points;
  }
  EXPECT_FALSE(OnePerSlice(SobolPoints(24, 10, 3))) << "no power of two";
}

// The mean square over independent random points is (2^-d - 3^-d) / n; that of a net falls nearly
// as 1 / n^2, so that 512 points in three dimensions leave no doubt.
TEST(SpaceFillingTest, SobolPointsHaveLowDiscrepancy) {
  const double random = std::sqrt((std::pow(2.0, -3.0) - std::pow(3.0, -3.0)) / 512.0);
  const auto mean = [](const auto& design) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) sum += Discrepancy(design(512, 3, seed));
    return sum / 10.0;
  };
  EXPECT_LT(mean(SobolPoints), 0.25 * random);
  EXPECT_LT(mean(LatinHypercube), 0.95 * random);
  EXPECT_GT(mean(RandomPoints), 0.7 * random) << "plain random points would pass as well";
}

TEST(SpaceFillingTest, MoreSobolPointsGoOnWithTheSameSequence) {
  const UnitPoints small = SobolPoints(20, 4, 7);
  EXPECT_TRUE(std::equal(small.begin(), small.end(), SobolPoints(64, 4, 7).begin()));
}

// Joe and Kuo's sequence begins with the origin and then halves; the shift moves all points alike.
TEST(SpaceFillingTest, TheShiftIsTheSameForAllPoints) {
  const UnitPoints points = SobolPoints(2, 3, 7);
  for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(std::fabs(points[0][d] - points[1][d]), 0.5);
}

TEST(SpaceFillingTest, SeedsDecideTheDesign) {
  EXPECT_EQ(LatinHypercube(9, 3, 1), LatinHypercube(9, 3, 1));
  EXPECT_NE(LatinHypercube(9, 3, 1), LatinHypercube(9, 3, 2));
  EXPECT_EQ(SobolPoints(9, 3, 1), SobolPoints(9, 3, 1));
  EXPECT_NE(SobolPoints(9, 3, 1), SobolPoints(9, 3, 2));
}

TEST(SpaceFillingTest, AHundredDimensionsCanBeFilled) {
  EXPECT_TRUE(OnePerSlice(SobolPoints(64, kMaxDesignDimensions, 1)));
  EXPECT_TRUE(OnePerSlice(LatinHypercube(64, kMaxDesignDimensions, 1)));
}

}  // namespace
}  // namespace rockyard::core

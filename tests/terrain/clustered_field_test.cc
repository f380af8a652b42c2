// Counts of rocks that lie in clusters against the closed form of Thomas' process. Fixed seeds.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "terrain/field.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

constexpr int kFields = 4000;
constexpr double kSide_m = 2.0;  // of square windows: 12 of them on the 12 x 4 m
constexpr double kClustersPerM2 = 0.5;
constexpr double kRadius_m = 0.4;

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

Moments MomentsOf(const std::vector<double>& counts) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double count : counts) {
    sum += count;
    squares += count * count;
  }
  const auto n = static_cast<double>(counts.size());
  const double mean = sum / n;
  return {mean, (squares / n - mean * mean) * n / (n - 1.0)};
}

// Counts in the whole of many fields, and in one window of each.
struct Counted {
  Moments whole;
  Moments window;
  Moments edge;  // in strips of 1 m at both ends, where clusters without a torus would be missing
};

Counted Count(const TerrainParams& params, std::uint64_t seed) {
  std::vector<double> whole;
  std::vector<double> window;
  std::vector<double> edge;
  for (std::uint32_t i = 0; i < kFields; ++i) {
    const Field field = BuildField(params, {seed, i}, {});
    whole.push_back(field.audit.placed);
    double in_window = 0.0;
    double at_edge = 0.0;
    for (const Rock& rock : field.terrain.rocks()) {
      const double x_m = rock.center_W.x();
      const double y_m = rock.center_W.y();
      in_window += x_m > 0.0 && x_m < kSide_m && y_m > -2.0 && y_m < kSide_m - 2.0 ? 1.0 : 0.0;
      at_edge += x_m < -1.0 || x_m > 9.0 ? 1.0 : 0.0;
    }
    window.push_back(in_window);
    edge.push_back(at_edge);
  }
  return {MomentsOf(whole), MomentsOf(window), MomentsOf(edge)};
}

// The integral over x, y in [0, s] of the normal density of x - y with the standard deviation d:
// s erf(s / (d sqrt 2)) - d sqrt(2 / pi) (1 - exp(-s^2 / (2 d^2))).
double PairsAlongOneAxis(double s, double d) {
  return s * std::erf(s / (d * std::numbers::sqrt2)) -
         d * std::sqrt(2.0 / std::numbers::pi) * (1.0 - std::exp(-s * s / (2.0 * d * d)));
}

class ClusterTest : public testing::TestWithParam<TerrainParams> {
 protected:
  TerrainParams Clustered() const {
    TerrainParams params = GetParam();
    params.rocks.clusters_per_m2 = kClustersPerM2;
    params.rocks.cluster_radius_m = kRadius_m;
    return params;
  }
};

INSTANTIATE_TEST_SUITE_P(BothLaws, ClusterTest,
                         testing::Values(PlainMoore(kNominalK),
                                         PlainGolombek(kVikingLander1Cover)));

// Means within 3.3 deviations, alpha 1e-3 each; variances of 4000 counts within 15 %, about five of
// their own deviations (kurtosis of the counts of clusters included). The whole field is a torus:
// all pairs of a cluster lie in it.
TEST_P(ClusterTest, CountsHaveTheMeanOfTheLawAndTheVarianceOfClusters) {
  const Counted counted = Count(Clustered(), 81);
  const double n = GetParam().rocks.RocksPerM2();
  const double of_pairs = n * n / kClustersPerM2;
  const double whole = 48.0 * (n + of_pairs);
  const double pairs = PairsAlongOneAxis(kSide_m, std::numbers::sqrt2 * kRadius_m);
  const double window = kSide_m * kSide_m * n + of_pairs * pairs * pairs;
  EXPECT_NEAR(counted.whole.mean, 48.0 * n, 3.3 * std::sqrt(whole / kFields));
  EXPECT_NEAR(counted.window.mean, 4.0 * n, 3.3 * std::sqrt(window / kFields));
  EXPECT_NEAR(counted.edge.mean, 8.0 * n, 3.3 * std::sqrt(counted.edge.variance / kFields));
  EXPECT_NEAR(counted.whole.variance / whole, 1.0, 0.15);
  EXPECT_NEAR(counted.window.variance / window, 1.0, 0.15);
  // Negative controls: a Poisson field, and clusters of half the radius.
  const double tight = PairsAlongOneAxis(kSide_m, 0.5 * std::numbers::sqrt2 * kRadius_m);
  EXPECT_GT(counted.window.variance, 1.4 * 4.0 * n);
  EXPECT_GT((kSide_m * kSide_m * n + of_pairs * tight * tight) / window, 1.15);
}

TEST_P(ClusterTest, WithoutClustersCountsArePoisson) {
  const Counted counted = Count(GetParam(), 82);
  EXPECT_NEAR(counted.window.variance / counted.window.mean, 1.0, 0.15);
}

// An exact count has no clusters.
TEST(ClustersTest, LeaveExactCountsAsTheyAre) {
  TerrainParams params = ExactCount(15, ArenaKind::kVirtualReflected);
  const Field plain = BuildField(params, {84, 0}, {});
  params.rocks.clusters_per_m2 = kClustersPerM2;
  const Field clustered = BuildField(params, {84, 0}, {});
  ASSERT_EQ(plain.terrain.rocks().size(), clustered.terrain.rocks().size());
  for (std::size_t i = 0; i < plain.terrain.rocks().size(); ++i) {
    EXPECT_EQ(plain.terrain.rocks()[i].center_W, clustered.terrain.rocks()[i].center_W);
  }
}

// Rocks that keep off each other and off the course find places with clusters, too.
TEST_P(ClusterTest, RelocatedRocksFindAPlace) {
  TerrainParams params = Clustered();
  params.rocks.overlap = OverlapRule::kRelocate;
  params.rocks.clear_radius_m = 0.5;
  double placed = 0.0;
  double expected = 0.0;
  double drawn = 0.0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const FieldAudit audit = BuildField(params, {83, i}, {}).audit;
    EXPECT_EQ(audit.dropped_for_overlap, 0);
    placed += audit.placed;
    expected += audit.expected_placed;
    drawn += audit.expected_drawn;
  }
  EXPECT_NEAR(placed / expected, 1.0, 0.06);
  EXPECT_LT(expected, drawn);
}

}  // namespace
}  // namespace rockyard::terrain

// Sizes, counts and shapes of rocks against their laws. Fixed seeds; every test rejects a wrong
// law.
#include <gtest/gtest.h>

#include "core/statistical_checks.h"
#include "terrain/field.h"
#include "terrain/ground.h"
#include "terrain/rock_size_law.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

std::vector<Rock> RocksOfManyFields(const TerrainParams& params, std::uint64_t seed, int fields) {
  std::vector<Rock> rocks;
  for (int i = 0; i < fields; ++i) {
    const Field field = BuildField(params, {seed, static_cast<std::uint32_t>(i)}, {});
    rocks.insert(rocks.end(), field.terrain.rocks().begin(),
                 field.terrain.rocks().begin() + field.audit.placed);
  }
  return rocks;
}

std::vector<double> Collect(const std::vector<Rock>& rocks,
                            const std::function<double(const Rock&)>& value) {
  std::vector<double> values;
  for (const Rock& rock : rocks) values.push_back(value(rock));
  return values;
}

std::function<double(double)> UniformCdf(double low, double high) {
  return [low, high](double x) { return std::clamp((x - low) / (high - low), 0.0, 1.0); };
}

// Truncated power law N ~ D^-exponent on [0.1, 1] m, for the negative controls.
std::function<double(double)> PowerLawCdf(double exponent) {
  return [exponent](double d) {
    const double low = std::pow(0.1, -exponent);
    return (low - std::pow(d, -exponent)) / (low - 1.0);
  };
}

// A law of Mars from 0.1 to 1 m on 48 m2, and what is known of it without the code under test.
struct LawCase {
  const char* name;
  TerrainParams params;
  std::function<double(double)> cdf;
  double per_m2;
  double cover;            // of the ground, from 0.1 to 1 m
  double published_cover;  // from 0.1 m (Moore) or 0 (Golombek) to infinity: the negative control
};

void PrintTo(const LawCase& law, std::ostream* out) { *out << law.name << " " << law.cover; }

LawCase MooreCase(double k) {
  return {"Moore",
          PlainMoore(k),
          PowerLawCdf(2.66),
          k * (std::pow(0.1, -2.66) - 1.0),
          0.25 * std::numbers::pi * k * 2.66 / 0.66 * (std::pow(0.1, -0.66) - 1.0),
          k == kNominalK ? 0.06 : 0.19};
}

// Its number per m2 from 0.1 m to a diameter, by the sum of n(D) D over thin slices of ln D.
double GolombekSum(double cover, double to_m) {
  constexpr int kSlices = 2000;
  const double q = 1.79 + 0.152 / cover;
  const double step = std::log(to_m / 0.1) / kSlices;
  double sum = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double d = 0.1 * std::exp((i + 0.5) * step);
    sum += 4.0 / std::numbers::pi * cover * q * std::exp(-q * d) / d * step;
  }
  return sum;
}

LawCase GolombekCase(double cover) {
  // Between the nodes of a table the distribution is straight, to 1e-6.
  constexpr int kNodes = 1000;
  const double per_m2 = GolombekSum(cover, 1.0);
  std::vector<double> table;
  for (int i = 0; i <= kNodes; ++i) {
    table.push_back(GolombekSum(cover, std::pow(10.0, -1.0 + 1.0 * i / kNodes)) / per_m2);
  }
  const double q = 1.79 + 0.152 / cover;
  return {"Golombek",
          PlainGolombek(cover),
          [table](double d) {
            const double at = std::clamp((1.0 + std::log10(d)) * kNodes, 0.0, kNodes - 1e-9);
            const auto i = static_cast<std::size_t>(at);
            return std::lerp(table[i], table[i + 1], at - std::floor(at));
          },
          per_m2,
          cover * (std::exp(-0.1 * q) - std::exp(-q)),
          cover};
}

class LawFieldTest : public testing::TestWithParam<LawCase> {};

INSTANTIATE_TEST_SUITE_P(BothLaws, LawFieldTest,
                         testing::Values(MooreCase(kNominalK), MooreCase(kVikingLander2K),
                                         GolombekCase(kVikingLander1Cover),
                                         GolombekCase(kVikingLander2Cover)));

TEST_P(LawFieldTest, DiametersFollowTheLaw) {
  const auto diameters = Collect(RocksOfManyFields(GetParam().params, 61, 100),
                                 [](const Rock& rock) { return rock.diameter_m; });
  ASSERT_GT(diameters.size(), 6000u);
  EXPECT_GT(core::KolmogorovP(diameters, GetParam().cdf), kAlpha);
  EXPECT_LT(core::KolmogorovP(diameters, PowerLawCdf(2.5)), kRejects);
}

TEST_P(LawFieldTest, DiametersFollowTheLawInEveryClass) {
  const std::vector<double> edges = {0.1, 0.12, 0.14, 0.17, 0.2, 0.25, 0.3, 0.4, 0.5, 1.0};
  const auto rocks = RocksOfManyFields(GetParam().params, 62, 100);
  const auto expected = [&](const std::function<double(double)>& cdf) {
    std::vector<double> counts;
    for (std::size_t i = 1; i < edges.size(); ++i) {
      counts.push_back(static_cast<double>(rocks.size()) * (cdf(edges[i]) - cdf(edges[i - 1])));
    }
    return counts;
  };
  std::vector<double> observed(edges.size() - 1, 0.0);
  for (const Rock& rock : rocks) {
    std::size_t i = 0;
    while (i + 2 < edges.size() && rock.diameter_m > edges[i + 1]) ++i;
    observed[i] += 1.0;
  }
  EXPECT_GT(core::ChiSquareP(observed, expected(GetParam().cdf)), kAlpha);
  EXPECT_LT(core::ChiSquareP(observed, expected(PowerLawCdf(2.5))), kRejects);
}

// Two-sided p-values of Poisson counts: of the total, and of the index of dispersion.
struct PoissonP {
  double mean;
  double dispersion;
};

PoissonP TestPoisson(const std::vector<double>& counts, double mean) {
  const auto n = static_cast<double>(counts.size());
  double total = 0.0;
  for (const double count : counts) total += count;
  const double z = (total - n * mean) / std::sqrt(n * mean);
  double squares = 0.0;
  for (const double count : counts) squares += (count - total / n) * (count - total / n);
  const double tail = boost::math::gamma_q(0.5 * (n - 1.0), 0.5 * squares / (total / n));
  return {std::erfc(std::abs(z) / std::numbers::sqrt2), 2.0 * std::min(tail, 1.0 - tail)};
}

std::vector<double> DrawnCounts(const TerrainParams& params, std::uint64_t seed, int fields) {
  std::vector<double> counts;
  for (int i = 0; i < fields; ++i) {
    counts.push_back(BuildField(params, {seed, static_cast<std::uint32_t>(i)}, {}).audit.drawn);
  }
  return counts;
}

TEST_P(LawFieldTest, CountsArePoisson) {
  const PoissonP p = TestPoisson(DrawnCounts(GetParam().params, 63, 600), 48 * GetParam().per_m2);
  EXPECT_GT(p.mean, kAlpha);
  EXPECT_GT(p.dispersion, kAlpha);
}

TEST(CountControlTest, ExactCountsAndAForgottenUpperBoundAreRejected) {
  TerrainParams exact = ExactCount(15, ArenaKind::kVirtualReflected);
  EXPECT_LT(TestPoisson(DrawnCounts(exact, 63, 600), 15.0).dispersion, kRejects);
  // With the cut at 1 m forgotten only 0.2 % more rocks are expected: a count cannot tell. With the
  // law cut at 0.3 m, 5 % fewer are.
  const double wrong_mean =
      (MooreNumberPerM2(kNominalK, 0.1) - MooreNumberPerM2(kNominalK, 0.3)) * 48;
  EXPECT_LT(TestPoisson(DrawnCounts(PlainMoore(kNominalK), 63, 600), wrong_mean).mean, kRejects);
}

// The mean cover over fields, in standard errors from the law.
TEST_P(LawFieldTest, CoverAgreesWithTheLaw) {
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kFields = 400;
  FieldAudit audit;
  for (int i = 0; i < kFields; ++i) {
    audit = BuildField(GetParam().params, {64, static_cast<std::uint32_t>(i)}, {}).audit;
    sum += audit.disc_cover;
    squares += audit.disc_cover * audit.disc_cover;
  }
  const double mean = sum / kFields;
  const double standard_error = std::sqrt((squares / kFields - mean * mean) / kFields);
  // Rocks over the very points of start and goal are left out: less than a percent of the
  // cover.
  EXPECT_LT(audit.expected_cover, GetParam().cover);
  EXPECT_GT(audit.expected_cover, 0.99 * GetParam().cover);
  EXPECT_NEAR(mean, audit.expected_cover, 3.3 * standard_error);
  EXPECT_GT(std::abs(mean - GetParam().published_cover), 5.0 * standard_error);
}

TEST(UniformFieldTest, DiametersAreUniform) {
  const auto rocks = RocksOfManyFields(ExactCount(15, ArenaKind::kVirtualReflected), 65, 300);
  const auto diameters = Collect(rocks, [](const Rock& rock) { return rock.diameter_m; });
  EXPECT_GT(core::KolmogorovP(diameters, UniformCdf(0.25, 0.35)), kAlpha);
  EXPECT_LT(core::KolmogorovP(diameters, UniformCdf(0.25, 0.36)), kRejects);
}

class RockShapeTest : public testing::Test {
 protected:
  const std::vector<Rock> rocks_ = RocksOfManyFields(PlainMoore(kVikingLander2K), 66, 30);
};

TEST_F(RockShapeTest, AxesAndYawAreUniform) {
  const auto width =
      Collect(rocks_, [](const Rock& rock) { return rock.semi_axes_m.y() / rock.semi_axes_m.x(); });
  const auto height =
      Collect(rocks_, [](const Rock& rock) { return rock.semi_axes_m.z() / rock.semi_axes_m.x(); });
  const auto yaw = Collect(rocks_, [](const Rock& rock) { return rock.yaw_rad; });
  EXPECT_GT(core::KolmogorovP(width, UniformCdf(0.7, 1.0)), kAlpha);
  EXPECT_GT(core::KolmogorovP(height, UniformCdf(0.8, 1.2)), kAlpha);
  EXPECT_GT(core::KolmogorovP(yaw, UniformCdf(-0.5 * std::numbers::pi, 0.5 * std::numbers::pi)),
            kAlpha);
  EXPECT_LT(core::KolmogorovP(width, UniformCdf(0.65, 1.0)), kRejects);
  EXPECT_LT(core::KolmogorovP(height, UniformCdf(0.8, 1.25)), kRejects);
}

TEST_F(RockShapeTest, OneThirdIsBuriedOnAverage) {
  const auto buried = Collect(
      rocks_, [](const Rock& rock) { return 1.0 - rock.height_m / (2.0 * rock.semi_axes_m.z()); });
  EXPECT_GT(core::KolmogorovP(buried, UniformCdf(1.0 / 3.0 - 0.1, 1.0 / 3.0 + 0.1)), kAlpha);
  EXPECT_LT(core::KolmogorovP(buried, UniformCdf(0.25, 0.45)), kRejects);
}

// Matthies 1995 sec. 7: 23 cm of diameter stand for 15 cm of height.
TEST_F(RockShapeTest, MeanHeightIsTwoThirdsOfTheDiameter) {
  double sum = 0.0;
  for (const Rock& rock : rocks_) sum += rock.height_m / rock.diameter_m;
  // The ratio's standard deviation is about 0.1; the mean of 8000 scatters by 0.0011.
  EXPECT_NEAR(sum / static_cast<double>(rocks_.size()), 2.0 / 3.0, 0.004);
}

// The roughness of the ground against the asked RMS and scaling.

// Mean square over many grounds, at points far apart.
double MeanSquare(double hurst,
                  const std::function<double(const Ground&, double x_m, double y_m)>& value_m) {
  constexpr std::uint32_t kTrials = 40;
  constexpr int kPoints = 400;
  GroundParams params{.roughness_rms_m = 0.05, .hurst_exponent = hurst};
  double sum = 0.0;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    const Ground ground(params, {81, trial});
    for (int i = 0; i < kPoints; ++i) {
      sum += std::pow(value_m(ground, 1.37 * (i % 20) - 8.0, 1.61 * (i / 20) - 9.0), 2);
    }
  }
  return sum / kTrials / kPoints;
}

// 16000 heights, neighbours 1.4 m apart and so nearly independent: the mean square scatters by
// about 1.5 %. Alpha about 1e-3 at 5 %.
TEST(RoughnessStatisticsTest, RmsIsAsAsked) {
  const auto height_m = [](const Ground& ground, double x_m, double y_m) {
    return ground.Height(x_m, y_m);
  };
  EXPECT_NEAR(MeanSquare(0.8, height_m) / 0.0025, 1.0, 0.05);
  EXPECT_NEAR(MeanSquare(0.5, height_m) / 0.0025, 1.0, 0.05);
}

// Between the octaves' ends height differences grow as distance^H, within what a band-limited sum
// of five octaves allows; another exponent is told apart.
TEST(RoughnessStatisticsTest, DifferencesGrowWithTheHurstExponent) {
  // Structure function: mean squared height difference over a distance.
  const auto structure = [](double hurst, double distance_m) {
    return MeanSquare(hurst, [distance_m](const Ground& ground, double x_m, double y_m) {
      return ground.Height(x_m + distance_m, y_m) - ground.Height(x_m, y_m);
    });
  };
  const auto slope = [&](double hurst) {
    return 0.5 * std::log2(structure(hurst, 0.4) / structure(hurst, 0.1)) / 2.0;
  };
  const double rough = slope(0.4);
  const double smooth = slope(0.8);
  EXPECT_NEAR(rough, 0.4, 0.12);
  EXPECT_NEAR(smooth, 0.8, 0.12);
  EXPECT_GT(smooth - rough, 0.2);
}

}  // namespace
}  // namespace rockyard::terrain

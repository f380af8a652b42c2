#include "terrain/rock_size_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/json_text.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

using core::JsonValue;

const JsonValue& Oracles() {
  static const JsonValue oracles = [] {
    const std::ifstream file(ROCKYARD_SOURCE_DIR "/tests/data/moore_oracles.json");
    std::ostringstream text;
    text << file.rdbuf();
    return core::ParseJson(text.str(), "moore_oracles.json");
  }();
  return oracles;
}

double Number(const JsonValue& object, std::string_view key) { return object.Find(key)->number(); }

class MooreOracleTest : public testing::TestWithParam<const char*> {
 protected:
  const JsonValue& oracle() const { return *Oracles().Find(GetParam()); }
  double k() const { return Number(oracle(), "k"); }
};

INSTANTIATE_TEST_SUITE_P(BothTerrains, MooreOracleTest, testing::Values("nominal", "vl2"));

TEST_P(MooreOracleTest, NumberOfRocks) {
  for (const JsonValue& row : oracle().Find("number_per_m2")->list()) {
    const double expected = Number(row, "number");
    EXPECT_NEAR(MooreNumberPerM2(k(), Number(row, "diameter_m")), expected, 1e-12 * expected);
  }
}

TEST_P(MooreOracleTest, CoveredFraction) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(MooreCoveredFraction(k(), 0.1, kInfinity),
              Number(oracle(), "cover_from_0.1_m_to_infinity"), 1e-12);
  for (const JsonValue& row : oracle().Find("cover_between")->list()) {
    EXPECT_NEAR(MooreCoveredFraction(k(), Number(row, "low_m"), Number(row, "high_m")),
                Number(row, "fraction"), 1e-12);
  }
}

TEST_P(MooreOracleTest, DiameterAtProbability) {
  const MooreSizeLaw law(0.1, 1.0);
  for (const JsonValue& row : oracle().Find("inverse_cdf_0.1_to_1.0_m")->list()) {
    const double probability = Number(row, "probability");
    EXPECT_NEAR(law.Diameter(probability), Number(row, "diameter_m"), 1e-12);
    EXPECT_NEAR(law.Cdf(Number(row, "diameter_m")), probability, 1e-12);
  }
  EXPECT_NEAR(law.MeanPower(1.0), Number(oracle(), "mean_diameter_0.1_to_1.0_m"), 1e-12);
}

TEST(MooreCoverTest, PublishedCoverageIntegratesToInfinity) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(MooreCoveredFraction(kVikingLander2K, 0.1, kInfinity), 0.19, 0.005);
  EXPECT_NEAR(MooreCoveredFraction(kNominalK, 0.1, kInfinity), 0.06, 0.0005);
  EXPECT_NEAR(MooreCoveredFraction(kVikingLander2K, 0.1, 1.0), 0.147, 0.0005);
  EXPECT_NEAR(MooreCoveredFraction(kNominalK, 0.1, 1.0), 0.047, 0.0005);
}

// The audit's route to the cover: density times mean squared diameter.
TEST(MooreCoverTest, EqualsMeanSquareTimesDensity) {
  RockFieldParams params;
  const double cover = 0.25 * M_PI * params.RocksPerM2() * MakeSizeLaw(params)->MeanPower(2.0);
  EXPECT_NEAR(cover, MooreCoveredFraction(params.k_per_m2, 0.1, 1.0), 1e-12);
}

// Mean powers against sums over the inverse distribution function.
TEST(MeanPowerTest, AgreesWithQuadrature) {
  const MooreSizeLaw moore(0.1, 1.0);
  const UniformSizeLaw uniform(0.25, 0.35);
  constexpr int kSteps = 200000;
  for (const RockSizeLaw* law :
       {static_cast<const RockSizeLaw*>(&moore), static_cast<const RockSizeLaw*>(&uniform)}) {
    for (const double power : {0.0, 1.0, 2.0, 3.0}) {
      double sum = 0.0;
      for (int i = 0; i < kSteps; ++i) sum += std::pow(law->Diameter((i + 0.5) / kSteps), power);
      EXPECT_NEAR(law->MeanPower(power), sum / kSteps, 2e-5) << power;
    }
  }
}

TEST(UniformSizeLawTest, ClosedForms) {
  const UniformSizeLaw law(0.25, 0.35);
  EXPECT_NEAR(law.Diameter(0.25), 0.275, 1e-15);
  EXPECT_NEAR(law.Cdf(0.275), 0.25, 1e-14);
  EXPECT_DOUBLE_EQ(law.Cdf(0.2), 0.0);
  EXPECT_DOUBLE_EQ(law.Cdf(0.4), 1.0);
  EXPECT_NEAR(law.MeanPower(1.0), 0.30, 1e-15);
  EXPECT_NEAR(law.MeanPower(2.0), 0.09 + 0.01 / 12.0, 1e-15);
}

TEST(UniformSizeLawTest, OneDiameterOnly) {
  const UniformSizeLaw law(0.3, 0.3);
  EXPECT_DOUBLE_EQ(law.Diameter(0.7), 0.3);
  EXPECT_DOUBLE_EQ(law.MeanPower(2.0), 0.3 * 0.3);
  EXPECT_EQ(law.Cdf(0.29), 0.0);
  EXPECT_EQ(law.Cdf(0.3), 1.0);
}

TEST(MakeSizeLawTest, NoneHasNoLaw) {
  RockFieldParams params{.kind = RockFieldKind::kNone};
  EXPECT_EQ(MakeSizeLaw(params), nullptr);
  EXPECT_EQ(params.RocksPerM2(), 0.0);
}

}  // namespace
}  // namespace rockyard::terrain

// Golombek and Rapp's law against integrals of another program and published counts.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/json_text.h"
#include "terrain/marked_field.h"
#include "terrain/rock_size_law.h"

namespace rockyard::terrain {
namespace {

using core::JsonValue;

const JsonValue& Oracles() {
  static const JsonValue oracles = [] {
    const std::ifstream file(ROCKYARD_SOURCE_DIR "/tests/data/golombek_oracles.json");
    std::ostringstream text;
    text << file.rdbuf();
    return core::ParseJson(text.str(), "golombek_oracles.json");
  }();
  return oracles;
}

double Number(const JsonValue& object, std::string_view key) { return object.Find(key)->number(); }

double NumberBetween(const JsonValue& row) {
  const double cover = Number(row, "cover");
  return GolombekNumberPerM2(cover, Number(row, "low_m")) -
         GolombekNumberPerM2(cover, Number(row, "high_m"));
}

TEST(GolombekLawTest, NumbersAndMeanPowersAreTheIntegrals) {
  for (const JsonValue& row : Oracles().Find("between")->list()) {
    const double expected = Number(row, "number_per_m2");
    EXPECT_NEAR(NumberBetween(row), expected, 1e-11 * expected);
    const GolombekSizeLaw law(Number(row, "cover"), Number(row, "low_m"), Number(row, "high_m"));
    double power = 0.0;
    for (const JsonValue& mean : row.Find("mean_powers")->list()) {
      EXPECT_NEAR(law.MeanPower(power), mean.number(), 1e-11 * mean.number())
          << Number(row, "cover") << " " << power;
      power += 1.0;
    }
  }
}

TEST(GolombekLawTest, DiameterAtProbability) {
  for (const JsonValue& row : Oracles().Find("inverse_cdf_0.1_to_1.0_m")->list()) {
    const GolombekSizeLaw law(Number(row, "cover"), 0.1, 1.0);
    const double probability = Number(row, "probability");
    EXPECT_NEAR(law.Diameter(probability), Number(row, "diameter_m"), 1e-12) << probability;
    EXPECT_NEAR(law.Cdf(Number(row, "diameter_m")), probability, 1e-12);
  }
}

// Wherever parameters may lie.
TEST(GolombekLawTest, DiametersInvertTheDistribution) {
  for (const double cover : {0.001, 0.03, 0.5}) {
    for (const auto& [min_m, max_m] :
         {std::array{0.02, 5.0}, std::array{2.0, 5.0}, std::array{0.1, 0.1001}}) {
      const GolombekSizeLaw law(cover, min_m, max_m);
      double last_m = min_m;
      for (const double u : {1e-15, 1e-6, 0.2, 0.5, 0.99, 1.0 - 1e-9}) {
        const double diameter_m = law.Diameter(u);
        EXPECT_NEAR(law.Cdf(diameter_m), u, 1e-11) << cover << " " << min_m << " " << u;
        EXPECT_GE(diameter_m, last_m);
        EXPECT_LE(diameter_m, max_m);
        last_m = diameter_m;
      }
      EXPECT_EQ(law.Cdf(0.5 * min_m), 0.0);
      EXPECT_EQ(law.Cdf(2.0 * max_m), 1.0);
    }
  }
}

// Golombek et al. 2008, table 5: the printed counts are those of binned sizes, and exceed the
// integral by 4 to 9 % from 0.1 m on, by up to 23 % from 2 cm on.
TEST(GolombekLawTest, PublishedCountsAreALittleAboveTheIntegral) {
  for (const JsonValue& row : Oracles().Find("table5")->list()) {
    const double rocks = 3.8 * NumberBetween(row);
    EXPECT_NEAR(rocks, Number(row, "exact"), 1e-11 * rocks);
    const double ratio = Number(row, "published") / rocks;
    EXPECT_GT(ratio, 1.03) << Number(row, "cover");
    EXPECT_LT(ratio, Number(row, "low_m") < 0.1 ? 1.24 : 1.09) << Number(row, "cover");
  }
}

// F(D) = k exp(-q D): the share of the ground under rocks from 0.25 m on at Viking Lander 1, where
// the areas of the catalogue's label give 2.53 % (data set VL1/VL2-M-LCS-5-ROCKS-V1.0).
TEST(GolombekLawTest, CoverIsTheExponential) {
  RockFieldParams params{
      .kind = RockFieldKind::kGolombek, .min_diameter_m = 0.25, .max_diameter_m = 5.0};
  const double cover =
      0.25 * std::numbers::pi * params.RocksPerM2() * MakeSizeLaw(params)->MeanPower(2.0);
  const double q = 1.79 + 0.152 / 0.069;
  EXPECT_NEAR(cover, 0.069 * (std::exp(-0.25 * q) - std::exp(-5.0 * q)), 1e-14);
  EXPECT_NEAR(cover, 0.0253, 2e-4);
}

TEST(CoverOfMarkTest, IsWhereTheDensityIsThatShareOfTheReference) {
  for (const double reference : {0.01, 0.4}) {
    for (const double diameter_m : {0.02, 0.1, 1.0, 5.0}) {
      for (const double mark : {1e-14, 1e-3, 0.5, 1.0 - 1e-12}) {
        const double cover = CoverOfMark(mark, diameter_m, reference);
        EXPECT_GT(cover, 0.0);
        EXPECT_LE(cover, reference);
        // The density over that of the reference, without its overflow at small covers.
        const double ratio = (1.79 * cover + 0.152) / (1.79 * reference + 0.152) *
                             std::exp(-0.152 * diameter_m * (1.0 / cover - 1.0 / reference));
        EXPECT_NEAR(ratio / mark, 1.0, 1e-9) << diameter_m << " " << mark;
      }
    }
  }
}

}  // namespace
}  // namespace rockyard::terrain

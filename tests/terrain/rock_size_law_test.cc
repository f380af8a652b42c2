#include "terrain/rock_size_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/json_text.h"
#include "terrain/placed_rocks.h"
#include "terrain/rock.h"
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

// Points of rocks for drawings against the queries of the terrain.

constexpr double kGround_m = 0.3;

// Turned, three quarters as wide as long, and with that height above the ground.
Rock Standing(double pointedness) {
  Rock rock =
      ShapeRock({.diameter_m = 0.6, .width_ratio = 0.75, .half_height_m = 0.2, .height_m = 0.28},
                pointedness);
  rock.center_W += math::Vector3(4.0, -2.0, kGround_m);
  rock.yaw_rad = 0.7;
  return rock;
}

TEST(RockPoints, LieOnTheSurfaceFromTheGroundToTheTop) {
  for (const double pointedness : {0.0, 0.5, 0.9}) {
    const Rock rock = Standing(pointedness);
    const RockShape shape(rock);
    double lowest_m = 1e9;
    double highest_m = -1e9;
    for (const math::Vector3& point : PointsAbove(rock, kGround_m)) {
      lowest_m = std::min(lowest_m, point.z());
      highest_m = std::max(highest_m, point.z());
      if (point.z() < rock.center_W.z() + 1e-9) continue;  // an ellipsoid's lower half
      // A little inwards, where the query is not beside the rock.
      const math::Vector3 within = point + 1e-9 * (rock.center_W - point);
      EXPECT_NEAR(shape.Top(within.x(), within.y()), point.z(), 1e-3) << pointedness;
    }
    EXPECT_NEAR(lowest_m, kGround_m, 1e-12) << pointedness;
    EXPECT_NEAR(highest_m, kGround_m + rock.height_m, 1e-12) << pointedness;
  }
}

// (p / semi-axes)^2 adds up to 1 on all of an ellipsoid.
TEST(RockPoints, TheLowerHalfOfAnEllipsoidIsOnItToo) {
  const Rock rock = Standing(0.0);
  const RockShape shape(rock);
  for (const math::Vector3& point : PointsAbove(rock, kGround_m)) {
    EXPECT_NEAR(shape.Map(point - rock.center_W).norm(), 1.0, 1e-12);
  }
}

TEST(RockPoints, NothingOfABuriedRock) {
  const Rock rock = Standing(0.0);
  EXPECT_TRUE(PointsAbove(rock, kGround_m + rock.height_m + 0.01).empty());
  EXPECT_FALSE(PointsAbove(rock, kGround_m + rock.height_m - 0.01).empty());
}

TEST(RockPoints, TheOutlineIsAnOctagonOfTheEllipse) {
  const Rock rock = Standing(0.0);
  const std::vector<math::Vector3> outline = PlanOutline(rock);
  ASSERT_EQ(outline.size(), 8u);
  const RockShape shape(rock);
  for (const math::Vector3& corner : outline) {
    EXPECT_NEAR(shape.Map(corner - rock.center_W).norm(), 1.0, 1e-12);
    EXPECT_EQ(corner.z(), rock.center_W.z());
  }
}

// Holding forces against the numbers of a pocket calculator.

constexpr double kEarth_m_s2 = 9.81;

// An ellipsoid of 2 a x 2 b x 2 c, buried to a depth of depth_m.
Rock MakeRock(double a_m, double b_m, double c_m, double depth_m) {
  return EllipsoidRock(0.0, 0.0, c_m - depth_m, a_m, b_m, c_m);
}

TEST(RockHolding, MassIsThatOfTheEllipsoid) {
  EXPECT_NEAR(RockMass(MakeRock(0.1, 0.1, 0.1, 0.0), 2700.0), 11.310, 1e-3);
  EXPECT_NEAR(RockMass(MakeRock(0.2, 0.1, 0.05, 0.0), 2700.0), 11.310, 1e-3);
}

TEST(RockHolding, UnburiedRockIsHeldByFrictionUnderWeightAndLoad) {
  const RockHoldingParams params;
  const Rock rock = MakeRock(0.1, 0.1, 0.1, 0.0);
  const double weight_N = 11.3097 * kEarth_m_s2;
  const auto force = [&](double load_N) {
    return HoldingForce(rock, params, kEarth_m_s2, load_N, math::Vector3::UnitX());
  };
  EXPECT_NEAR(force(0.0), 0.6 * weight_N, 1e-3);
  EXPECT_NEAR(force(50.0), 0.6 * (weight_N + 50.0), 1e-3);
  EXPECT_NEAR(force(-50.0), 0.6 * (weight_N - 50.0), 1e-3);
  EXPECT_EQ(force(-2.0 * weight_N), 0.0);  // lifted
}

// Rankine: K = 3 at 30 degrees. Half of 3 x 1600 x 9.81 N/m3 x (0.1 m)^2 x 0.3 m is 70.63 N.
TEST(RockHolding, BuriedRockIsAlsoHeldByThePassivePressureOnItsFront) {
  RockHoldingParams params{.soil_friction_angle_rad = math::DegToRad(30.0),
                           .rock_soil_friction = 0.0};
  const auto force = [&](double depth_m, const math::Vector3& push_W) {
    return HoldingForce(MakeRock(0.15, 0.1, 0.15, depth_m), params, kEarth_m_s2, 0.0, push_W);
  };
  EXPECT_NEAR(force(0.1, math::Vector3::UnitY()), 70.63, 0.01);
  EXPECT_NEAR(force(0.1, math::Vector3::UnitX()), 70.63 * 2.0 / 3.0, 0.01);  // 0.2 m wide
  EXPECT_NEAR(force(0.2, math::Vector3::UnitY()), 4.0 * 70.63, 0.04);
  EXPECT_EQ(force(0.0, math::Vector3::UnitY()), 0.0);
}

TEST(RockHolding, WidthFollowsTheRocksYaw) {
  RockHoldingParams params{.rock_soil_friction = 0.0};
  Rock rock = MakeRock(0.15, 0.1, 0.15, 0.1);
  const double across_N =
      HoldingForce(rock, params, kEarth_m_s2, 0.0, 7.0 * math::Vector3::UnitY());
  rock.yaw_rad = 0.5 * std::numbers::pi;
  EXPECT_NEAR(HoldingForce(rock, params, kEarth_m_s2, 0.0, -math::Vector3::UnitX()), across_N,
              1e-9);
}

}  // namespace
}  // namespace rockyard::terrain

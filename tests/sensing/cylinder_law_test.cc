// How the lander finds the coloured cylinder, as a law and as fixes drawn by it.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "math/angles.h"
#include "noise_laws.h"
#include "sensing/aids.h"
#include "sensing/stripe_scene.h"

namespace rockyard::sensing {
namespace {

using math::DegToRad;
using math::RadToDeg;

constexpr core::TrialKey kCylinderKey{20261126, 3};
constexpr int kFixes = 4000;
constexpr int kHeadingRow = messages::Index(messages::PoseCoordinate::kHeading);
// Distance at which the cylinder is 20 pixels wide: m (d/rho - rho/d) tan(phi/2) = M.
constexpr double kTwentyPixels_m = 9.393;

// No coefficient is fitted.
CylinderLawParams Blank() {
  return {.found = {},
          .wrong = {},
          .heading = {},
          .range = {},
          .bearing = {},
          .heading_bias_rad = 0.0,
          .range_bias = 0.0};
}

CylinderLawParams OnePixel() {
  CylinderLawParams params = Blank();
  params.heading = {{.pixels = 1.0}};
  params.range = {{.pixels = 1.0}};
  params.bearing = {{.pixels = 1.0}};
  return params;
}

CylinderDeviations At(const CylinderLawParams& params, double distance_m, double theta_deg) {
  return CylinderLaw(params).Deviations({distance_m, DegToRad(theta_deg), DegToRad(60.0)});
}

// Matthies 1995, app. A.2: at 11.24 m a pixel is worth 6.7 to 9.5 deg and 5.88 % (m = 17).
TEST(CylinderLawTest, IsWorthAPixelAsPublished) {
  EXPECT_NEAR(RadToDeg(At(OnePixel(), 11.24, 0.0).heading_rad), 6.7, 0.2);
  EXPECT_NEAR(RadToDeg(At(OnePixel(), 11.24, 45.0).heading_rad), 9.5, 0.25);
  EXPECT_NEAR(At(OnePixel(), 11.24, 45.0).range, 0.0588, 0.0015);
  EXPECT_NEAR(At(OnePixel(), 11.24, 0.0).bearing_rad, 2.0 * std::tan(DegToRad(14.665)) / 512.0,
              1e-12);
  // Every quadrant and either side alike.
  for (const double theta_deg : {-150.0, -120.0, -60.0, -30.0, 30.0, 60.0, 120.0, 150.0, 390.0}) {
    EXPECT_NEAR(At(OnePixel(), 5.0, theta_deg).heading_rad,
                At(OnePixel(), 5.0, 0.0).heading_rad / std::cos(DegToRad(30.0)), 1e-12);
  }
}

TEST(CylinderLawTest, AddsTheLeastDeviationByItsSquare) {
  CylinderLawParams params = OnePixel();
  params.range.least = 0.03;
  const double pixel = At(OnePixel(), 5.0, 0.0).range;
  EXPECT_NEAR(At(params, 5.0, 0.0).range, std::sqrt(0.0009 + pixel * pixel), 1e-12);
}

double OddsOfFinding(const CylinderLawParams& params, double distance_m, double theta_deg,
                     double sun_deg) {
  const double p =
      CylinderLaw(params).FindChance({distance_m, DegToRad(theta_deg), DegToRad(sun_deg)});
  return std::log(p / (1.0 - p));
}

TEST(CylinderLawTest, AddsUpItsOdds) {
  CylinderLawParams params = Blank();
  params.found = {.intercept = 0.5, .width = 2.0, .no_blue = -1.5, .light = 0.8};
  EXPECT_NEAR(OddsOfFinding(params, kTwentyPixels_m, 45.0, 30.0), 0.5 + 0.4, 2e-3);
  EXPECT_NEAR(OddsOfFinding(params, 0.5 * kTwentyPixels_m, 45.0, 30.0), 0.9 + 2.0 * std::log(2.0),
              2e-3);
  for (const double theta_deg : {-179.0, -135.0, -91.0, 225.0}) {
    EXPECT_NEAR(OddsOfFinding(params, kTwentyPixels_m, theta_deg, 30.0), 0.9 - 1.5, 2e-3);
  }
  for (const double theta_deg : {-89.0, 0.0, 135.0, 179.0}) {
    EXPECT_NEAR(OddsOfFinding(params, kTwentyPixels_m, theta_deg, 30.0), 0.9, 2e-3);
  }
  EXPECT_NEAR(OddsOfFinding(params, kTwentyPixels_m, 45.0, 90.0), 0.5 + 0.8, 2e-3);
  params.found.pink_aside = 0.7;
  EXPECT_NEAR(OddsOfFinding(params, kTwentyPixels_m, 45.0, 30.0), 0.9 + 0.7, 2e-3);
  EXPECT_NEAR(OddsOfFinding(params, kTwentyPixels_m, 135.0, 30.0), 0.9 - 0.7, 2e-3);
  EXPECT_NEAR(OddsOfFinding(params, kTwentyPixels_m, 15.0, 30.0), 0.9 + 0.35, 2e-3);
}

TEST(CylinderLawTest, FindsNothingTooNearOrInTheDark) {
  CylinderLawParams params = Blank();
  params.found.intercept = 1000.0;
  const CylinderLaw law(params);
  EXPECT_EQ(law.FindChance({0.84, 0.0, 0.1}), 1.0);
  EXPECT_EQ(law.FindChance({0.83, 0.0, 0.1}), 0.0);
  EXPECT_EQ(law.FindChance({5.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(law.FindChance({5.0, 0.0, -0.1}), 0.0);
}

TEST(CylinderLawTest, TellsWrongFromFound) {
  CylinderLawParams params = Blank();
  params.found.intercept = 2.0;
  params.wrong.intercept = -3.0;
  EXPECT_NEAR(CylinderLaw(params).WrongChance({5.0, 0.0, 0.1}), 1.0 / (1.0 + std::exp(3.0)), 1e-12);
}

// The rover 10 m from the lander at (2, 1), as far ahead as 8 m and 6 m to the left; the cameras
// lie in direction 216.87 deg from it.
const LanderPlace kPlace{.x_m = 2.0, .y_m = 1.0};
constexpr double kToLander_deg = 216.869897645844;
math::Transform RoverHeading(double heading_deg) {
  return PoseAt(10.0, 7.0, 0.0, DegToRad(heading_deg));
}

LanderFixParams Certain() {
  LanderFixParams params{.law = LanderFixLaw::kCylinder, .cylinder = Blank()};
  params.cylinder.found.intercept = 1000.0;
  params.cylinder.wrong.intercept = -1000.0;
  params.cylinder.heading.least = DegToRad(5.0);
  params.cylinder.range.least = 0.05;
  params.cylinder.bearing.least = 0.001;
  return params;
}

std::optional<messages::PoseFix> FixOf(const LanderFixParams& params, double heading_deg,
                                       int number = 0,
                                       std::optional<double> sun_rad = std::nullopt) {
  return LanderFix(params, kPlace, kCylinderKey)
      .Observe(RoverHeading(heading_deg), Flat(), number, sun_rad);
}

// What a fix tells of the range over the true one, and its error of the heading.
double RangeShare(const messages::PoseFix& fix) {
  return std::hypot(fix.pose[0] - kPlace.x_m, fix.pose[1] - kPlace.y_m) / 10.0;
}
double HeadingError(const messages::PoseFix& fix, double rover_heading_deg) {
  return math::WrapAngle(fix.pose[kHeadingRow] - DegToRad(rover_heading_deg));
}

// With the constant law's deviations and nothing missed or wrong both laws draw the same.
TEST(CylinderFixTest, DrawsAsTheConstantLaw) {
  for (int number = 0; number < 20; ++number) {
    const auto constant = FixOf({}, 40.0, number);
    const auto cylinder = FixOf(Certain(), 40.0, number);
    EXPECT_LT((constant->pose - cylinder->pose).norm(), 1e-9);
    EXPECT_LT((constant->covariance - cylinder->covariance).norm(), 1e-9);
  }
}

TEST(CylinderFixTest, LeavesTheConstantLawAlone) {
  LanderFixParams params = Certain();
  params.law = LanderFixLaw::kConstant;
  params.cylinder.found.intercept = -1000.0;
  params.cylinder.range_bias = 0.5;
  EXPECT_EQ(FixOf(params, 40.0)->pose, FixOf({}, 40.0)->pose);
  EXPECT_EQ(FixOf(params, 40.0, 0, -0.1)->pose, FixOf({}, 40.0)->pose);
}

// theta = direction to the cameras less the rover's heading less the mounting.
TEST(CylinderFixTest, SeesTheSideThatIsTurnedToIt) {
  LanderFixParams params = Certain();
  params.cylinder.found = {.intercept = 500.0, .no_blue = -1000.0};
  const auto seen = [&](double theta_deg) {
    return FixOf(params, kToLander_deg - theta_deg).has_value();
  };
  EXPECT_FALSE(seen(-135.0));
  EXPECT_FALSE(seen(-95.0));
  EXPECT_FALSE(seen(-175.0));
  for (const double theta_deg : {-85.0, -45.0, 45.0, 135.0, 175.0}) EXPECT_TRUE(seen(theta_deg));
  params.cylinder.mounting_rad = DegToRad(90.0);
  EXPECT_TRUE(seen(-135.0));
  EXPECT_FALSE(seen(-45.0));
}

TEST(CylinderFixTest, TakesTheSunItIsGiven) {
  LanderFixParams params = Certain();
  params.cylinder.found = {.intercept = -500.0, .light = 1000.0};
  EXPECT_TRUE(FixOf(params, 0.0));
  EXPECT_FALSE(FixOf(params, 0.0, 0, DegToRad(29.0)));
  EXPECT_TRUE(FixOf(params, 0.0, 0, DegToRad(31.0)));
  params.cylinder.sun_elevation_rad = DegToRad(29.0);
  EXPECT_FALSE(FixOf(params, 0.0));
}

TEST(CylinderFixTest, ErrsByItsDeviationsAndBiases) {
  LanderFixParams params = Certain();
  params.cylinder.heading.pixels = 1.0;
  params.cylinder.range.pixels = 0.5;
  params.cylinder.heading_bias_rad = DegToRad(3.0);
  params.cylinder.range_bias = -0.04;
  const double theta_deg = 30.0;
  const CylinderDeviations sd = At(params.cylinder, 10.0, theta_deg);
  std::vector<std::vector<double>> errors(3);
  for (int i = 0; i < kFixes; ++i) {
    const double heading_deg = kToLander_deg - theta_deg;
    const auto fix = FixOf(params, heading_deg, i);
    const double bearing_rad = std::atan2(fix->pose[1] - kPlace.y_m, fix->pose[0] - kPlace.x_m);
    errors[0].push_back((RangeShare(*fix) - 0.96) / sd.range);
    errors[1].push_back((bearing_rad - std::atan2(6.0, 8.0)) / sd.bearing_rad);
    errors[2].push_back((HeadingError(*fix, heading_deg) - DegToRad(3.0)) / sd.heading_rad);
  }
  for (const auto& error : errors) EXPECT_GT(core::KolmogorovP(error, NormalCdf), kAlpha);
  // The control: a mean an eighth of a deviation off shows.
  for (double& value : errors[2]) value += 0.125;
  EXPECT_LT(core::KolmogorovP(errors[2], NormalCdf), kAlpha);
}

TEST(CylinderFixTest, IsMissedAndWrongAsOftenAsTold) {
  LanderFixParams params = Certain();
  params.cylinder.found.intercept = std::log(0.7 / 0.3);
  params.cylinder.wrong.intercept = std::log(0.2 / 0.8);
  params.cylinder.heading.least = DegToRad(0.01);
  int found = 0, wrong = 0;
  for (int i = 0; i < kFixes; ++i) {
    const auto fix = FixOf(params, 40.0, i);
    if (!fix) continue;
    ++found;
    wrong += std::abs(HeadingError(*fix, 40.0)) > DegToRad(0.1) ? 1 : 0;
  }
  // Four standard deviations of a binomial share: a chance of 6e-5.
  EXPECT_NEAR(found / static_cast<double>(kFixes), 0.7, 4.0 * std::sqrt(0.21 / kFixes));
  EXPECT_NEAR(wrong / static_cast<double>(found), 0.2, 4.0 * std::sqrt(0.16 / found));
}

// Chances are drawn apart from errors: what is found errs as what is missed would have.
TEST(CylinderFixTest, IsMissedWhateverItsErrors) {
  LanderFixParams params = Certain();
  params.cylinder.found.intercept = 0.0;
  std::vector<double> ranges;
  for (int i = 0; i < kFixes; ++i) {
    const auto fix = FixOf(params, 40.0, i);
    if (fix) ranges.push_back((RangeShare(*fix) - 1.0) / 0.05);
  }
  EXPECT_GT(core::KolmogorovP(ranges, NormalCdf), kAlpha);
}

TEST(CylinderFixTest, DoesNotKnowThatItIsWrong) {
  LanderFixParams params = Certain();
  params.cylinder.wrong.intercept = 1000.0;
  params.cylinder.wrong_turn_rad = DegToRad(120.0);
  params.cylinder.wrong_range = 0.3;
  std::vector<double> turns, ranges;
  for (int i = 0; i < kFixes; ++i) {
    const auto fix = FixOf(params, 40.0, i);
    turns.push_back(HeadingError(*fix, 40.0));
    ranges.push_back(std::log(RangeShare(*fix)) / 0.3);
    EXPECT_NEAR(fix->covariance(kHeadingRow, kHeadingRow), std::pow(DegToRad(5.0), 2), 1e-12);
  }
  const auto uniform = [](double turn) { return 0.5 + turn / DegToRad(240.0); };
  EXPECT_GT(core::KolmogorovP(turns, uniform), kAlpha);
  EXPECT_GT(core::KolmogorovP(ranges, NormalCdf), kAlpha);
  // The control: a tenth less turn shows.
  for (double& turn : turns) turn *= 0.9;
  EXPECT_LT(core::KolmogorovP(turns, uniform), kAlpha);
}

}  // namespace
}  // namespace rockyard::sensing

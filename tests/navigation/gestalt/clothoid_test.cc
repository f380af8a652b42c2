// Clothoids against Fresnel integrals, quadrature, arcs and themselves.
#include "navigation/gestalt/clothoid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clothoid_known.h"
#include "core/check.h"
#include "core/random.h"

namespace rockyard::navigation {
namespace {

constexpr double kPi = std::numbers::pi;

// By Simpson's rule with n = 4000 intervals, whose error is L h^4 max |f''''| / 180: below 1e-13 m
// for what the tests ask.
ClothoidPoint BySimpson(double curvature, double rate, double length) {
  constexpr int kIntervals = 4000;
  ClothoidPoint sum;
  for (int i = 0; i <= kIntervals; ++i) {
    const double s = length * i / kIntervals;
    const double heading = s * (curvature + 0.5 * rate * s);
    const bool end = i == 0 || i == kIntervals;
    const double weight = end ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum.x_m += weight * std::cos(heading) * length / (3.0 * kIntervals);
    sum.y_m += weight * std::sin(heading) * length / (3.0 * kIntervals);
  }
  sum.heading_rad = length * (curvature + 0.5 * rate * length);
  return sum;
}

// With c = 0 and c' = pi the heading is pi s^2 / 2: x and y are the integrals themselves.
TEST(Clothoid, IsAFresnelIntegral) {
  for (const core::JsonValue& known : KnownAnswers("fresnel")) {
    const double z = Number(known, "z");
    SCOPED_TRACE(z);
    // Both are odd in z.
    const double side = z < 0.0 ? -1.0 : 1.0;
    const ClothoidPoint point = OnClothoid(0.0, kPi, std::abs(z));
    const double error = 1e-12 * std::max(1.0, std::abs(z));
    EXPECT_NEAR(point.x_m, side * Number(known, "C"), error);
    EXPECT_NEAR(point.y_m, side * Number(known, "S"), error);
  }
}

TEST(Clothoid, AgreesWithKnownAnswers) {
  ASSERT_EQ(KnownAnswers("clothoid").size(), 75u);
  for (const core::JsonValue& known : KnownAnswers("clothoid")) {
    const double length = Number(known, "L");
    const double rate = (Number(known, "kappa1") - Number(known, "kappa0")) / length;
    ExpectNear(OnClothoid(Number(known, "kappa0"), rate, length),
               {Number(known, "x"), Number(known, "y"), Number(known, "theta")}, 3e-12);
  }
}

TEST(Clothoid, WithoutRateIsAnArcOrAStraightLine) {
  for (const double length : {0.0, 0.01, 0.12, 0.13, 1.0, 3.0, 20.0}) {
    EXPECT_NEAR(OnClothoid(0.0, 0.0, length).x_m, length, 1e-15 * length);
    EXPECT_EQ(OnClothoid(0.0, 0.0, length).y_m, 0.0);
    EXPECT_EQ(OnClothoid(0.0, 0.0, length).heading_rad, 0.0);
    for (const double c : {-20.0, -1.0, -1e-3, 1e-9, 0.3, 1.0, 7.0}) {
      const double half_sine = std::sin(0.5 * c * length);
      ExpectNear(OnClothoid(c, 0.0, length),
                 {std::sin(c * length) / c, 2.0 * half_sine * half_sine / c, c * length},
                 1e-12 * length);
    }
  }
}

// At turns on both sides of those at which the way of integrating changes.
TEST(Clothoid, KeepsItsErrorForAnyCurvatureAndLength) {
  core::RandomStream random({31, 0}, core::Purpose::kTest, 0);
  for (int i = 0; i < 2000; ++i) {
    const double length = 3.0 * random.Uniform();
    const double turn = i % 2 == 0 ? 0.25 * random.Uniform() : 6.0 * random.Uniform();
    const double curvature = (2.0 * random.Uniform() - 1.0) * turn / length;
    const double rate = (2.0 * random.Uniform() - 1.0) * turn * turn / (length * length);
    SCOPED_TRACE(testing::Message() << curvature << " " << rate << " " << length);
    // Its own error, and that of the comparison.
    ExpectNear(OnClothoid(curvature, rate, length), BySimpson(curvature, rate, length),
               1e-12 * length + 1e-13);
  }
}

TEST(Clothoid, MirroredCurvatureGivesTheMirroredPlace) {
  for (const double length : {0.1, 2.9}) {
    const ClothoidPoint left = OnClothoid(0.4, -0.7, length);
    const ClothoidPoint right = OnClothoid(-0.4, 0.7, length);
    EXPECT_EQ(right.x_m, left.x_m);
    EXPECT_EQ(right.y_m, -left.y_m);
    EXPECT_EQ(right.heading_rad, -left.heading_rad);
    EXPECT_NE(left.y_m, 0.0);
  }
}

// From a place that is turned and moved, and in two parts.
TEST(Clothoid, GoesOnFromAnyPlace) {
  const double c = 0.4;
  const double rate = -0.7;
  const ClothoidPoint from{1.5, -0.3, 2.1};
  const ClothoidPoint own = OnClothoid(c, rate, 2.0);
  const ClothoidPoint moved{
      from.x_m + std::cos(from.heading_rad) * own.x_m - std::sin(from.heading_rad) * own.y_m,
      from.y_m + std::sin(from.heading_rad) * own.x_m + std::cos(from.heading_rad) * own.y_m,
      from.heading_rad + own.heading_rad};
  ExpectNear(AlongClothoid(from, c, rate, 2.0), moved, 1e-12);
  const ClothoidPoint middle = AlongClothoid(from, c, rate, 1.95);
  ExpectNear(AlongClothoid(middle, c + 1.95 * rate, rate, 0.05), moved, 1e-12);
}

TEST(Clothoid, HasNoNegativeLength) {
  EXPECT_THROW(OnClothoid(0.1, 0.0, -0.1), core::ContractViolation);
}

}  // namespace
}  // namespace rockyard::navigation

// Clothoids against Fresnel integrals, quadrature, arcs and themselves; splines of two knots.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "clothoid_known.h"
#include "core/check.h"
#include "core/random.h"
#include "navigation/gestalt/curvature_law.h"

namespace rockyard::navigation {
namespace {

constexpr double kPi = std::numbers::pi;

// By Simpson's rule with n = 4000 intervals, whose error is L h^4 max |f''''| / 180: below 1e-13 m
// for what the tests ask.
math::Pose2 BySimpson(double curvature, double rate, double length) {
  constexpr int kIntervals = 4000;
  math::Pose2 sum;
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
    const math::Pose2 point = AlongClothoid({}, 0.0, kPi, std::abs(z));
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
    ExpectNear(AlongClothoid({}, Number(known, "kappa0"), rate, length),
               {Number(known, "x"), Number(known, "y"), Number(known, "theta")}, 3e-12);
  }
}

TEST(Clothoid, WithoutRateIsAnArcOrAStraightLine) {
  for (const double length : {0.0, 0.01, 0.12, 0.13, 1.0, 3.0, 20.0}) {
    EXPECT_NEAR(AlongClothoid({}, 0.0, 0.0, length).x_m, length, 1e-15 * length);
    EXPECT_EQ(AlongClothoid({}, 0.0, 0.0, length).y_m, 0.0);
    EXPECT_EQ(AlongClothoid({}, 0.0, 0.0, length).heading_rad, 0.0);
    for (const double c : {-20.0, -1.0, -1e-3, 1e-9, 0.3, 1.0, 7.0}) {
      const double half_sine = std::sin(0.5 * c * length);
      ExpectNear(AlongClothoid({}, c, 0.0, length),
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
    ExpectNear(AlongClothoid({}, curvature, rate, length), BySimpson(curvature, rate, length),
               1e-12 * length + 1e-13);
  }
}

TEST(Clothoid, MirroredCurvatureGivesTheMirroredPlace) {
  for (const double length : {0.1, 2.9}) {
    const math::Pose2 left = AlongClothoid({}, 0.4, -0.7, length);
    const math::Pose2 right = AlongClothoid({}, -0.4, 0.7, length);
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
  const math::Pose2 from{1.5, -0.3, 2.1};
  const math::Pose2 own = AlongClothoid({}, c, rate, 2.0);
  const math::Pose2 moved{
      from.x_m + std::cos(from.heading_rad) * own.x_m - std::sin(from.heading_rad) * own.y_m,
      from.y_m + std::sin(from.heading_rad) * own.x_m + std::cos(from.heading_rad) * own.y_m,
      from.heading_rad + own.heading_rad};
  ExpectNear(AlongClothoid(from, c, rate, 2.0), moved, 1e-12);
  const math::Pose2 middle = AlongClothoid(from, c, rate, 1.95);
  ExpectNear(AlongClothoid(middle, c + 1.95 * rate, rate, 0.05), moved, 1e-12);
}

TEST(Clothoid, HasNoNegativeLength) {
  EXPECT_THROW(AlongClothoid({}, 0.1, 0.0, -0.1), core::ContractViolation);
}

constexpr Spline kSpline{
    .start_per_m = 0.2, .first_knot_per_m = -0.4, .second_knot_per_m = 0.8, .length_m = 3.0};

CurvatureLaw InDistance() { return {SplineLaw::kDistance, {}}; }

CurvatureLaw InTime() {
  return {SplineLaw::kTime,
          {.full_speed_curvature_per_m = 0.3, .min_speed_share = 0.4, .slow_curvature_per_m = 0.7}};
}

TEST(SplineCurves, GoFromKnotToKnot) {
  const CurvatureLaw law = InDistance();
  EXPECT_EQ(CurvatureAt(kSpline, -1.0, law), 0.2);
  EXPECT_EQ(CurvatureAt(kSpline, 0.0, law), 0.2);
  EXPECT_NEAR(CurvatureAt(kSpline, 0.5, law), 0.0, 1e-15);
  EXPECT_EQ(CurvatureAt(kSpline, 1.5, law), -0.4);
  EXPECT_NEAR(CurvatureAt(kSpline, 2.5, law), 0.4, 1e-15);
  EXPECT_EQ(CurvatureAt(kSpline, 3.0, law), 0.8);
  EXPECT_EQ(CurvatureAt(kSpline, 9.0, law), 0.8);
}

TEST(SplineCurves, RatesAreThoseFromHereOn) {
  const CurvatureLaw law = InDistance();
  EXPECT_EQ(CurvatureRateAt(kSpline, -0.1, law), 0.0);
  EXPECT_NEAR(CurvatureRateAt(kSpline, 0.0, law), -0.4, 1e-15);
  EXPECT_NEAR(CurvatureRateAt(kSpline, 1.49, law), -0.4, 1e-15);
  EXPECT_NEAR(CurvatureRateAt(kSpline, 1.5, law), 0.8, 1e-15);
  EXPECT_NEAR(CurvatureRateAt(kSpline, 2.99, law), 0.8, 1e-15);
  EXPECT_EQ(CurvatureRateAt(kSpline, 3.0, law), 0.0);
}

// The curvature is continuous, and its slope is the rate; both laws, corners left out.
TEST(SplineCurves, RatesAreTheSlopesOfTheCurvature) {
  for (const CurvatureLaw& law : {InDistance(), InTime()}) {
    for (double s_m = -0.1; s_m < 3.2; s_m += 0.01) {
      const double step_m = 1e-7;
      const double change =
          CurvatureAt(kSpline, s_m + step_m, law) - CurvatureAt(kSpline, s_m - step_m, law);
      EXPECT_LT(std::abs(change), 1e-5) << s_m;
      const double knot_m = std::min({std::abs(s_m), std::abs(s_m - 1.5), std::abs(s_m - 3.0)});
      // dc/ds jumps nowhere else.
      if (knot_m > 2.0 * step_m) {
        EXPECT_NEAR(CurvatureRateAt(kSpline, s_m, law), change / (2.0 * step_m), 1e-6) << s_m;
      }
    }
  }
}

TEST(SplineCurves, AgreeWithKnownAnswers) {
  ASSERT_EQ(KnownAnswers("two_segment").size(), 30u);
  for (const core::JsonValue& known : KnownAnswers("two_segment")) {
    const Spline spline{Number(known, "kappa0"), Number(known, "kappa_mid"),
                        Number(known, "kappa1"), Number(known, "L")};
    const math::Pose2 end = AlongSpline({}, spline, 0.0, spline.length_m, InDistance());
    ExpectNear(end, {Number(known, "x"), Number(known, "y"), Number(known, "theta")}, 3e-12);
  }
}

// What the curvature says, summed up in steps of 0.05 mm at their middles: the error of the sums is
// of the order of h^2 L / 24, 1e-10 m.
TEST(SplineCurves, PlacesFollowTheCurvature) {
  for (const CurvatureLaw& law : {InDistance(), InTime()}) {
    const double step_m = 5e-5;
    math::Pose2 sum;
    for (int i = 0; i < 80000; ++i) {
      if (i % 4000 == 0) {
        const math::Pose2 place = AlongSpline({}, kSpline, 0.0, i * step_m, law);
        ExpectNear(place, sum, 2e-9);
      }
      const double turn_rad = CurvatureAt(kSpline, (i + 0.5) * step_m, law) * step_m;
      sum.x_m += step_m * std::cos(sum.heading_rad + 0.5 * turn_rad);
      sum.y_m += step_m * std::sin(sum.heading_rad + 0.5 * turn_rad);
      sum.heading_rad += turn_rad;
    }
  }
}

TEST(SplineCurves, GoOnFromAnyPlace) {
  for (const CurvatureLaw& law : {InDistance(), InTime()}) {
    const math::Pose2 end = AlongSpline({}, kSpline, 0.0, 3.4, law);
    for (const std::vector<double>& stops :
         {std::vector<double>{0.0, 0.7, 0.7, 3.4}, {0.0, 1.5, 3.0, 3.4}, {0.0, 1.2, 3.3, 3.4}}) {
      math::Pose2 place;
      for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        place = AlongSpline(place, kSpline, stops[i], stops[i + 1], law);
      }
      ExpectNear(place, end, 4e-12);
    }
  }
  EXPECT_THROW(AlongSpline({}, kSpline, 0.0, -0.1, InDistance()), core::ContractViolation);
  EXPECT_THROW(AlongSpline({}, kSpline, 1.0, 0.9, InDistance()), core::ContractViolation);
}

}  // namespace
}  // namespace rockyard::navigation

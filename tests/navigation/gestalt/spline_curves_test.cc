// Splines of two knots: curvatures, rates and places.
#include "navigation/gestalt/spline_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "clothoid_known.h"
#include "core/check.h"

namespace rockyard::navigation {
namespace {

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

TEST(SplineCurves, LargestRateInTimeIsThatOfTheWorseHalf) {
  // |k2 - k1| / 1.5 m = 0.8 / m2, and the other way round.
  EXPECT_NEAR(LargestRateInTime(kSpline, 0.07, InDistance()), 0.056, 1e-15);
  EXPECT_NEAR(LargestRateInTime({0.8, -0.4, 0.2, 3.0}, 0.07, InDistance()), 0.056, 1e-15);
}

TEST(SplineCurves, AgreeWithKnownAnswers) {
  ASSERT_EQ(KnownAnswers("two_segment").size(), 30u);
  for (const core::JsonValue& known : KnownAnswers("two_segment")) {
    const Spline spline{Number(known, "kappa0"), Number(known, "kappa_mid"),
                        Number(known, "kappa1"), Number(known, "L")};
    const ClothoidPoint end = OnSpline(spline, spline.length_m, InDistance());
    ExpectNear(end, {Number(known, "x"), Number(known, "y"), Number(known, "theta")}, 3e-12);
  }
}

// What the curvature says, summed up in steps of 0.05 mm at their middles: the error of the sums is
// of the order of h^2 L / 24, 1e-10 m.
TEST(SplineCurves, PlacesFollowTheCurvature) {
  for (const CurvatureLaw& law : {InDistance(), InTime()}) {
    const double step_m = 5e-5;
    ClothoidPoint sum;
    for (int i = 0; i < 80000; ++i) {
      if (i % 4000 == 0) {
        const ClothoidPoint place = OnSpline(kSpline, i * step_m, law);
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
    const ClothoidPoint end = OnSpline(kSpline, 3.4, law);
    for (const std::vector<double>& stops :
         {std::vector<double>{0.0, 0.7, 0.7, 3.4}, {0.0, 1.5, 3.0, 3.4}, {0.0, 1.2, 3.3, 3.4}}) {
      ClothoidPoint place;
      for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        place = AlongSpline(place, kSpline, stops[i], stops[i + 1], law);
      }
      ExpectNear(place, end, 4e-12);
    }
  }
  EXPECT_THROW(OnSpline(kSpline, -0.1, InDistance()), core::ContractViolation);
  EXPECT_THROW(AlongSpline({}, kSpline, 1.0, 0.9, InDistance()), core::ContractViolation);
}

}  // namespace
}  // namespace rockyard::navigation

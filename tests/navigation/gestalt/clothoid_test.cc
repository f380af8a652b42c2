// Clothoids against Fresnel integrals, quadrature, arcs, themselves and the known answers of
// tests/data/clothoids; splines of two knots.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/json_file.h"
#include "core/json_value.h"
#include "core/random.h"
#include "navigation/gestalt/curvature_law.h"

namespace rockyard::navigation {
namespace {

double Number(const core::JsonValue& known, std::string_view key) {
  const core::JsonValue* found = known.Find(key);
  if (found == nullptr) throw std::out_of_range(std::string(key));
  return found->number();
}

void ExpectNear(const math::Pose2& found, const math::Pose2& known, double error) {
  EXPECT_NEAR(found.x_m, known.x_m, error);
  EXPECT_NEAR(found.y_m, known.y_m, error);
  EXPECT_NEAR(found.heading_rad, known.heading_rad, error);
}

// One of the lists "fresnel", "clothoid" and "two_segment".
const core::JsonValue::List& KnownAnswers(std::string_view list) {
  static const core::JsonValue document =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/clothoids/known_answers.json");
  return document.Find(list)->list();
}

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

// The speed law of curves, and curvature that is linear in time at its speed.

constexpr double kHalf_m = 1.5;

// Full speed up to 0.4 / m, a quarter of it from 1.2 / m on.
constexpr SpeedLawParams kSlow{
    .full_speed_curvature_per_m = 0.4, .min_speed_share = 0.25, .slow_curvature_per_m = 1.2};

// From knot to knot through all kinds of curves, either way, and hardly changing in each kind.
const std::vector<std::pair<double, double>> kKnots = {
    {0.0, 0.3},  {-0.9, 1.1},   {1.5, -1.4}, {0.1, 2.0},   {0.5, 1.0},   {-1.0, -0.5},
    {0.4, 1.2},  {-0.4, -1.3},  {0.0, 0.8},  {-0.8, 0.0},  {0.7, 0.7},   {0.7, 0.7 + 1e-9},
    {1.3, 1.31}, {0.2, 0.2001}, {0.0, 0.0},  {-1.2, -0.4}, {-0.41, 1.19}};

TEST(SpeedLaw, FallsLinearlyBetweenTheTwoCurvatures) {
  EXPECT_EQ(SpeedShare(kSlow, 0.0), 1.0);
  EXPECT_EQ(SpeedShare(kSlow, 0.4), 1.0);
  EXPECT_NEAR(SpeedShare(kSlow, 0.8), 0.625, 1e-15);
  EXPECT_NEAR(SpeedShare(kSlow, 1.0), 1.0 - 0.75 * 0.75, 1e-15);
  EXPECT_EQ(SpeedShare(kSlow, 1.2), 0.25);
  EXPECT_EQ(SpeedShare(kSlow, 5.0), 0.25);
  for (const double c : {0.1, 0.5, 0.9, 3.0})
    EXPECT_EQ(SpeedShare(kSlow, -c), SpeedShare(kSlow, c));
}

// The rover slows down only where it is asked to.
TEST(SpeedLaw, IsFullSpeedByDefault) {
  for (const double c : {0.0, 0.5, 0.75, 1.0, 9.0}) EXPECT_EQ(SpeedShare({}, c), 1.0);
}

TEST(CurvatureLaw, InTheDistanceIsLinear) {
  const CurvatureLaw law(SplineLaw::kDistance, kSlow);
  for (const auto& [from, to] : kKnots) {
    for (const double share : {0.0, 0.3, 1.0}) {
      EXPECT_NEAR(law.Between(from, to, share), from + share * (to - from), 1e-15);
      EXPECT_NEAR(law.RateBetween(from, to, share, kHalf_m), (to - from) / kHalf_m, 1e-15);
    }
  }
}

// The time t(s) = int ds / p(c(s)), by Simpson's rule in steps of 0.2 mm, grows linearly with c.
// Its error is that of the steps with a corner of p, of the order of 1 / (12 n^2) = 1e-9 and dp/dc
// times dc/ds of that, up to 30 here.
TEST(CurvatureLaw, InTimeIsLinearInTime) {
  const CurvatureLaw law(SplineLaw::kTime, kSlow);
  constexpr int kSteps = 7500;
  for (const auto& [from, to] : kKnots) {
    SCOPED_TRACE(testing::Message() << from << " to " << to);
    EXPECT_NEAR(law.Between(from, to, 0.0), from, 1e-15);
    EXPECT_NEAR(law.Between(from, to, 1.0), to, 1e-15);
    const auto slowness = [&, from = from, to = to](double share) {
      return 1.0 / SpeedShare(kSlow, law.Between(from, to, share));
    };
    std::vector<double> times{0.0};
    for (int i = 0; i < kSteps; ++i) {
      times.push_back(times.back() +
                      (slowness(1.0 * i / kSteps) + 4.0 * slowness((i + 0.5) / kSteps) +
                       slowness((i + 1.0) / kSteps)) /
                          (6.0 * kSteps));
    }
    for (int i = 0; i <= kSteps; i += 500) {
      const double linear = from + (to - from) * times[static_cast<std::size_t>(i)] / times.back();
      EXPECT_NEAR(law.Between(from, to, 1.0 * i / kSteps), linear, 1e-7);
    }
  }
}

TEST(CurvatureLaw, RateIsTheDerivative) {
  for (const SplineLaw kind : {SplineLaw::kDistance, SplineLaw::kTime}) {
    const CurvatureLaw law(kind, kSlow);
    for (const auto& [from, to] : kKnots) {
      for (const double share : {0.13, 0.37, 0.71, 0.93}) {
        const double step = 1e-6;
        const double slope =
            (law.Between(from, to, share + step) - law.Between(from, to, share - step)) /
            (2.0 * step * kHalf_m);
        EXPECT_NEAR(law.RateBetween(from, to, share, kHalf_m), slope, 1e-5) << from << " " << to;
      }
    }
  }
}

TEST(CurvatureLaw, LargestRateInTimeIsThatOfThePath) {
  const double speed_m_s = 0.07;
  for (const SplineLaw kind : {SplineLaw::kDistance, SplineLaw::kTime}) {
    const CurvatureLaw law(kind, kSlow);
    for (const auto& [from, to] : kKnots) {
      double largest = 0.0;
      for (int i = 0; i <= 10000; ++i) {
        const double share = i / 10000.0;
        // dc/dt = dc/ds v p(c).
        largest =
            std::max(largest, std::abs(law.RateBetween(from, to, share, kHalf_m)) * speed_m_s *
                                  SpeedShare(kSlow, law.Between(from, to, share)));
      }
      EXPECT_NEAR(law.LargestRateInTime(from, to, kHalf_m, speed_m_s), largest, 1e-3 * largest);
    }
  }
}

// At full speed everywhere, by the speed law or as no curve is tight enough, time is distance.
TEST(CurvatureLaw, TimeIsDistanceAtConstantSpeed) {
  const CurvatureLaw distance(SplineLaw::kDistance, kSlow);
  SpeedLawParams never = kSlow;
  never.min_speed_share = 1.0;
  const CurvatureLaw steady(SplineLaw::kTime, never);
  SpeedLawParams gentle = kSlow;
  gentle.full_speed_curvature_per_m = 2.5;
  gentle.slow_curvature_per_m = 3.0;
  const CurvatureLaw tight(SplineLaw::kTime, gentle);
  for (const auto& [from, to] : kKnots) {
    const math::Pose2 end = distance.Along({}, from, to, kHalf_m);
    for (const CurvatureLaw* law : {&steady, &tight}) {
      EXPECT_NEAR(law->Between(from, to, 0.4), distance.Between(from, to, 0.4), 1e-14);
      const math::Pose2 other = law->Along({}, from, to, kHalf_m);
      ExpectNear(other, end, 1e-13);
    }
  }
  const CurvatureLaw time(SplineLaw::kTime, kSlow);
  EXPECT_GT(std::abs(time.Between(0.1, 2.0, 0.4) - distance.Between(0.1, 2.0, 0.4)), 0.05);
}

// A path in time by another integral: over the curvature, ds = p(c) dc / a with a = dF/ds, where
// the heading is a polynomial of each kind of curve and where there is no root. Simpson's rule in
// 2000 intervals between the curvatures at which the kind changes.
class PathOverCurvature {
 public:
  explicit PathOverCurvature(const SpeedLawParams& speed) : speed_(speed) {}

  math::Pose2 End(double from, double to, double length) const {
    const double a = (Moment(0, to) - Moment(0, from)) / length;
    const double full = speed_.full_speed_curvature_per_m;
    const double slow = speed_.slow_curvature_per_m;
    std::vector<double> stops = {from, to};
    for (const double edge : {-slow, -full, full, slow}) {
      if (std::min(from, to) < edge && edge < std::max(from, to)) stops.push_back(edge);
    }
    std::sort(stops.begin(), stops.end());
    math::Pose2 end;
    // A path towards the right has a < 0 and descends: ds = p |dc| / |a|.
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      constexpr int kIntervals = 2000;
      for (int k = 0; k <= kIntervals; ++k) {
        const double c = stops[i] + (stops[i + 1] - stops[i]) * k / kIntervals;
        const double heading = (Moment(1, c) - Moment(1, from)) / a;
        const bool at_end = k == 0 || k == kIntervals;
        const double weight = (at_end ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0)) *
                              (stops[i + 1] - stops[i]) / (3.0 * kIntervals) *
                              SpeedShare(speed_, c) / std::abs(a);
        end.x_m += weight * std::cos(heading);
        end.y_m += weight * std::sin(heading);
      }
    }
    end.heading_rad = (Moment(1, to) - Moment(1, from)) / a;
    return end;
  }

 private:
  // int_0^c c^n p dc for n = 0 and 1; odd and even in c.
  double Moment(int n, double c) const {
    const double full = speed_.full_speed_curvature_per_m;
    const double slow = speed_.slow_curvature_per_m;
    const double slope = (1.0 - speed_.min_speed_share) / (slow - full);
    const auto power = [n](double x, int more) { return std::pow(x, n + more) / (n + more); };
    const double size = std::abs(c);
    const double d = std::min(size, slow);
    double moment = power(std::min(size, full), 1);
    if (size > full) {
      // p = 1 + slope full - slope c.
      moment += (1.0 + slope * full) * (power(d, 1) - power(full, 1)) -
                slope * (power(d, 2) - power(full, 2));
    }
    if (size > slow) moment += speed_.min_speed_share * (power(size, 1) - power(slow, 1));
    return n == 0 && c < 0.0 ? -moment : moment;
  }

  SpeedLawParams speed_;
};

void ExpectPathsAgree(const SpeedLawParams& speed, double from, double to, double length) {
  SCOPED_TRACE(testing::Message() << from << " to " << to << " in " << length << ", p "
                                  << speed.min_speed_share);
  const math::Pose2 found = CurvatureLaw(SplineLaw::kTime, speed).Along({}, from, to, length);
  const math::Pose2 known = PathOverCurvature(speed).End(from, to, length);
  // The comparison divides by a: 1e-16 / (to - from).
  const double error = length * (1e-12 + 1e-14 / std::abs(to - from));
  ExpectNear(found, known, error);
}

TEST(CurvatureLaw, PathsInTimeAgreeWithAnotherIntegral) {
  for (const auto& [from, to] : kKnots) {
    if (std::abs(to - from) > 1e-3) ExpectPathsAgree(kSlow, from, to, kHalf_m);
  }
  core::RandomStream random({32, 0}, core::Purpose::kTest, 0);
  for (int i = 0; i < 300; ++i) {
    const double from = 4.0 * random.Uniform() - 2.0;
    const double to = 4.0 * random.Uniform() - 2.0;
    if (std::abs(to - from) < 0.01) continue;
    SpeedLawParams speed;
    speed.full_speed_curvature_per_m = random.Uniform();
    speed.slow_curvature_per_m = speed.full_speed_curvature_per_m + 0.01 + 1.5 * random.Uniform();
    speed.min_speed_share = 0.05 + 0.95 * random.Uniform();
    ExpectPathsAgree(speed, from, to, 0.05 + 3.0 * random.Uniform());
  }
  // A long way round, while it slows down and not by much.
  ExpectPathsAgree(kSlow, 0.62, 0.5, 12.0);
  // The slowest, slow from the straight line on.
  ExpectPathsAgree(
      {.full_speed_curvature_per_m = 0.0, .min_speed_share = 0.05, .slow_curvature_per_m = 1.0},
      -1.0, 1.0, 3.0);
}

// Where the curvature hardly changes the path is an arc of it.
TEST(CurvatureLaw, PathsInTimeOfOneCurvatureAreArcs) {
  const CurvatureLaw law(SplineLaw::kTime, kSlow);
  for (const double c : {-1.3, -0.8, 0.3, 0.8, 1.3}) {
    const math::Pose2 arc = AlongClothoid({}, c, 0.0, kHalf_m);
    for (const double to : {c, c + 1e-15, c + 1e-13}) {
      const math::Pose2 end = law.Along({}, c, to, kHalf_m);
      ExpectNear(end, arc, 1e-12);
    }
  }
}

TEST(CurvatureLaw, MirroredCurvaturesGiveTheMirroredPath) {
  const CurvatureLaw law(SplineLaw::kTime, kSlow);
  for (const auto& [from, to] : kKnots) {
    const math::Pose2 end = law.Along({}, from, to, kHalf_m);
    const math::Pose2 mirrored = law.Along({}, -from, -to, kHalf_m);
    EXPECT_EQ(mirrored.x_m, end.x_m);
    EXPECT_EQ(mirrored.y_m, -end.y_m);
    EXPECT_EQ(mirrored.heading_rad, -end.heading_rad);
  }
}

TEST(CurvatureLaw, BreaksOffWhereACurvatureIsNotANumber) {
  const CurvatureLaw law(SplineLaw::kTime, kSlow);
  EXPECT_TRUE(std::isnan(law.Along({}, 0.0, std::nan(""), 1.0).x_m));
  EXPECT_THROW(law.Along({}, 0.0, 1.0, -1.0), core::ContractViolation);
}

}  // namespace
}  // namespace rockyard::navigation

// Names and defaults of the splines' parameters, and what a user may not set.
#include <gmock/gmock.h>

#include "core/params_text.h"
#include "core/says.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/speed_law.h"

namespace rockyard::navigation {
namespace {

using testing::HasSubstr;

constexpr auto& Problems = core::ProblemsOf<GestaltParams>;

TEST(GestaltSplineParams, DefaultsAreThoseOfHoward2012) {
  // Section 3: 225 splines of 3 m, knots within +-1 rad/m.
  core::ExpectPublished<GestaltParams>(
      {{"splines.length_m", "3.0"}, {"splines.max_curvature_per_m", "1.0"}});
  const GestaltSplineParams splines;
  EXPECT_EQ(splines.num_first_knots * splines.num_second_knots, 225);
}

// The limit is what steering motors of 20 deg/s (athena_2012.json) keep up with at the tightest
// knots, d delta / dc of a wheel at (0.42, 0.36) m, less a tenth.
TEST(GestaltSplineParams, RateIsThatOfTheSteeringMotors) {
  const GestaltSplineParams splines;
  const double c = splines.max_curvature_per_m;
  const auto angle = [](double curvature) {
    return std::atan2(0.42 * curvature, 1.0 - 0.36 * curvature);
  };
  const double slope_m = (angle(c + 1e-6) - angle(c - 1e-6)) / 2e-6;
  const double limit = math::DegToRad(20.0) / slope_m;
  EXPECT_NEAR(splines.max_curvature_rate_per_m_s, 0.9 * limit, 0.02);
}

// From knot to knot: 2 / m in 14 spaces, over 1.5 m. A single knot has no next one.
TEST(GestaltSplineParams, LeastRateIsThatFromAKnotToTheNext) {
  GestaltSplineParams splines;
  EXPECT_NEAR(splines.LeastRate_per_m2(), 2.0 / 14.0 / 1.5, 1e-15);
  splines.num_first_knots = 2;
  EXPECT_NEAR(splines.LeastRate_per_m2(), 2.0 / 1.5, 1e-15);
  splines.num_first_knots = 1;
  EXPECT_EQ(splines.LeastRate_per_m2(), 0.0);
}

// Path, reason, and what would be right.
TEST(GestaltSplineParams, RefuseWhatCannotBeDriven) {
  EXPECT_THAT(Problems(R"({"splines": {"waypoint_m": 3.1}})"),
              core::Says("splines.waypoint_m", "beyond the end of the splines",
                         "use a smaller waypoint_m or a larger length_m"));
  EXPECT_EQ(Problems(R"({"splines": {"waypoint_m": 3.1, "length_m": 3.1}})"), "");
  EXPECT_THAT(Problems(R"({"speed": {"full_speed_curvature_per_m": 1.0}})"),
              core::Says("speed.slow_curvature_per_m", "not larger than full_speed_curvature_per_m",
                         "use a larger slow_curvature_per_m"));
  EXPECT_EQ(Problems(R"({"speed": {"full_speed_curvature_per_m": 0.99}})"), "");
  EXPECT_THAT(Problems(R"({"speed": {"min_speed_share": 0}})"),
              core::Says("speed.min_speed_share", "smallest allowed value"));
  EXPECT_THAT(Problems(R"({"speed": {"min_speed_share": 1.1}})"),
              HasSubstr("largest allowed value"));
  EXPECT_THAT(Problems(R"({"splines": {"length_m": 0}})"),
              core::Says("splines.length_m", "smallest allowed value"));
  EXPECT_THAT(Problems(R"({"splines": {"num_first_knots": 0}})"),
              HasSubstr("splines.num_first_knots"));
  EXPECT_THAT(Problems(R"({"splines": {"num_second_knots": 52}})"),
              HasSubstr("splines.num_second_knots"));
  EXPECT_THAT(Problems(R"({"splines": {"max_curvature_per_m": 0}})"),
              HasSubstr("splines.max_curvature_per_m"));
  EXPECT_THAT(Problems(R"({"splines": {"max_curvature_rate_per_m_s": 0}})"),
              HasSubstr("splines.max_curvature_rate_per_m_s"));
  EXPECT_THAT(Problems(R"({"splines": {"law": "curvature"}})"),
              core::Says("splines.law", "distance", "time"));
}

}  // namespace
}  // namespace rockyard::navigation

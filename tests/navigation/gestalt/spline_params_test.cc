// Names and defaults of the splines' parameters, and what a user may not set.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/archive.h"
#include "core/json_text.h"
#include "core/params_text.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/speed_law.h"

namespace rockyard::navigation {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr auto& Read = core::ReadText<GestaltParams>;
constexpr auto& Problems = core::ProblemsOf<GestaltParams>;

TEST(GestaltSplineParams, DefaultsAreThoseOfHoward2012) {
  // Section 3: 225 splines of 3 m, knots within +-1 rad/m.
  const std::vector<std::pair<std::string, std::string>> published = {
      {"splines.length_m", "3.0"}, {"splines.max_curvature_per_m", "1.0"}};
  const core::FieldTable fields = core::ListParams<GestaltParams>();
  for (const auto& [path, value] : published) {
    const auto found =
        std::find_if(fields.parameters().begin(), fields.parameters().end(),
                     [&path = path](const core::ParameterInfo& p) { return p.path == path; });
    ASSERT_NE(found, fields.parameters().end()) << path;
    EXPECT_EQ(core::DumpJson(found->value), value + "\n") << path;
    EXPECT_EQ(found->origin, core::Origin::kPublished) << path;
  }
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

TEST(GestaltSplineParams, SurviveARoundTrip) {
  GestaltParams params;
  params.splines.law = SplineLaw::kTime;
  params.splines.num_first_knots = 9;
  params.speed.min_speed_share = 0.5;
  const std::string json = core::DumpJson(core::WriteParams(params));
  EXPECT_EQ(core::DumpJson(core::WriteParams(Read(json))), json);
  EXPECT_THAT(json, AllOf(HasSubstr(R"("law": "time")"), HasSubstr(R"("num_first_knots": 9)"),
                          HasSubstr(R"("min_speed_share": 0.5)")));
}

// Path, reason, and what would be right.
TEST(GestaltSplineParams, RefuseWhatCannotBeDriven) {
  EXPECT_THAT(Problems(R"({"splines": {"waypoint_m": 3.1}})"),
              AllOf(HasSubstr("splines.waypoint_m"), HasSubstr("beyond the end of the splines"),
                    HasSubstr("use a smaller waypoint_m or a larger length_m")));
  EXPECT_EQ(Problems(R"({"splines": {"waypoint_m": 3.1, "length_m": 3.1}})"), "");
  EXPECT_THAT(Problems(R"({"speed": {"full_speed_curvature_per_m": 1.0}})"),
              AllOf(HasSubstr("speed.slow_curvature_per_m"),
                    HasSubstr("not larger than full_speed_curvature_per_m"),
                    HasSubstr("use a larger slow_curvature_per_m")));
  EXPECT_EQ(Problems(R"({"speed": {"full_speed_curvature_per_m": 0.99}})"), "");
  EXPECT_THAT(Problems(R"({"speed": {"min_speed_share": 0}})"),
              AllOf(HasSubstr("speed.min_speed_share"), HasSubstr("smallest allowed value")));
  EXPECT_THAT(Problems(R"({"speed": {"min_speed_share": 1.1}})"),
              HasSubstr("largest allowed value"));
  EXPECT_THAT(Problems(R"({"splines": {"length_m": 0}})"),
              AllOf(HasSubstr("splines.length_m"), HasSubstr("smallest allowed value")));
  EXPECT_THAT(Problems(R"({"splines": {"num_first_knots": 0}})"),
              HasSubstr("splines.num_first_knots"));
  EXPECT_THAT(Problems(R"({"splines": {"num_second_knots": 52}})"),
              HasSubstr("splines.num_second_knots"));
  EXPECT_THAT(Problems(R"({"splines": {"max_curvature_per_m": 0}})"),
              HasSubstr("splines.max_curvature_per_m"));
  EXPECT_THAT(Problems(R"({"splines": {"max_curvature_rate_per_m_s": 0}})"),
              HasSubstr("splines.max_curvature_rate_per_m_s"));
  EXPECT_THAT(Problems(R"({"splines": {"law": "curvature"}})"),
              AllOf(HasSubstr("splines.law"), HasSubstr("distance"), HasSubstr("time")));
}

}  // namespace
}  // namespace rockyard::navigation

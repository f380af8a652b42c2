#include "localization/sun_compass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/angles.h"

namespace rockyard::localization {
namespace {

using math::DegToRad;
constexpr int kHeading = messages::Index(messages::PoseCoordinate::kHeading);

messages::SunSighting SightedBy(const math::Transform& X_WR, const math::Vector3& sun_W) {
  messages::SunSighting sighting;
  sighting.capture = 3;
  sighting.sun_R = X_WR.linear().transpose() * sun_W;
  sighting.direction_sd_rad = DegToRad(0.5);
  return sighting;
}

math::Vector3 SunAt(double heading_rad, double elevation_rad) {
  return math::ToUnitVector({-heading_rad, elevation_rad}, 0.0);
}

TEST(SunCompass, FindsTheHeadingOfATiltedRover) {
  for (const double heading_deg : {-170.0, -30.0, 0.0, 75.0, 179.0}) {
    const math::Transform X_WR = math::MakePose(math::Vector3(1.0, 2.0, 0.1), DegToRad(heading_deg),
                                                DegToRad(8.0), DegToRad(-11.0));
    const math::Vector3 sun_W = SunAt(DegToRad(60.0), DegToRad(50.0));
    const auto fix =
        HeadingFromSun(SightedBy(X_WR, sun_W),
                       {.roll_rad = DegToRad(-11.0), .pitch_rad = DegToRad(8.0)}, sun_W, 0.0);
    EXPECT_NEAR(math::WrapAngle(fix.pose_W[kHeading] - DegToRad(heading_deg)), 0.0, 1e-12);
    EXPECT_EQ(fix.measured.count(), 1u);
    EXPECT_TRUE(fix.measured[kHeading]);
    EXPECT_EQ(fix.capture, 3);
  }
}

// A tilt of e about the horizontal direction to the sun that the rover does not know of shifts its
// azimuth by e tan(elevation); one across that direction shifts it not at all, to first order.
TEST(SunCompass, ErrsByTheTiltTimesTheTangentOfTheElevation) {
  constexpr double kTilt_rad = 1e-4;
  for (const double elevation_deg : {20.0, 45.0, 70.0}) {
    const double elevation_rad = DegToRad(elevation_deg);
    const math::Vector3 sun_W = SunAt(0.0, elevation_rad);  // straight ahead: x is the direction
    const auto rolled = math::MakePose(math::Vector3::Zero(), 0.0, 0.0, kTilt_rad);
    const auto pitched = math::MakePose(math::Vector3::Zero(), 0.0, kTilt_rad, 0.0);
    const auto by_roll = HeadingFromSun(SightedBy(rolled, sun_W), {}, sun_W, 0.0);
    const auto by_pitch = HeadingFromSun(SightedBy(pitched, sun_W), {}, sun_W, 0.0);
    EXPECT_NEAR(std::abs(by_roll.pose_W[kHeading]), kTilt_rad * std::tan(elevation_rad), 1e-7);
    EXPECT_NEAR(by_pitch.pose_W[kHeading], 0.0, 1e-7);
  }
}

TEST(SunCompass, KnowsItsVariance) {
  const double elevation_rad = DegToRad(40.0);
  const math::Vector3 sun_W = SunAt(0.3, elevation_rad);
  const auto fix =
      HeadingFromSun(SightedBy(math::Transform::Identity(), sun_W), {}, sun_W, DegToRad(2.0));
  const double across = DegToRad(0.5) / std::cos(elevation_rad);
  const double tilt = DegToRad(2.0) * std::tan(elevation_rad);
  EXPECT_NEAR(fix.covariance(kHeading, kHeading), across * across + tilt * tilt, 1e-12);
}

TEST(SunAlmanac, FollowsTheSunOverTheDay) {
  const SunAlmanac almanac{.latitude_rad = DegToRad(19.3),
                           .declination_rad = math::SunDeclination(DegToRad(142.7)),
                           .start_solar_time_h = 10.0,
                           .north_heading_rad = DegToRad(90.0)};
  const math::Vector3 morning = almanac.Sun_W(0.0);
  const math::Vector3 noon = almanac.Sun_W(2.0 / 24.0 * math::kSolOfMars_s);
  EXPECT_GT(morning.x(), 0.3);  // east, to the right of north, is +x
  EXPECT_NEAR(noon.x(), 0.0, 1e-9);
  EXPECT_GT(noon.z(), morning.z());
}

}  // namespace
}  // namespace rockyard::localization

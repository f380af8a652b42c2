#include "math/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rockyard::math {
namespace {

TEST(SunPosition, StandsHighestAtNoon) {
  // Elevation at noon: 90 deg less the distance of latitude and declination.
  const double declination = DegToRad(15.0);
  const SkyDirection south = SunPosition(DegToRad(40.0), declination, 12.0);
  EXPECT_NEAR(RadToDeg(south.elevation_rad), 65.0, 1e-9);
  EXPECT_NEAR(std::abs(RadToDeg(south.azimuth_rad)), 180.0, 1e-9);
  const SkyDirection north = SunPosition(DegToRad(-10.0), declination, 12.0);
  EXPECT_NEAR(RadToDeg(north.elevation_rad), 65.0, 1e-9);
  EXPECT_NEAR(RadToDeg(north.azimuth_rad), 0.0, 1e-9);
}

TEST(SunPosition, RisesInTheEastAtTheEquinox) {
  const SkyDirection morning = SunPosition(DegToRad(30.0), 0.0, 6.0);
  EXPECT_NEAR(morning.elevation_rad, 0.0, 1e-12);
  EXPECT_NEAR(RadToDeg(morning.azimuth_rad), 90.0, 1e-9);
  const SkyDirection evening = SunPosition(DegToRad(30.0), 0.0, 18.0);
  EXPECT_NEAR(RadToDeg(evening.azimuth_rad), -90.0, 1e-9);
}

// The day is 24 h - 2 acos(tan(phi) tan(delta)) / 15 deg long: an independent equation of sunrise.
TEST(SunPosition, RisesWhenTheDayBegins) {
  const double latitude = DegToRad(19.3);
  const double declination = SunDeclination(DegToRad(142.7));
  const double half_day_h = RadToDeg(std::acos(-std::tan(latitude) * std::tan(declination))) / 15.0;
  EXPECT_NEAR(SunPosition(latitude, declination, 12.0 - half_day_h).elevation_rad, 0.0, 1e-9);
  EXPECT_GT(half_day_h, 6.0);
}

TEST(SunDeclination, IsTheObliquityAtTheSolstices) {
  EXPECT_NEAR(RadToDeg(SunDeclination(DegToRad(90.0))), 25.19, 1e-9);
  EXPECT_NEAR(RadToDeg(SunDeclination(DegToRad(270.0))), -25.19, 1e-9);
  EXPECT_NEAR(SunDeclination(0.0), 0.0, 1e-15);
}

TEST(ToUnitVector, TurnsClockwiseFromNorth) {
  const Vector3 north = ToUnitVector({0.0, 0.0}, DegToRad(90.0));
  EXPECT_LT((north - Vector3(0.0, 1.0, 0.0)).norm(), 1e-12);
  const Vector3 east = ToUnitVector({DegToRad(90.0), 0.0}, DegToRad(90.0));
  EXPECT_LT((east - Vector3(1.0, 0.0, 0.0)).norm(), 1e-12);
  const Vector3 high = ToUnitVector({0.0, DegToRad(30.0)}, 0.0);
  EXPECT_LT((high - Vector3(std::cos(DegToRad(30.0)), 0.0, 0.5)).norm(), 1e-12);
}

}  // namespace
}  // namespace rockyard::math

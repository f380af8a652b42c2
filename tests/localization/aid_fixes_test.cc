#include "localization/aid_fixes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "math/angles.h"

namespace rockyard::localization {
namespace {

using math::DegToRad;

TEST(BeaconFix, LiesAtRangeAndBearingFromTheStation) {
  const auto fix = PlaceFromBeacon({.capture = 5,
                                    .station_x_m = 1.0,
                                    .station_y_m = -2.0,
                                    .range_m = 10.0,
                                    .bearing_rad = math::DegToRad(30.0),
                                    .range_sd_m = 1.0,
                                    .bearing_sd_rad = math::DegToRad(3.0)},
                                   {});
  EXPECT_EQ(fix.capture, 5);
  EXPECT_EQ(fix.measured.to_ulong(), 3u);  // x and y
  EXPECT_NEAR(fix.pose[0], 1.0 + 10.0 * std::cos(math::DegToRad(30.0)), 1e-12);
  EXPECT_NEAR(fix.pose[1], -2.0 + 5.0, 1e-12);
}

// Somewhere about `range_m` from the station in that direction, off by so much along it and across.
struct Somewhere {
  double range_m, along_sd_m, across_sd_m, bearing_sd_deg;

  static constexpr double kStationX_m = 3.0;
  static constexpr double kStationY_m = -7.0;

  Eigen::Matrix2d turn() const { return Eigen::Rotation2Dd(DegToRad(125.0)).toRotationMatrix(); }
  messages::BeaconReading Reading() const {
    return {.station_x_m = kStationX_m,
            .station_y_m = kStationY_m,
            .range_m = 1.0,
            .bearing_rad = 0.0,  // neither is reckoned with
            .range_sd_m = 1.0,
            .bearing_sd_rad = DegToRad(bearing_sd_deg)};
  }
  messages::LocalizationEstimate Belief() const {
    const Eigen::Vector2d place = turn() * Eigen::Vector2d(range_m, 0.0);
    const Eigen::Vector2d variances(along_sd_m * along_sd_m, across_sd_m * across_sd_m);
    messages::LocalizationEstimate belief;
    belief.pose.x_m = kStationX_m + place.x();
    belief.pose.y_m = kStationY_m + place.y();
    belief.covariance = messages::PoseCovariance::Zero();
    belief.covariance->topLeftCorner<2, 2>() = turn() * variances.asDiagonal() * turn().transpose();
    return belief;
  }
  // What is told, along and across.
  Eigen::Matrix2d Told(const messages::LocalizationEstimate& belief) const {
    return turn().transpose() *
           PlaceFromBeacon(Reading(), belief).covariance.topLeftCorner<2, 2>() * turn();
  }
  // Mean squares of what places are off by, along and across; 20000 know a variance to 1 %.
  Eigen::Array2d Found_m2() const {
    constexpr int kReadings = 20000;
    core::RandomStream stream({5, 0}, core::Purpose::kTest);
    Eigen::Array2d squares = Eigen::Array2d::Zero();
    for (int i = 0; i < kReadings; ++i) {
      const Eigen::Vector2d truth =
          turn() * Eigen::Vector2d(core::SampleNormal(stream, range_m, along_sd_m),
                                   core::SampleNormal(stream, 0.0, across_sd_m));
      messages::BeaconReading reading = Reading();
      reading.range_m = core::SampleNormal(stream, truth.norm(), reading.range_sd_m);
      reading.bearing_rad =
          core::SampleNormal(stream, std::atan2(truth.y(), truth.x()), reading.bearing_sd_rad);
      const Eigen::Vector2d place = PlaceFromBeacon(reading, {}).pose.head<2>();
      const Eigen::Vector2d off = place - Eigen::Vector2d(kStationX_m, kStationY_m) - truth;
      squares += (turn().transpose() * off).array().square();
    }
    return squares / kReadings;
  }
};

TEST(BeaconFix, HasTheSpreadOfItsReadings) {
  for (const Somewhere& at : {Somewhere{40.0, 0.0, 0.0, 3.0}, Somewhere{40.0, 8.0, 3.0, 1.0},
                              Somewhere{3.0, 0.2, 0.5, 8.0}}) {
    messages::LocalizationEstimate belief = at.Belief();
    const Eigen::Matrix2d told = at.Told(belief);
    const Eigen::Array2d found = at.Found_m2();
    EXPECT_NEAR(told(0, 0) / found[0], 1.0, 0.05) << at.range_m << " m, along";
    EXPECT_NEAR(told(1, 1) / found[1], 1.0, 0.05) << at.range_m << " m, across";
    EXPECT_NEAR(told(0, 1), 0.0, 1e-9);

    // Where the goals' frame is another one, the world's counts.
    belief.world = {.pose = belief.pose, .covariance = *belief.covariance};
    belief.pose = {.x_m = -7.0, .y_m = 90.0};
    belief.covariance = messages::PoseCovariance::Identity();
    EXPECT_EQ(at.Told(belief), told);
  }
  // The control: a belief that takes itself for exact.
  const Somewhere near{3.0, 0.2, 0.5, 8.0};
  messages::LocalizationEstimate sure = near.Belief();
  sure.covariance.reset();
  EXPECT_LT(near.Told(sure)(1, 1) / near.Found_m2()[1], 0.9);
}

TEST(BeaconFix, IsOfNoDirectionAtTheStation) {
  const auto fix = PlaceFromBeacon(
      {.range_m = 0.5, .bearing_rad = 0.3, .range_sd_m = 1.0, .bearing_sd_rad = 0.1}, {});
  EXPECT_NEAR(fix.covariance(0, 0), 0.5 * (1.0 + 0.01), 1e-12);
  EXPECT_NEAR(fix.covariance(1, 1), fix.covariance(0, 0), 1e-12);
  EXPECT_NEAR(fix.covariance(0, 1), 0.0, 1e-12);
}

constexpr int kHeading = messages::Index(messages::PoseCoordinate::kHeading);

messages::SunSighting SightedBy(const math::Transform& X_WR, const math::Vector3& sun_W) {
  return messages::SunSighting{
      .capture = 3, .sun_R = X_WR.linear().transpose() * sun_W, .direction_sd_rad = DegToRad(0.5)};
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
    EXPECT_NEAR(math::WrapAngle(fix.pose[kHeading] - DegToRad(heading_deg)), 0.0, 1e-12);
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
    EXPECT_NEAR(std::abs(by_roll.pose[kHeading]), kTilt_rad * std::tan(elevation_rad), 1e-7);
    EXPECT_NEAR(by_pitch.pose[kHeading], 0.0, 1e-7);
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

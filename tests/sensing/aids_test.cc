#include "sensing/aids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "math/angles.h"
#include "math/sun_position.h"
#include "noise_laws.h"
#include "perception/tracked_feature.h"
#include "sensing/stripe_scene.h"
#include "sensing/tracker.h"

namespace rockyard::sensing {
namespace {

using math::DegToRad;
using math::Vector3;
using messages::PoseCoordinate;

// The aids of localization: what they see, from where, and how well.

constexpr core::TrialKey kKey{20261125, 7};
constexpr int kMany = 4000;

// As high above the ground as it is deep in it.
terrain::Rock Boulder(double x_m, double y_m, double height_m) {
  return EllipsoidRock(x_m, y_m, 0.0, 0.3, 0.3, height_m);
}

constexpr int kHeading = messages::Index(PoseCoordinate::kHeading);

// The rover 8 m ahead of a lander at (2, 1) and 6 m to its left: 10 m away.
const LanderPlace kLander{.x_m = 2.0, .y_m = 1.0};
math::Transform Rover() { return PoseAt(10.0, 7.0, 0.0, DegToRad(40.0)); }

// Errors of a fix along and across the line of sight and of its heading, in their deviations.
std::vector<std::vector<double>> FixErrors(const LanderFixParams& params,
                                           const LanderPlace& lander) {
  std::vector<std::vector<double>> errors(3);
  const LanderFix camera(params, lander, kKey);
  for (int i = 0; i < kMany; ++i) {
    const auto fix = camera.Observe(Rover(), Flat(), i);
    const Eigen::Vector2d from(fix->pose[0] - 2.0, fix->pose[1] - 1.0);
    errors[0].push_back((from.norm() / 10.0 - 1.0) / 0.05);
    errors[1].push_back((std::atan2(from.y(), from.x()) - std::atan2(6.0, 8.0)) / 0.001);
    errors[2].push_back(math::WrapAngle(fix->pose[kHeading] - DegToRad(40.0)) / DegToRad(5.0));
  }
  return errors;
}

TEST(LanderFixTest, ErrsAsPublished) {
  const auto errors = FixErrors({}, kLander);
  for (const auto& error : errors) EXPECT_GT(core::KolmogorovP(error, NormalCdf), kAlpha);
  // The control: deviations a fifth larger show.
  std::vector<double> larger = errors[0];
  for (double& value : larger) value *= 1.2;
  EXPECT_LT(core::KolmogorovP(larger, NormalCdf), kAlpha);
}

TEST(LanderFixTest, TellsItsCovarianceAboutTheLineOfSight) {
  const auto fix = LanderFix({}, kLander, kKey).Observe(Rover(), Flat(), 0);
  const Eigen::Vector2d from(fix->pose[0] - 2.0, fix->pose[1] - 1.0);
  const Eigen::Vector2d along = from.normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  const Eigen::Matrix2d P = fix->covariance.topLeftCorner<2, 2>();
  EXPECT_NEAR(std::sqrt(along.dot(P * along)), 0.05 * from.norm(), 1e-9);
  EXPECT_NEAR(std::sqrt(across.dot(P * across)), 0.001 * from.norm(), 1e-9);
  EXPECT_NEAR(std::sqrt(fix->covariance(kHeading, kHeading)), DegToRad(5.0), 1e-12);
  EXPECT_EQ(fix->measured.count(), 3u);
}

TEST(LanderFixTest, IsTurnedByThePanError) {
  LanderPlace turned = kLander;
  turned.pan_error_rad = DegToRad(1.0);
  const auto right = LanderFix({}, kLander, kKey).Observe(Rover(), Flat(), 3);
  const auto wrong = LanderFix({}, turned, kKey).Observe(Rover(), Flat(), 3);
  const Eigen::Rotation2Dd turn(DegToRad(1.0));
  const Eigen::Vector2d station(2.0, 1.0);
  const Eigen::Vector2d expected = station + turn * (right->pose.head<2>() - station);
  EXPECT_LT((wrong->pose.head<2>() - expected).norm(), 1e-9);
  EXPECT_NEAR(wrong->pose[kHeading] - right->pose[kHeading], DegToRad(1.0), 1e-9);
  EXPECT_TRUE(wrong->in_lander_frame);
  EXPECT_FALSE(LanderFix({.shares_pan_error = false}, turned, kKey)
                   .Observe(Rover(), Flat(), 3)
                   ->in_lander_frame);
}

// What fixes have in common stays from number to number; all of it with a share of 1.
TEST(LanderFixTest, SharesWhatItIsTold) {
  LanderFixParams params{.common_share = 1.0};
  const LanderFix same(params, kLander, kKey);
  EXPECT_EQ(same.Observe(Rover(), Flat(), 0)->pose, same.Observe(Rover(), Flat(), 1)->pose);
  // A half: fixes of one trial correlate by a half over trials.
  params.common_share = 0.5;
  double product = 0.0, square = 0.0;
  for (std::uint32_t trial = 0; trial < kMany; ++trial) {
    const LanderFix camera(params, kLander, {5, trial});
    const double a = camera.Observe(Rover(), Flat(), 0)->pose[kHeading] - DegToRad(40.0);
    const double b = camera.Observe(Rover(), Flat(), 1)->pose[kHeading] - DegToRad(40.0);
    product += a * b;
    square += a * a;
  }
  EXPECT_NEAR(square / kMany / (DegToRad(5.0) * DegToRad(5.0)), 1.0, 0.09);
  EXPECT_NEAR(product / square, 0.5, 0.07);
}

TEST(LanderFixTest, EndsAtItsRangeAndBehindRocks) {
  LanderFixParams params{.range_m = 9.99};
  EXPECT_FALSE(LanderFix(params, kLander, kKey).Observe(Rover(), Flat(), 0));
  params.range_m = 10.01;
  EXPECT_TRUE(LanderFix(params, kLander, kKey).Observe(Rover(), Flat(), 0));
  // The line from 1.5 m to 0.3 m over 10 m passes 0.54 m high 2 m before the rover.
  const auto with_rock = [](double height_m) { return FlatWith({Boulder(8.4, 5.8, height_m)}); };
  EXPECT_TRUE(LanderFix(params, kLander, kKey).Observe(Rover(), with_rock(0.5), 0));
  EXPECT_FALSE(LanderFix(params, kLander, kKey).Observe(Rover(), with_rock(0.6), 0));
}

Vector3 SunAt(double heading_rad, double elevation_rad) {
  return math::ToUnitVector({-heading_rad, elevation_rad}, 0.0);
}

SunSensorParams Reliable() { return {.dropout_probability = 0.0}; }

TEST(SunSensorTest, SeesTheSunWhereItStands) {
  SunSensorParams params = Reliable();
  params.noise_sd_rad = 0.0;
  const math::Transform X_WR =
      math::MakePose(Vector3(1.0, 2.0, 0.0), DegToRad(100.0), DegToRad(5.0), DegToRad(-7.0));
  const Vector3 sun_W = SunAt(DegToRad(20.0), DegToRad(50.0));
  const auto sighting = SunSensor(params, kKey).Observe(X_WR, sun_W, Flat(), 0);
  ASSERT_TRUE(sighting);
  EXPECT_LT((X_WR.linear() * sighting->sun_R - sun_W).norm(), 1e-12);
  EXPECT_EQ(sighting->direction_sd_rad, 0.0);
}

// Noise of 0.5 deg in the zenith, exp(depth / 2) times as much at 30 deg.
TEST(SunSensorTest, IsNoisierTheLowerTheSun) {
  const SunSensor sensor(Reliable(), kKey);
  EXPECT_NEAR(sensor.DirectionSd_rad(1.0), DegToRad(0.5), 1e-12);
  EXPECT_NEAR(sensor.DirectionSd_rad(0.5), DegToRad(0.5) * std::exp(0.25), 1e-12);
  const Vector3 sun_W = SunAt(0.3, DegToRad(30.0));
  const double sd_rad = DegToRad(0.5) * std::exp(0.25);
  const Vector3 side = Vector3::UnitZ().cross(sun_W).normalized();
  const Vector3 up = sun_W.cross(side);
  std::vector<double> sideways, upwards;
  for (int i = 0; i < kMany; ++i) {
    const auto sighting = sensor.Observe(math::Transform::Identity(), sun_W, Flat(), i);
    sideways.push_back(std::asin(sighting->sun_R.dot(side)) / sd_rad);
    upwards.push_back(std::asin(sighting->sun_R.dot(up)) / sd_rad);
  }
  EXPECT_GT(core::KolmogorovP(sideways, NormalCdf), kAlpha);
  EXPECT_GT(core::KolmogorovP(upwards, NormalCdf), kAlpha);
  for (double& value : upwards) value *= 1.2;
  EXPECT_LT(core::KolmogorovP(upwards, NormalCdf), kAlpha);
}

TEST(SunSensorTest, SeesNothingOutsideOfItsView) {
  const SunSensor sensor(Reliable(), kKey);
  const auto sees = [&](double elevation_deg, double pitch_deg) {
    const auto X_WR = math::MakePose(Vector3::Zero(), 0.0, DegToRad(pitch_deg), 0.0);
    return sensor.Observe(X_WR, SunAt(0.0, DegToRad(elevation_deg)), Flat(), 0).has_value();
  };
  EXPECT_TRUE(sees(15.1, 0.0));  // 150 deg of view
  EXPECT_FALSE(sees(14.9, 0.0));
  EXPECT_TRUE(sees(10.0, 10.0));  // nose down, towards the sun
  EXPECT_FALSE(sees(20.0, -10.0));
  EXPECT_FALSE(sees(-5.0, 25.0));  // below the horizon, whatever the rover does
}

TEST(SunSensorTest, IsShadedByRocksAndDropsOut) {
  const Vector3 sun_W = SunAt(0.0, DegToRad(30.0));
  // The ray passes 0.3 + 2 tan 30 deg = 1.45 m high 2 m ahead.
  const SunSensor sensor(Reliable(), kKey);
  const math::Transform X_WR = math::Transform::Identity();
  EXPECT_TRUE(sensor.Observe(X_WR, sun_W, FlatWith({Boulder(2.0, 0.0, 1.4)}), 0));
  EXPECT_FALSE(sensor.Observe(X_WR, sun_W, FlatWith({Boulder(2.0, 0.0, 1.6)}), 0));
  const SunSensorParams params{.dropout_probability = 0.2};
  int lost = 0;
  for (int i = 0; i < kMany; ++i) {
    lost += SunSensor(params, kKey).Observe(X_WR, sun_W, Flat(), i) ? 0 : 1;
  }
  EXPECT_NEAR(lost, 0.2 * kMany, 4.0 * std::sqrt(0.16 * kMany));
}

TEST(RadioBeaconTest, MeasuresRangeAndBearingFromTheLander) {
  const RadioBeaconParams params;
  const RadioBeacon beacon(params, kLander, kKey);
  std::vector<double> ranges, bearings;
  for (int i = 0; i < kMany; ++i) {
    const auto reading = beacon.Observe(Rover(), i);
    ranges.push_back((reading->range_m - 10.0) / params.range_sd_m);
    bearings.push_back((reading->bearing_rad - std::atan2(6.0, 8.0)) / params.bearing_sd_rad);
  }
  EXPECT_GT(core::KolmogorovP(ranges, NormalCdf), kAlpha);
  EXPECT_GT(core::KolmogorovP(bearings, NormalCdf), kAlpha);
  for (double& value : bearings) value *= 1.2;
  EXPECT_LT(core::KolmogorovP(bearings, NormalCdf), kAlpha);
  const auto reading = beacon.Observe(Rover(), 0);
  EXPECT_EQ(reading->station_x_m, 2.0);
  EXPECT_EQ(reading->station_y_m, 1.0);
  EXPECT_EQ(reading->range_sd_m, params.range_sd_m);
  EXPECT_EQ(reading->bearing_sd_rad, params.bearing_sd_rad);
}

TEST(RadioBeaconTest, IsHeardAsFarAsItReaches) {
  EXPECT_TRUE(RadioBeacon({.range_m = 10.01}, kLander, kKey).Observe(Rover(), 0));
  EXPECT_FALSE(RadioBeacon({.range_m = 9.99}, kLander, kKey).Observe(Rover(), 0));
  // Next to the station noise never makes a range negative.
  const RadioBeacon beacon({.range_sd_m = 5.0}, kLander, kKey);
  for (int i = 0; i < 100; ++i) EXPECT_GE(beacon.Observe(PoseAt(2.1, 1.0, 0.0), i)->range_m, 0.0);
}

// The tracked goal: what is seen, from where, and how well.

constexpr core::TrialKey kTrackerKey{20261123, 4};

FeatureTrackerParams AllRound() {
  return {.enabled = true,
          .range_m = 10.0,
          .half_field_of_view_rad = std::numbers::pi,
          .bearing_sd_rad = 0.0,
          .range_sd_fraction = 0.0};
}

// The sighting, composed with the true pose, is the feature again: on all sides, with headings
// around the turn.
TEST(FeatureTrackerTest, WithoutErrorsItLeadsBackToTheFeature) {
  const FeatureTracker tracker(AllRound(), kTrackerKey);
  for (int heading_deg = -175; heading_deg <= 180; heading_deg += 5) {
    for (int side_deg = -180; side_deg < 180; side_deg += 15) {
      const math::Pose2 rover{-3.0, 2.0, math::DegToRad(heading_deg)};
      const double side_rad = math::DegToRad(side_deg);
      const double x_m = rover.x_m + 4.0 * std::cos(side_rad);
      const double y_m = rover.y_m + 4.0 * std::sin(side_rad);
      const auto sighting = tracker.Observe(rover, x_m, y_m, 0);
      ASSERT_TRUE(sighting);
      EXPECT_NEAR(sighting->range_m, 4.0, 1e-12);
      EXPECT_LE(std::abs(sighting->bearing_rad), std::numbers::pi);
      EXPECT_NEAR(math::WrapAngle(side_rad - rover.heading_rad - sighting->bearing_rad), 0.0,
                  1e-12);
      const messages::Goal place = perception::PlaceOf(
          *sighting, {.x_m = rover.x_m, .y_m = rover.y_m, .heading_rad = rover.heading_rad});
      EXPECT_NEAR(place.x_m, x_m, 1e-12);
      EXPECT_NEAR(place.y_m, y_m, 1e-12);
    }
  }
}

// A pose that is wrong by a shift and a turn shifts and turns the believed place with it: as seen
// from the rover it is right.
TEST(FeatureTrackerTest, ThePlaceIsRightAsSeenFromTheRover) {
  const auto sighting =
      FeatureTracker(AllRound(), kTrackerKey).Observe({1.0, 0.0, 0.3}, 4.0, 1.5, 0);
  ASSERT_TRUE(sighting);
  const messages::PoseEstimate believed{.x_m = -2.0, .y_m = 7.0, .heading_rad = 2.9};
  const messages::Goal place = perception::PlaceOf(*sighting, believed);
  const double dx_m = place.x_m - believed.x_m;
  const double dy_m = place.y_m - believed.y_m;
  EXPECT_NEAR(std::hypot(dx_m, dy_m), std::hypot(3.0, 1.5), 1e-12);
  EXPECT_NEAR(math::WrapAngle(std::atan2(dy_m, dx_m) - believed.heading_rad),
              std::atan2(1.5, 3.0) - 0.3, 1e-12);
}

TEST(FeatureTrackerTest, SeesUpToItsRangeAndTheEdgesOfItsView) {
  FeatureTrackerParams params = AllRound();
  params.range_m = 5.0;
  params.half_field_of_view_rad = math::DegToRad(45.0);
  params.bearing_sd_rad = 0.5;  // what is seen goes by the true place, not by the measured one
  const FeatureTracker tracker(params, kTrackerKey);
  const auto sees = [&](double range_m, double bearing_deg, double heading_deg) {
    const double heading_rad = math::DegToRad(heading_deg);
    const double direction_rad = heading_rad + math::DegToRad(bearing_deg);
    return tracker
        .Observe({1.0, -1.0, heading_rad}, 1.0 + range_m * std::cos(direction_rad),
                 -1.0 + range_m * std::sin(direction_rad), 7)
        .has_value();
  };
  for (const double heading_deg : {0.0, 90.0, 170.0, -170.0}) {
    EXPECT_TRUE(sees(4.99, 0.0, heading_deg));
    EXPECT_FALSE(sees(5.01, 0.0, heading_deg));
    for (const double side : {-1.0, 1.0}) {
      EXPECT_TRUE(sees(2.0, 44.9 * side, heading_deg));
      EXPECT_FALSE(sees(2.0, 45.1 * side, heading_deg));
      EXPECT_FALSE(sees(2.0, 135.0 * side, heading_deg));
    }
    EXPECT_FALSE(sees(2.0, 180.0, heading_deg));
  }
  EXPECT_TRUE(FeatureTracker(AllRound(), kTrackerKey).Observe({1.0, 1.0, 0.4}, 1.0, 1.0, 0))
      << "above the feature itself";
}

// Kolmogorov and Smirnov at alpha each, 4000 samples.
TEST(FeatureTrackerTest, ErrorsAreNormalAndIndependent) {
  FeatureTrackerParams params = AllRound();
  params.bearing_sd_rad = math::DegToRad(0.5);
  params.range_sd_fraction = 0.02;
  const FeatureTracker tracker(params, kTrackerKey);
  std::vector<double> bearing, range;
  double product = 0.0;
  constexpr int kSamples = 4000;
  for (int sample = 0; sample < kSamples; ++sample) {
    const auto sighting = tracker.Observe({}, 0.0, 6.0, sample);
    ASSERT_TRUE(sighting);
    bearing.push_back((sighting->bearing_rad - math::DegToRad(90.0)) / params.bearing_sd_rad);
    range.push_back((sighting->range_m / 6.0 - 1.0) / params.range_sd_fraction);
    product += bearing.back() * range.back();
  }
  EXPECT_GT(core::KolmogorovP(bearing, NormalCdf), kAlpha);
  EXPECT_GT(core::KolmogorovP(range, NormalCdf), kAlpha);
  // The mean product of two independent standard normals has the deviation 1 / sqrt(n).
  const double correlation = product / std::sqrt(static_cast<double>(kSamples));
  EXPECT_GT(2.0 * NormalCdf(-std::abs(correlation)), kAlpha);
  // Negative control: a bearing known 20 % worse.
  for (double& z : bearing) z *= 1.2;
  EXPECT_LT(core::KolmogorovP(bearing, NormalCdf), kAlpha);
}

TEST(FeatureTrackerTest, NoiseGoesByTheNumberOfTheSample) {
  FeatureTrackerParams params = AllRound();
  params.bearing_sd_rad = 0.01;
  const FeatureTracker tracker(params, kTrackerKey);
  const auto first = tracker.Observe({}, 3.0, 0.0, 5);
  tracker.Observe({}, 3.0, 0.0, 6);
  EXPECT_EQ(tracker.Observe({}, 3.0, 0.0, 5)->bearing_rad, first->bearing_rad);
  EXPECT_NE(tracker.Observe({}, 3.0, 0.0, 6)->bearing_rad, first->bearing_rad);
  EXPECT_NE(FeatureTracker(params, {kTrackerKey.seed, 5}).Observe({}, 3.0, 0.0, 5)->bearing_rad,
            first->bearing_rad);
  // One error shifts no other.
  params.bearing_sd_rad = 0.0;
  params.range_sd_fraction = 0.02;
  const auto with = FeatureTracker(params, kTrackerKey).Observe({}, 3.0, 0.0, 5);
  params.bearing_sd_rad = 0.01;
  EXPECT_EQ(FeatureTracker(params, kTrackerKey).Observe({}, 3.0, 0.0, 5)->range_m, with->range_m);
}

// Errors that are large against the quantities: angles stay wrapped, ranges are never negative.
TEST(FeatureTrackerTest, LargeErrorsStayInTheirDomains) {
  FeatureTrackerParams params = AllRound();
  params.bearing_sd_rad = math::DegToRad(45.0);
  params.range_sd_fraction = 0.5;
  const FeatureTracker tracker(params, kTrackerKey);
  int at_zero = 0;
  bool wrapped = false;
  for (int sample = 0; sample < 2000; ++sample) {
    const auto sighting = tracker.Observe({}, -2.0, 0.1, sample);
    ASSERT_TRUE(sighting);
    EXPECT_LE(std::abs(sighting->bearing_rad), std::numbers::pi);
    EXPECT_GE(sighting->range_m, 0.0);
    at_zero += sighting->range_m == 0.0 ? 1 : 0;
    wrapped = wrapped || sighting->bearing_rad < 0.0;
  }
  EXPECT_TRUE(wrapped) << "the feature is almost behind, on the left";
  // Two deviations below the mean: 2.28 % of 2000 are 46, five deviations of it are 33.
  EXPECT_NEAR(at_zero, 46, 33);
}

}  // namespace
}  // namespace rockyard::sensing

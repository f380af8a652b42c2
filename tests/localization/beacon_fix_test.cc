#include "localization/beacon_fix.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/distributions.h"
#include "core/random.h"
#include "math/angles.h"

namespace rockyard::localization {
namespace {

TEST(BeaconFix, LiesAtRangeAndBearingFromTheStation) {
  const auto fix = PlaceFromBeacon({.capture = 5,
                                    .station_x_m = 1.0,
                                    .station_y_m = -2.0,
                                    .range_m = 10.0,
                                    .bearing_rad = math::DegToRad(30.0),
                                    .range_sd_m = 1.0,
                                    .bearing_sd_rad = math::DegToRad(3.0)});
  EXPECT_EQ(fix.capture, 5);
  EXPECT_EQ(fix.measured.to_ulong(), 3u);  // x and y
  EXPECT_NEAR(fix.pose_W[0], 1.0 + 10.0 * std::cos(math::DegToRad(30.0)), 1e-12);
  EXPECT_NEAR(fix.pose_W[1], -2.0 + 5.0, 1e-12);
}

// Against the spread of places that noisy readings give; 20000 of them know a variance to 1 %.
TEST(BeaconFix, HasTheSpreadOfItsReadings) {
  constexpr int kReadings = 20000;
  const messages::BeaconReading truth{.range_m = 40.0,
                                      .bearing_rad = math::DegToRad(125.0),
                                      .range_sd_m = 1.0,
                                      .bearing_sd_rad = math::DegToRad(3.0)};
  core::RandomStream stream({5, 0}, core::Purpose::kTest);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (int i = 0; i < kReadings; ++i) {
    messages::BeaconReading reading = truth;
    reading.range_m = core::SampleNormal(stream, truth.range_m, truth.range_sd_m);
    reading.bearing_rad = core::SampleNormal(stream, truth.bearing_rad, truth.bearing_sd_rad);
    const Eigen::Vector2d place = PlaceFromBeacon(reading).pose_W.head<2>();
    sum += place;
    squares += place * place.transpose();
  }
  const Eigen::Vector2d mean = sum / kReadings;
  const Eigen::Matrix2d spread = squares / kReadings - mean * mean.transpose();
  const Eigen::Matrix2d told = PlaceFromBeacon(truth).covariance.topLeftCorner<2, 2>();
  EXPECT_LT((spread - told).norm() / told.norm(), 0.04);
  // The control: the axes the wrong way round.
  EXPECT_GT((spread - Eigen::Matrix2d(told.reverse())).norm() / told.norm(), 0.3);
}

}  // namespace
}  // namespace rockyard::localization

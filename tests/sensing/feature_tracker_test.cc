// The tracked goal: what is seen, from where, and how well.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "math/angles.h"
#include "noise_laws.h"
#include "perception/tracked_feature.h"
#include "sensing/tracker.h"

namespace rockyard::sensing {
namespace {

constexpr core::TrialKey kKey{20261123, 4};

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
  const FeatureTracker tracker(AllRound(), kKey);
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
  const auto sighting = FeatureTracker(AllRound(), kKey).Observe({1.0, 0.0, 0.3}, 4.0, 1.5, 0);
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
  const FeatureTracker tracker(params, kKey);
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
  EXPECT_TRUE(FeatureTracker(AllRound(), kKey).Observe({1.0, 1.0, 0.4}, 1.0, 1.0, 0))
      << "above the feature itself";
}

// Kolmogorov and Smirnov at alpha each, 4000 samples.
TEST(FeatureTrackerTest, ErrorsAreNormalAndIndependent) {
  FeatureTrackerParams params = AllRound();
  params.bearing_sd_rad = math::DegToRad(0.5);
  params.range_sd_fraction = 0.02;
  const FeatureTracker tracker(params, kKey);
  std::vector<double> bearing;
  std::vector<double> range;
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
  const FeatureTracker tracker(params, kKey);
  const auto first = tracker.Observe({}, 3.0, 0.0, 5);
  tracker.Observe({}, 3.0, 0.0, 6);
  EXPECT_EQ(tracker.Observe({}, 3.0, 0.0, 5)->bearing_rad, first->bearing_rad);
  EXPECT_NE(tracker.Observe({}, 3.0, 0.0, 6)->bearing_rad, first->bearing_rad);
  EXPECT_NE(FeatureTracker(params, {kKey.seed, 5}).Observe({}, 3.0, 0.0, 5)->bearing_rad,
            first->bearing_rad);
  // One error shifts no other.
  params.bearing_sd_rad = 0.0;
  params.range_sd_fraction = 0.02;
  const auto with = FeatureTracker(params, kKey).Observe({}, 3.0, 0.0, 5);
  params.bearing_sd_rad = 0.01;
  EXPECT_EQ(FeatureTracker(params, kKey).Observe({}, 3.0, 0.0, 5)->range_m, with->range_m);
}

// Errors that are large against the quantities: angles stay wrapped, ranges are never negative.
TEST(FeatureTrackerTest, LargeErrorsStayInTheirDomains) {
  FeatureTrackerParams params = AllRound();
  params.bearing_sd_rad = math::DegToRad(45.0);
  params.range_sd_fraction = 0.5;
  const FeatureTracker tracker(params, kKey);
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

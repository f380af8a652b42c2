// Range points as an elevation array, and stripes as range points.
#include "perception/cloud_elevations.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "perception/hazard_detector.h"

namespace rockyard::perception {
namespace {

using math::Vector3;
using messages::LookDirection;
using messages::PointCloud;

// Bins of 0.25 x 0.2 m from 0.4 m on; a single point is enough.
CloudElevationParams Bins() {
  return {.near_m = 0.4, .far_m = 1.4, .half_width_m = 0.5, .quantile = 1.0, .min_points = 1};
}

// A point every 2 cm, at heights z(x, y).
template <typename Height>
PointCloud Ground(Height height) {
  PointCloud cloud;
  for (double x = 0.31; x < 1.6; x += 0.02) {
    for (double y = -0.79; y < 0.8; y += 0.02) cloud.points_R.emplace_back(x, y, height(x, y));
  }
  return cloud;
}

TEST(CloudElevationsTest, EachPointCountsInItsBin) {
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t stripe = 0; stripe < 5; ++stripe) {
      PointCloud cloud;
      cloud.number = 9;
      // Just within the bin's far right corner; stripes count from the left.
      cloud.points_R = {{0.4 + 0.25 * static_cast<double>(row + 1) - 1e-6,
                         0.5 - 0.2 * static_cast<double>(stripe + 1) + 1e-6, 0.03}};
      const messages::ElevationScan scan = CloudElevations(cloud, {}, Bins());
      EXPECT_EQ(scan.number, 9);
      ASSERT_EQ(scan.points.rows(), 4U);
      ASSERT_EQ(scan.points.stripes(), 5U);
      for (std::size_t i = 0; i < 20; ++i) {
        const messages::ElevationPoint& point = scan.points.points()[i];
        EXPECT_EQ(point.detected, i == 5 * row + stripe);
        EXPECT_EQ(point.elevation_m, point.detected ? 0.03 : 0.0);
      }
    }
  }
}

TEST(CloudElevationsTest, PointsBesideTheGroundDoNotCount) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  PointCloud cloud;
  cloud.points_R = {{0.39, 0.0, 1.0},  {1.41, 0.0, 1.0}, {0.7, 0.51, 1.0},
                    {0.7, -0.51, 1.0}, {-0.7, 0.0, 1.0}, {kNan, 0.0, 1.0}};
  const messages::ElevationScan scan = CloudElevations(cloud, {}, Bins());
  for (const auto& point : scan.points.points()) {
    EXPECT_FALSE(point.detected);
  }
}

TEST(CloudElevationsTest, AQuantileIsTheSmallestHeightThatEnoughPointsDoNotExceed) {
  PointCloud cloud;
  for (const double z : {0.5, 0.1, 0.4, 0.2, 0.3}) cloud.points_R.emplace_back(0.5, 0.0, z);
  CloudElevationParams params = Bins();
  const auto elevation = [&] {
    return CloudElevations(cloud, {}, params).points[0][2].elevation_m;
  };
  EXPECT_EQ(elevation(), 0.5);
  params.quantile = 0.8;
  EXPECT_EQ(elevation(), 0.4);
  params.quantile = 0.5;
  EXPECT_EQ(elevation(), 0.3);
  params.quantile = 0.0;
  EXPECT_EQ(elevation(), 0.1);
  params.min_points = 5;
  EXPECT_TRUE(CloudElevations(cloud, {}, params).points[0][2].detected);
  params.min_points = 6;
  EXPECT_FALSE(CloudElevations(cloud, {}, params).points[0][2].detected);
}

TEST(CloudElevationsTest, WhatLiesBehindIsSeenAsByARoverTurnedAround) {
  const PointCloud ahead = Ground([](double x, double y) { return 0.1 * x * x + 0.2 * y; });
  PointCloud behind = ahead;
  behind.direction = LookDirection::kBehind;
  for (Vector3& p : behind.points_R) p = {-p.x(), -p.y(), p.z()};
  const messages::ElevationScan seen = CloudElevations(behind, {}, Bins());
  const messages::ElevationScan expected = CloudElevations(ahead, {}, Bins());
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(seen.points.points()[i].elevation_m, expected.points.points()[i].elevation_m);
  }
}

TEST(CloudElevationsTest, LevelGroundIsFlatForARoverThatTiltsAndKnowsIt) {
  // The ground plane z_W = 0 as points of a rover pitched by 10 degrees and rolled by 5.
  const messages::AttitudeEstimate attitude{.roll_rad = math::DegToRad(5.0),
                                            .pitch_rad = math::DegToRad(10.0)};
  const math::Transform X_WR =
      math::MakePose(Vector3::Zero(), 0.0, attitude.pitch_rad, attitude.roll_rad);
  PointCloud cloud = Ground([](double, double) { return 0.0; });
  for (Vector3& p : cloud.points_R) p = X_WR.inverse() * p;
  CloudElevationParams params = Bins();
  const messages::ElevationScan scan = CloudElevations(cloud, attitude, params);
  for (const auto& point : scan.points.points()) {
    EXPECT_TRUE(point.detected);
    EXPECT_NEAR(point.elevation_m, 0.0, 1e-12);
  }
  EXPECT_FALSE(ReportHazards(CloudElevations(cloud, attitude, params), {}).any());
  // As the light stripe sensor has it, the same ground is a hazard.
  params.frame = ElevationFrame::kRover;
  EXPECT_TRUE(ReportHazards(CloudElevations(cloud, attitude, params), {}).any());
}

TEST(CloudElevationsTest, SlopesRaiseNeighbourDifferencesWithTheSpacingOfBins) {
  // Highest points of neighbouring bins of a slope differ by spacing x tangent: 0.25 x 0.2 = 5 cm.
  const auto scan = [](double tangent) {
    return CloudElevations(Ground([=](double x, double) { return tangent * x; }), {}, Bins());
  };
  const messages::ElevationScan slope = scan(0.19);
  // Points lie 2 cm apart.
  EXPECT_NEAR(slope.points[1][2].elevation_m - slope.points[0][2].elevation_m, 0.25 * 0.19, 0.004);
  HazardParams criteria;
  criteria.range_threshold_m = 1.0;
  EXPECT_FALSE(ReportHazards(scan(0.17), criteria).any());
  EXPECT_TRUE(ReportHazards(scan(0.23), criteria).any());
  criteria.neighbour_threshold_m = 0.1;
  EXPECT_FALSE(ReportHazards(scan(0.23), criteria).any());
}

TEST(CloudElevationsTest, ParametersThatLeaveNoGroundAreRefused) {
  for (const char* json : {R"({"far_m": 0.2})", R"({"half_width_m": 0})", R"({"rows": 1})",
                           R"({"stripes": 10})", R"({"quantile": 1.1})", R"({"min_points": 0})"}) {
    CloudElevationParams params;
    EXPECT_THROW(core::ReadParams(core::ParseJson(json, "test"), params), core::UserError) << json;
  }
}

// Two cameras looking down at 45 degrees, as in triangulation_test.cc, and one fan straight ahead.
messages::StripeCalibration Calibration() {
  messages::StripeCalibration calibration;
  for (messages::Camera& camera : calibration.cameras) {
    camera.X_RC = math::MakePose({0.27, 0.06, 0.25}, 0.0, math::DegToRad(45.0), 0.0);
    camera.column_pitch_rad = 0.0024;
    camera.row_pitch_rad = 0.0028;
    camera.columns = 768;
    camera.rows = 484;
  }
  calibration.scanline_px = {0, -100};
  messages::StripeLaser laser;
  laser.p_RoE_R = {0.27, 0.0, 0.25};
  calibration.lasers = {laser};
  calibration.datum_z_m = 0.02;
  return calibration;
}

TEST(StripeCloudTest, PointsAreThoseWhoseElevationsAreKnown) {
  const Triangulator triangulator(Calibration());
  messages::StripeScan scan{.number = 4,
                            .pixels = messages::StripeArray<messages::StripePixel>({2, 1})};
  scan.pixels[0][0] = {.detected = true, .column_px = 70.0};
  const PointCloud cloud = StripeCloud(scan, triangulator);
  EXPECT_EQ(cloud.number, 4);
  ASSERT_EQ(cloud.points_R.size(), 1U);
  const auto elevations = triangulator.Elevations(scan);
  EXPECT_NEAR(cloud.points_R[0].z() - 0.02, elevations.points[0][0].elevation_m, 1e-12);
  EXPECT_NEAR(cloud.points_R[0].y(), 0.0, 1e-12);  // in the light plane
  EXPECT_GT(cloud.points_R[0].x(), 0.27);
}

}  // namespace
}  // namespace rockyard::perception

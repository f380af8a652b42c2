#include "sensing/stereo_ground_truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sensing/sun_shade.h"
#include "stereo_scene.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::LookDirection;

rendering::SunParams SunAt(double elevation_deg, double azimuth_deg) {
  return {.elevation_rad = math::DegToRad(elevation_deg),
          .azimuth_rad = math::DegToRad(azimuth_deg)};
}

StereoTruth TruthOf(const StereoParams& params, const terrain::Terrain& terrain,
                    const rendering::SunParams& sun = SunAt(60, 90), int window_px = 7,
                    const rover::RoverGeometryParams& rover = {}) {
  return StereoGroundTruth(params, sun, rover, window_px)
      .See(terrain, PoseAt(0, 0, 0), LookDirection::kAhead);
}

// The plane z = 0: a ray from the eye at height h with the downward component s of its direction
// meets it at depth h / s along the axis, so d = f B s / h.
TEST(StereoGroundTruthTest, LevelGroundHasThePlanesDisparities) {
  StereoParams params{.max_range_m = 20.0};
  const StereoView view = MakeStereoView(params, LookDirection::kAhead);
  const StereoTruth truth = TruthOf(params, FlatWith({}));
  for (const auto& [row, column] : {std::pair{40, 64}, {64, 100}, {100, 30}, {127, 64}}) {
    const double down = -view.Ray(column, row).z();
    const double disparity_px = params.focal_columns_px() * params.baseline_m * down / 0.45;
    EXPECT_NEAR(truth.left_px(row, column), disparity_px, 1e-9);
    EXPECT_NEAR(truth.both_px(row, column), disparity_px, 1e-9);
    EXPECT_EQ(truth.rocks(row, column), -1);
    EXPECT_GE(truth.jumps(row, column), 10000);
    EXPECT_FALSE(truth.shaded(row, column));
  }
  // Above the horizon, 45 degrees above the axis, there is nothing.
  EXPECT_EQ(truth.left_px(0, 64), 0.0);
  // What the left eye sees at its left edge lies outside of the right image.
  EXPECT_GT(truth.left_px(100, 2), 0.0);
  EXPECT_EQ(truth.both_px(100, 2), 0.0);
}

// The end of the range is no jump in depth, the edge of a rock is one.
TEST(StereoGroundTruthTest, OnlySurfacesMakeJumps) {
  StereoParams params{.max_range_m = 2.0};
  const StereoTruth bare = TruthOf(params, FlatWith({}));
  EXPECT_GE(bare.jumps.minCoeff(), 10000);
  const StereoTruth truth =
      TruthOf(params, FlatWith({EllipsoidRock(1.2, 0.0, 0.0, 0.2, 0.2, 0.4)}));
  bool beside_rock = true;
  int edges = 0;
  for (int row = 0; row < 128; ++row) {
    for (int column = 1; column < 128; ++column) {
      if (truth.jumps(row, column) != 1) continue;
      ++edges;
      // The rock stands before everything else.
      EXPECT_EQ(truth.behind(row, column), truth.rocks(row, column) != 0);
      const int from = std::max(column - 1, 0);
      const int to = std::min(column + 1, 127);
      beside_rock = beside_rock && (truth.rocks(row, from) == 0 || truth.rocks(row, column) == 0 ||
                                    truth.rocks(row, to) == 0);
    }
  }
  EXPECT_GT(edges, 20);
  EXPECT_TRUE(beside_rock);
}

// A window of side w reaches w / 2 beyond its pixel, and one pixel more is asked for.
TEST(StereoGroundTruthTest, MarginsAreWhereAWindowReachesOverAnEdge) {
  StereoParams params;
  params.front.height_m = 1.0;  // above the rover, whose parts are out of view
  params.front.ahead_m = 0.6;
  params.max_range_m = 20.0;
  for (const int window_px : {5, 7}) {
    const int reach = window_px / 2 + 1;
    const StereoTruth truth = TruthOf(params, FlatWith({}), SunAt(60, 90), window_px);
    for (int row = 60; row < 128; ++row) {
      for (int column = 0; column < 128; ++column) {
        const double disparity_px = truth.both_px(row, column);
        if (disparity_px <= 0.0) continue;
        const double right = std::round(column - disparity_px);
        const bool margin = row > 127 - reach || column > 127 - reach || right < reach;
        EXPECT_EQ(truth.margin(row, column), margin) << row << " " << column;
      }
    }
  }
}

TEST(StereoGroundTruthTest, TheRoversOwnPartsAreMargins) {
  StereoParams params{.front = {.pitch_rad = math::DegToRad(60.0)}};
  params.front.ahead_m = 0.0;  // over the middle of the rover
  params.front.height_m = 0.8;
  const StereoTruth truth = TruthOf(params, FlatWith({}));
  const StereoView view = MakeStereoView(params, LookDirection::kAhead);
  // The ray that meets the ground at R's origin goes through the rover.
  int under = 0;
  for (int row = 0; row < 128; ++row) {
    for (int column = 20; column < 108; ++column) {
      if (truth.both_px(row, column) <= 0.0) continue;
      const Vector3 ray = view.Ray(column, row);
      const Vector3 p = view.eye + ray * (view.eye.z() / -ray.z());
      if (std::abs(p.x()) > 0.15 || std::abs(p.y()) > 0.1) continue;
      ++under;
      EXPECT_TRUE(truth.margin(row, column));
    }
  }
  EXPECT_GT(under, 20);
}

// A rock of height h shades level ground for h / tan(elevation) behind it, and no farther.
TEST(StereoGroundTruthTest, ARockShadesTheGroundBehindIt) {
  const terrain::Terrain terrain = FlatWith({EllipsoidRock(2.0, 0.0, 0.0, 0.02, 0.02, 0.5)});
  // The sun stands to the right (-y), 45 degrees high: the shadow falls to the left, 0.5 m long.
  const SunShade shade(SunAt(45, -90), {});
  const auto shaded = [&](double x_m, double y_m) {
    const terrain::RayHit hit{.point_W = {x_m, y_m, 0.0}, .normal_W = Vector3::UnitZ()};
    return shade.IsShaded(terrain, PoseAt(0, 0, 0), hit);
  };
  EXPECT_TRUE(shaded(2.0, 0.1));
  EXPECT_TRUE(shaded(2.0, 0.45));
  EXPECT_FALSE(shaded(2.0, 0.52));
  EXPECT_FALSE(shaded(2.0, -0.1));
  EXPECT_FALSE(shaded(2.1, 0.1));
  // The rover, 0.48 m wide, shades the ground on its left.
  EXPECT_TRUE(shaded(0.0, 0.3));
  EXPECT_FALSE(shaded(0.0, 1.0));
  // Surfaces that turn away have no sun.
  terrain::RayHit away{.point_W = {4.0, 0.0, 0.3}, .normal_W = Vector3::UnitY()};
  EXPECT_TRUE(shade.IsShaded(terrain, PoseAt(0, 0, 0), away));
  away.normal_W = -Vector3::UnitY();
  EXPECT_FALSE(shade.IsShaded(terrain, PoseAt(0, 0, 0), away));
}

// Pixels are shaded where their surface is.
TEST(StereoGroundTruthTest, PixelsShowTheShadow) {
  StereoParams params;
  const terrain::Terrain terrain = FlatWith({EllipsoidRock(1.5, 0.0, 0.0, 0.1, 0.1, 0.3)});
  const StereoTruth truth = TruthOf(params, terrain, SunAt(30, -90));
  const StereoView view = MakeStereoView(params, LookDirection::kAhead);
  int left = 0, right = 0;
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 128; ++column) {
      if (truth.left_px(row, column) <= 0.0 || truth.rocks(row, column) >= 0) continue;
      const Vector3 ray = view.Ray(column, row);
      const Vector3 p = view.eye + ray * (view.eye.z() / -ray.z());
      if (std::abs(p.x() - 1.5) > 0.03) continue;
      if (p.y() > 0.12 && p.y() < 0.4) {
        ++left;
        EXPECT_TRUE(truth.shaded(row, column)) << p.y();
      }
      if (p.y() < -0.12 && p.y() > -0.4) {
        ++right;
        EXPECT_FALSE(truth.shaded(row, column)) << p.y();
      }
    }
  }
  EXPECT_GT(left, 10);
  EXPECT_GT(right, 10);
}

}  // namespace
}  // namespace rockyard::sensing

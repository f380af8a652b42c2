#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sensing/stereo_ground_truth.h"
#include "sensing/sun_shade.h"
#include "stereo_scene.h"
#include "terrain/rock.h"
#include "vision/each_pixel.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::LookDirection;
using messages::PointCloud;

// Closed forms of what a stereo pair sees: surfaces, field of view, blind zone, rounding,
// occlusion.

// Cameras that look straight ahead, at a wall square to them.
StereoParams LevelCameras(StereoParams params) {
  params.front = {.ahead_m = 0.0, .height_m = 2.0, .pitch_rad = 0.0};
  params.vertical_fov_rad = math::DegToRad(60.0);
  params.max_range_m = 20.0;
  return params;
}

terrain::Terrain WallAt(double x_m, std::vector<terrain::Rock> rocks = {}) {
  return FlatWith(std::move(rocks), {{Vector3::UnitX(), x_m}});
}

// Depth along the axis of level cameras at the chassis centre is x.
double DisparityOf(const StereoParams& params, double depth_m) {
  return params.focal_columns_px() * params.baseline_m / depth_m;
}

// The pair's rays are those of the one camera model, scaled to depth 1.
TEST(StereoGeometryTest, RaysAreThoseOfAPinhole) {
  const StereoParams params;
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    const StereoView view = MakeStereoView(params, direction);
    messages::Camera camera{.lens = messages::Lens::kPinhole,
                            .column_pitch_rad = 1.0 / params.focal_columns_px(),
                            .row_pitch_rad = 1.0 / params.focal_rows_px()};
    const auto& mount = direction == LookDirection::kAhead ? params.front : params.rear;
    const double heading = direction == LookDirection::kAhead ? 0.0 : std::numbers::pi;
    camera.X_RC = Eigen::AngleAxisd(heading, Vector3::UnitZ()) *
                  Eigen::AngleAxisd(mount.pitch_rad, Vector3::UnitY());
    for (const double row : {0.0, 40.0, 127.0}) {
      for (const double column : {0.0, 63.5, 127.0}) {
        const Vector3 expected_R =
            camera.X_RC.linear() * vision::PixelRay(camera, {column - 63.5, row - 63.5});
        EXPECT_LT((view.Ray(column, row).normalized() - expected_R).norm(), 1e-14);
      }
    }
  }
}

TEST(StereoGeometryTest, IdealPointsLieOnTheSurface) {
  const terrain::Rock rock = EllipsoidRock(1.2, 0.1, 0.05, 0.2, 0.15, 0.1, 0.7);
  const terrain::RockShape shape(rock);
  const math::Transform X_WR = math::MakePose({0.1, -0.2, 0.03}, 0.2, -0.05, 0.08);
  const PointCloud cloud = LookAhead(IdealStereo(), FlatWith({rock}), X_WR);
  int on_rock = 0;
  for (const Vector3& p_R : cloud.points_R) {
    const Vector3 p_W = X_WR * p_R;
    const double outside_rock = shape.Map(p_W - rock.center_W).norm() - 1.0;
    const bool is_rock = std::abs(outside_rock) < 1e-9;
    on_rock += is_rock;
    EXPECT_TRUE(is_rock || std::abs(p_W.z()) < 1e-9);
    EXPECT_GT(outside_rock, -1e-9);
  }
  EXPECT_GT(on_rock, 100);
  EXPECT_GT(cloud.points_R.size(), 8000U);
}

TEST(StereoGeometryTest, FootprintOnFlatGroundIsThatOfTheFieldOfView) {
  // Pixel (c, r) looks u = (c - 63.5) / f columns to the right and v rows down, at depth
  // Z = h / (sin p + v cos p): on the ground x = x0 + Z (cos p - v sin p), y = -Z u.
  const StereoParams params = IdealStereo();
  const auto& [ahead_m, height_m, pitch_rad] = params.front;
  std::vector<Vector3> expected;
  for (int row = 0; row < params.rows; ++row) {
    const double v = (row - 63.5) / params.focal_rows_px();
    const double depth_m = height_m / (std::sin(pitch_rad) + v * std::cos(pitch_rad));
    for (int column = 0; column < params.columns; ++column) {
      const double u = (column - 63.5) / params.focal_columns_px();
      if (depth_m <= 0.0 || depth_m * std::hypot(1.0, u, v) > params.max_range_m) continue;
      const double x_m = ahead_m + depth_m * (std::cos(pitch_rad) - v * std::sin(pitch_rad));
      expected.emplace_back(x_m, -depth_m * u, 0.0);
    }
  }
  const PointCloud cloud = LookAhead(params, FlatWith({}), PoseAt(0, 0, 0));
  ASSERT_EQ(cloud.points_R.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_LT((cloud.points_R[i] - expected[i]).norm(), 1e-9);
  }
}

TEST(StereoGeometryTest, BlindZoneEndsWhereTheDisparitySearchDoes) {
  StereoParams params = NoiselessStereo();
  params.max_disparity_px = 8.0;
  const auto& [ahead_m, height_m, pitch_rad] = params.front;
  const double nearest_depth_m = DisparityOf(params, 1.0) / params.max_disparity_px;
  // Depth of flat ground at x: (x - x0) cos p + h sin p.
  const double nearest_x_m =
      ahead_m + (nearest_depth_m - height_m * std::sin(pitch_rad)) / std::cos(pitch_rad);
  double nearest_seen_m = 10.0;
  for (const Vector3& p_R : LookAhead(params, FlatWith({}), PoseAt(0, 0, 0)).points_R) {
    nearest_seen_m = std::min(nearest_seen_m, p_R.x());
  }
  EXPECT_GE(nearest_seen_m, nearest_x_m);
  EXPECT_LT(nearest_seen_m, nearest_x_m + 0.03);  // a row's ground there is 2 cm long
}

TEST(StereoGeometryTest, DepthsAreThoseOfRoundedDisparities) {
  StereoParams params = NoiselessStereo();
  params.disparity_step_px = 0.25;
  const math::Transform X_WR = PoseAt(0, 0, 0);
  const StereoView view = MakeStereoView(params, LookDirection::kAhead);
  const Vector3 axis = view.along_column.cross(view.along_row).normalized();
  for (const Vector3& p_R : LookAhead(params, FlatWith({}), X_WR).points_R) {
    const double depth_m = std::abs(axis.dot(p_R - view.eye));
    const double steps = DisparityOf(params, depth_m) / 0.25;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
    // A ray of flat ground keeps its direction: its true depth is where it meets z = 0.
    const Vector3 ray = (p_R - view.eye) / depth_m;
    const double true_px = DisparityOf(params, -view.eye.z() / ray.z());
    EXPECT_LE(std::abs(0.25 * steps - true_px), 0.125 + 1e-9);
  }
}

TEST(StereoGeometryTest, RightImageEndsOneDisparityBeforeTheLeftOne) {
  // Of a wall at depth Z the first f b / Z columns of the left image lie left of the right one.
  const StereoParams params = LevelCameras(NoiselessStereo());
  const double disparity_px = DisparityOf(params, 1.0);
  ASSERT_NEAR(disparity_px, 5.4, 0.1);
  EXPECT_EQ(LookAhead(params, WallAt(1.0), PoseAt(0, 0, 0)).points_R.size(), 128U * (128U - 5U));
}

// Columns of the middle row, from the left, that show no point.
std::vector<int> MissingInMiddleRow(const StereoParams& params, const terrain::Terrain& terrain) {
  const StereoView view = MakeStereoView(params, LookDirection::kAhead);
  const StereoScene scene(terrain, view, params.max_range_m);
  DepthImage image = scene.InverseDepths();
  scene.HideFromRightEye(image);
  std::vector<int> missing;
  for (int column = 0; column < view.columns; ++column) {
    if (image(view.rows / 2, column) <= 0.0) missing.push_back(column);
  }
  return missing;
}

TEST(StereoGeometryTest, StripHiddenBehindAPlateIsThatOfSimilarTriangles) {
  // A plate at depth Z1 before a wall at Z2 hides b (Z2 - Z1) / Z1 of the wall from the right eye
  // alone: f b (1 / Z1 - 1 / Z2) columns left of the plate.
  StereoParams params = LevelCameras(NoiselessStereo());
  params.columns = 512;
  const double near_m = 1.0;
  const double far_m = 3.0;
  const terrain::Rock plate = EllipsoidRock(near_m, 0.0, 2.0, 1e-4, 0.25, 0.25);
  const std::vector<int> missing = MissingInMiddleRow(params, WallAt(far_m, {plate}));
  const double f = params.focal_columns_px();
  const double plate_left_px = 256.0 - f * (0.25 - 0.5 * params.baseline_m) / near_m;
  const double strip_px = DisparityOf(params, near_m) - DisparityOf(params, far_m);
  const double outside_px = DisparityOf(params, far_m);
  const auto strip = std::count_if(missing.begin(), missing.end(),
                                   [&](int column) { return column > outside_px; });
  EXPECT_GT(strip_px, 10.0);
  EXPECT_NEAR(static_cast<double>(strip), strip_px, 1.0);
  EXPECT_EQ(missing.back(), static_cast<int>(std::lround(plate_left_px)) - 1);
  EXPECT_NEAR(static_cast<double>(missing.size()), outside_px + strip_px, 2.0);
}

TEST(StereoGeometryTest, RowsThatRunThroughARockBesideTheCamerasAreComplete) {
  // The line through the eye along its rows meets the rock: its outline is no ellipse.
  StereoParams params = LevelCameras(IdealStereo());
  const terrain::Rock rock = EllipsoidRock(0.3, 0.9, 2.0, 0.6, 0.5, 0.5);
  const StereoView view = MakeStereoView(params, LookDirection::kAhead);
  const RockOutline outline(terrain::RockShape(rock), rock.center_W, view, view.eye);
  ASSERT_FALSE(outline.ContainsEye());
  ASSERT_FALSE(outline.Row(64.0).exact);
  const terrain::Terrain terrain = WallAt(5.0, {rock});
  const DepthImage image = StereoScene(terrain, view, params.max_range_m).InverseDepths();
  for (int column = 0; column < view.columns; ++column) {
    const Vector3 ray = view.Ray(column, 64);
    const auto hit = terrain.CastRay(view.eye, ray.normalized(), params.max_range_m);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(1.0 / image(64, column), hit->distance_m / ray.norm(), 1e-9);
  }
  EXPECT_LT(1.0 / image(64, 0), 1.0);    // the rock on the left
  EXPECT_GT(1.0 / image(64, 127), 4.9);  // the wall on the right
}

TEST(StereoGeometryTest, CamerasInsideSomethingSeeNothing) {
  const StereoParams params = NoiselessStereo();
  const terrain::Rock around = EllipsoidRock(0.4, 0.0, 0.45, 0.3, 0.3, 0.3);
  EXPECT_TRUE(LookAhead(params, FlatWith({around}), PoseAt(0, 0, 0)).points_R.empty());
  EXPECT_TRUE(LookAhead(params, FlatWith({}), PoseAt(0, 0, -0.5)).points_R.empty());
  const terrain::Terrain walled = FlatWith({}, {{Vector3::UnitX(), 0.2}});
  EXPECT_TRUE(LookAhead(params, walled, PoseAt(0, 0, 0)).points_R.empty());
  // One eye: the rock is around the right one alone, 12 cm from the left one.
  const terrain::Rock beside = EllipsoidRock(0.4, -0.06, 0.45, 0.05, 0.05, 0.05);
  EXPECT_TRUE(LookAhead(params, FlatWith({beside}), PoseAt(0, 0, 0)).points_R.empty());
}

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
  EXPECT_GE(TruthOf(params, FlatWith({})).jumps.minCoeff(), 10000);
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
  vision::ForEachPixel(128, 128, [&](int column, int row) {
    if (truth.left_px(row, column) <= 0.0 || truth.rocks(row, column) >= 0) return;
    const Vector3 ray = view.Ray(column, row);
    const Vector3 p = view.eye + ray * (view.eye.z() / -ray.z());
    if (std::abs(p.x() - 1.5) > 0.03) return;
    if (p.y() > 0.12 && p.y() < 0.4) {
      ++left;
      EXPECT_TRUE(truth.shaded(row, column)) << p.y();
    }
    if (p.y() < -0.12 && p.y() > -0.4) {
      ++right;
      EXPECT_FALSE(truth.shaded(row, column)) << p.y();
    }
  });
  EXPECT_GT(left, 10);
  EXPECT_GT(right, 10);
}

}  // namespace
}  // namespace rockyard::sensing

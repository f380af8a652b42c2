// The table of rays against the camera model itself.
#include "rendering/picture/pixel_rays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rendering/picture/picture_kit.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

vision::CameraModel Distorted() {
  vision::CameraModel camera = PinholeAt({0.1, 0.2, 0.9}, 0.3, 70, 50, 1.0);
  auto& lens = std::get<vision::BrownPinhole>(camera.lens);
  lens.k1 = -0.2;
  lens.p1 = 0.002;
  return camera;
}

// A fisheye whose pupil moves, and which sees a circle within its image.
vision::CameraModel Fisheye() {
  vision::Cahvore lens;
  lens.linear.C = {0.3, -0.1, 0.8};
  lens.linear.A = lens.O = Vector3::UnitX();
  lens.linear.H = 40.0 * -Vector3::UnitY() + 47.5 * Vector3::UnitX();
  lens.linear.V = 40.0 * -Vector3::UnitZ() + 31.5 * Vector3::UnitX();
  lens.E = {0.001, 0.0005, 0.0};
  lens.R = {0.0, -0.1, 0.0};
  lens.type = vision::CahvoreType::kFisheye;
  return {lens, {96, 64}};
}

TEST(PixelRays, AreThoseOfTheCamera) {
  for (const vision::CameraModel& camera : {Distorted(), Fisheye()}) {
    const PixelRays rays(camera);
    ASSERT_EQ(rays.columns(), camera.size.columns);
    ASSERT_EQ(rays.rows(), camera.size.rows);
    for (int row = 0; row < rays.rows(); ++row) {
      for (int column = 0; column < rays.columns(); ++column) {
        if (!rays.Sees(column, row)) continue;
        const auto expected = BackProject(camera, vision::Pixel(column, row));
        ASSERT_TRUE(expected);
        EXPECT_EQ(rays.At(column, row).origin, expected->origin);
        EXPECT_EQ(rays.At(column, row).direction, expected->direction);
      }
    }
  }
}

TEST(PixelRays, BesideThePixelThereIsTheRayOfThatPosition) {
  const vision::CameraModel camera = Distorted();
  const PixelRays rays(camera);
  const double pixel_rad = rays.ByColumn(35, 25).norm();
  for (const int row : {0, 11, 49}) {
    for (const int column : {0, 30, 69}) {
      for (const double right : {-0.5, 0.25}) {
        const double down = 0.375;
        const Vector3 ray = rays.Beside(column, row, right, down).direction;
        const auto expected = BackProject(camera, vision::Pixel(column + right, row + down));
        ASSERT_TRUE(expected);
        EXPECT_NEAR(ray.norm(), 1.0, 1e-14);
        EXPECT_LT((ray - expected->direction).norm(), 0.01 * pixel_rad) << column << ' ' << row;
      }
    }
  }
}

TEST(PixelRays, PixelsAtTheEdgeOfALensAreBlind) {
  // Rows of a fisheye end where its radial polynomial stops growing: pixel 0, 0 is beyond.
  const vision::CameraModel camera = Fisheye();
  const PixelRays rays(camera);
  ASSERT_FALSE(BackProject(camera, vision::Pixel(0, 0)));
  EXPECT_FALSE(rays.Sees(0, 0));
  EXPECT_TRUE(rays.Sees(47, 31));
  for (int row = 1; row < rays.rows() - 1; ++row) {
    for (int column = 1; column < rays.columns() - 1; ++column) {
      bool all = true;
      for (int r = -1; r <= 1; ++r) {
        for (int c = -1; c <= 1; ++c) {
          all = all && BackProject(camera, vision::Pixel(column + c, row + r)).has_value();
        }
      }
      EXPECT_EQ(rays.Sees(column, row), all);
    }
  }
}

TEST(PixelRays, TilesHoldTheirRays) {
  for (const vision::CameraModel& camera : {Distorted(), Fisheye()}) {
    const PixelRays rays(camera);
    for (int row = 0; row < rays.rows(); ++row) {
      for (int column = 0; column < rays.columns(); ++column) {
        if (!rays.Sees(column, row)) continue;
        const PixelRays::Tile& tile =
            rays.TileAt(column / PixelRays::kTile, row / PixelRays::kTile);
        EXPECT_TRUE(tile.sees);
        EXPECT_NEAR(tile.cone.half_sine, std::sin(std::acos(tile.cone.half_cosine)), 1e-9);
        for (const double right : {-0.5, 0.5}) {
          for (const double down : {-0.5, 0.5}) {
            const vision::Ray ray = rays.Beside(column, row, right, down);
            EXPECT_GE(ray.direction.dot(tile.cone.axis), tile.cone.half_cosine - 1e-12);
            EXPECT_LE((ray.origin - tile.origin_A).norm(), tile.origin_spread_m + 1e-12);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace rockyard::rendering

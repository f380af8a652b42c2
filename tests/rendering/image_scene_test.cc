// What a ray meets, and what lies in the shade.
#include "rendering/image_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rendering/line_kit.h"
#include "terrain/placed_rocks.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;
using terrain::EllipsoidRock;
using terrain::FlatWith;

// The shadow of a ball on level ground is an ellipse with semi-axes r and r / sin(h) around the
// point h_c / tan(h) behind it.
TEST(ImageScene, ShadowOfABallIsAnEllipse) {
  const SunParams sun{.elevation_rad = math::DegToRad(35.0), .azimuth_rad = math::DegToRad(120.0)};
  const SunLight light = MakeSunLight(sun, 40e-9);
  constexpr double kRadius = 0.1;
  constexpr double kCenter = 0.13;
  const Vector3 ball(1.5, 0.2, kCenter);
  const terrain::Terrain terrain =
      FlatWith({EllipsoidRock(ball.x(), ball.y(), kCenter, kRadius, kRadius, kRadius)});
  const RoverBody body = SmallBody();
  const ImageScene scene(terrain, math::Transform::Identity(), light, sun, body, 4.0);
  const Vector3 away(-std::cos(sun.azimuth_rad), -std::sin(sun.azimuth_rad), 0.0);
  const Vector3 across(-away.y(), away.x(), 0.0);
  const Vector3 middle =
      Vector3(ball.x(), ball.y(), 0.0) + kCenter / std::tan(sun.elevation_rad) * away;
  std::vector<int> shading;
  const double bright = SunRadiance(light, sun.ground_albedo, Vector3::UnitZ(), true);
  const double shaded = SunRadiance(light, sun.ground_albedo, Vector3::UnitZ(), false);
  for (int i = 0; i < 48; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / 48;
    for (const double scale : {0.99, 1.01}) {
      const Vector3 ground = middle + scale * kRadius *
                                          (std::cos(turn) * across +
                                           std::sin(turn) / std::sin(sun.elevation_rad) * away);
      const Vector3 eye = ground + Vector3(0.0, 0.0, 0.02);
      if ((eye - ball).norm() <= kRadius) continue;  // under the ball
      SurfacePoint point = scene.Meet(eye, -Vector3::UnitZ(), RoverBody::kFree, {});
      scene.RocksBeforeSun({point.p_W, 0.0}, shading);
      scene.Light(shading, point);
      EXPECT_NEAR(point.radiance_w_m2_sr, scale < 1.0 ? shaded : bright, 1e-12) << i;
    }
  }
}

TEST(ImageScene, FarSideOfARockIsDarkAndWallsCastNoShadow) {
  SunParams sun{.elevation_rad = math::DegToRad(30.0)};
  sun.azimuth_rad = 0.0;  // in front
  const SunLight light = MakeSunLight(sun, 40e-9);
  const RoverBody body = SmallBody();
  const terrain::Terrain terrain =
      FlatWith({EllipsoidRock(1.0, 0.0, 0.0, 0.1, 0.1, 0.1)}, {{Vector3::UnitX(), 1.5}});
  const ImageScene scene(terrain, math::Transform::Identity(), light, sun, body, 4.0);
  const std::vector<int> rock{0};
  SurfacePoint facing_rover =
      scene.Meet(Vector3(0.5, 0.0, 0.05), Vector3::UnitX(), RoverBody::kFree, rock);
  scene.Light(rock, facing_rover);
  EXPECT_EQ(facing_rover.surface, 0);
  EXPECT_NEAR(facing_rover.radiance_w_m2_sr,
              SunRadiance(light, sun.rock_albedo, facing_rover.normal_W, false), 1e-12);
  SurfacePoint ground =
      scene.Meet(Vector3(1.4, 0.0, 0.5), -Vector3::UnitZ(), RoverBody::kFree, rock);
  scene.Light(rock, ground);
  EXPECT_NEAR(ground.radiance_w_m2_sr,
              SunRadiance(light, sun.ground_albedo, Vector3::UnitZ(), true), 1e-12);
}

}  // namespace
}  // namespace rockyard::rendering

// Rays, heights and normals describe one surface.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"
#include "terrain/field.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

using core::SampleUniform;
using math::Vector3;

class SurfaceTest : public testing::TestWithParam<double> {
 protected:
  SurfaceTest() {
    TerrainParams params;
    params.rocks.k_per_m2 = kVikingLander2K;
    params.ground.slope_rad = 0.15;
    params.ground.slope_direction_rad = 2.0;
    params.ground.roughness_rms_m = GetParam();
    terrain_.emplace(BuildField(params, {41, 0}, {}).terrain);
  }
  const Terrain& terrain() const { return *terrain_; }

 private:
  std::optional<Terrain> terrain_;
};

INSTANTIATE_TEST_SUITE_P(PlaneAndRough, SurfaceTest, testing::Values(0.0, 0.03));

TEST_P(SurfaceTest, VerticalRaysMeetTheHeight) {
  core::RandomStream stream({42, 0}, core::Purpose::kTest);
  int rocks = 0;
  for (int i = 0; i < 5000; ++i) {
    const double x = SampleUniform(stream, -3.0, 11.0);
    const double y = SampleUniform(stream, -2.5, 2.5);
    const auto hit = terrain().CastRay({x, y, 5.0}, -Vector3::UnitZ(), 20.0);
    ASSERT_TRUE(hit);
    ASSERT_NEAR(hit->point_W.z(), terrain().Height(x, y), 1e-9);
    rocks += hit->surface == Surface::kRock ? 1 : 0;
  }
  EXPECT_GT(rocks, 300);
}

TEST_P(SurfaceTest, NormalsAreTheGradientOfTheHeight) {
  constexpr double kStep_m = 1e-6;
  core::RandomStream stream({43, 0}, core::Purpose::kTest);
  int checked = 0;
  for (int i = 0; i < 3000; ++i) {
    const double x = SampleUniform(stream, -2.0, 10.0);
    const double y = SampleUniform(stream, -2.0, 2.0);
    const auto hit = terrain().CastRay({x, y, 5.0}, -Vector3::UnitZ(), 20.0);
    ASSERT_TRUE(hit);
    // Near a rock's outline the height jumps or bends too fast for differences.
    if (hit->normal_W.z() < 0.3) continue;
    const auto height = [this](double px, double py) { return terrain().Height(px, py); };
    const double dx = (height(x + kStep_m, y) - height(x - kStep_m, y)) / (2.0 * kStep_m);
    const double dy = (height(x, y + kStep_m) - height(x, y - kStep_m)) / (2.0 * kStep_m);
    if (std::hypot(dx, dy) > 10.0) continue;
    ++checked;
    const Vector3 expected = Vector3(-dx, -dy, 1.0).normalized();
    EXPECT_NEAR((hit->normal_W - expected).norm(), 0.0, 1e-4) << x << " " << y;
  }
  EXPECT_GT(checked, 2700);
}

// What a ray hits is seen from where it started, and what lies beyond is not.
TEST_P(SurfaceTest, OcclusionAgreesWithTheRay) {
  core::RandomStream stream({44, 0}, core::Purpose::kTest);
  for (int i = 0; i < 3000; ++i) {
    const double x = SampleUniform(stream, -1.0, 9.0);
    const double y = SampleUniform(stream, -1.0, 1.0);
    const Vector3 eye(x, y, terrain().Height(x, y) + 0.3);
    const double azimuth = SampleUniform(stream, 0.0, 2.0 * std::numbers::pi);
    const Vector3 direction = Vector3(std::cos(azimuth), std::sin(azimuth), -0.6).normalized();
    const auto hit = terrain().CastRay(eye, direction, 3.0);
    ASSERT_TRUE(hit);
    EXPECT_FALSE(terrain().Occluded(eye, hit->point_W, 1e-5));
    EXPECT_TRUE(terrain().Occluded(eye, hit->point_W + 0.01 * direction, 1e-5));
    EXPECT_LT(hit->normal_W.dot(direction), 1e-9);
  }
}

}  // namespace
}  // namespace rockyard::terrain

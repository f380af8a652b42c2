// Albedo and relief on soil and rocks.
#include "rendering/picture/terrain_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rendering/picture/picture_kit.h"
#include "terrain/placed_rocks.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

constexpr core::TrialKey kKey{6, 1};
const Vector3 kTinyX(1e-6, 0.0, 0.0);
const Vector3 kTinyY(0.0, 1e-6, 0.0);

SurfacePoint PointAt(const Vector3& p_W, const Vector3& normal_W, int surface) {
  return {.p_W = p_W, .normal_W = normal_W.normalized(), .surface = surface};
}

TEST(TerrainLook, WithoutTextureSurfacesAreAsTheSunSays) {
  const terrain::Terrain terrain =
      terrain::FlatWith({terrain::EllipsoidRock(1.0, 0.0, 0.0, 0.2, 0.2, 0.2)});
  const SunParams sun;
  TerrainLook look(terrain, sun, PlainLook(), kKey);
  const Vector3 n = Vector3(0.3, 0.2, 0.8).normalized();
  const auto at = [&](int surface) {
    return look.At(PointAt({1.0, 0.0, 0.2}, n, surface), kTinyX, kTinyY);
  };
  EXPECT_DOUBLE_EQ(at(SurfacePoint::kGround).albedo, sun.ground_albedo);
  EXPECT_DOUBLE_EQ(at(0).albedo, sun.rock_albedo);
  EXPECT_DOUBLE_EQ(at(SurfacePoint::kWall).albedo, sun.rock_albedo);
  EXPECT_DOUBLE_EQ(at(SurfacePoint::kRover).albedo, sun.rover_albedo);
  for (const int surface : {SurfacePoint::kGround, 0, SurfacePoint::kWall, SurfacePoint::kRover}) {
    EXPECT_LT((at(surface).normal_W - n).norm(), 1e-12) << surface;
  }
}

// The normal on soil is that of the surface z = relief * v, by differences of the albedo.
TEST(TerrainLook, ReliefGoesWithTheAlbedo) {
  const LookParams params{.soil_graininess = 0.0, .drift = {0.1, 3.0, 0.4, 0.1, 0.2}};
  const SunParams sun;
  const terrain::Terrain terrain = terrain::FlatWith({});
  TerrainLook look(terrain, sun, params, kKey);
  TextureField field(params.drift, kKey, core::Purpose::kSoilTexture);
  const auto albedo = [&](double x, double y) {
    return look.At(PointAt({x, y, 0.0}, Vector3::UnitZ(), SurfacePoint::kGround), kTinyX, kTinyY);
  };
  double square = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.731 * i;
    const double y = -0.413 * i;
    constexpr double kStep_m = 1e-3;
    // v = (albedo / mean - 1) / contrast; relief = slope / deviation of the gradient.
    const double relief_m = 0.2 / field.SlopeDeviation();
    const double per_albedo = relief_m / (0.1 * sun.ground_albedo);
    const Vector3 normal(
        -per_albedo * (albedo(x + kStep_m, y).albedo - albedo(x - kStep_m, y).albedo) /
            (2 * kStep_m),
        -per_albedo * (albedo(x, y + kStep_m).albedo - albedo(x, y - kStep_m).albedo) /
            (2 * kStep_m),
        1.0);
    const Vector3 seen = albedo(x, y).normal_W;
    EXPECT_LT((seen - normal.normalized()).norm(), 0.003);
    square += std::pow(seen.x() / seen.z(), 2) / 100;
  }
  EXPECT_NEAR(std::sqrt(square), 0.2, 0.05);
}

// On a rock that is turned, the texture turns with it; it moves with it, too.
TEST(TerrainLook, TextureIsFixedToTheRock) {
  const auto look_at = [](const terrain::Rock& rock, const Vector3& p, const Vector3& n) {
    const terrain::Terrain terrain = terrain::FlatWith({rock});
    TerrainLook look(terrain, SunParams{}, LookParams{}, kKey);
    return look.At(PointAt(p, n, 0), kTinyX, kTinyY);
  };
  const terrain::Rock one = terrain::EllipsoidRock(1.0, 0.5, 0.1, 0.3, 0.3, 0.3);
  terrain::Rock other = terrain::EllipsoidRock(-2.0, 3.0, 0.2, 0.3, 0.3, 0.3, 0.7);
  const auto turn = Eigen::AngleAxisd(0.7, Vector3::UnitZ()).toRotationMatrix();
  double least = 1.0, most = 0.0;
  for (int i = 0; i < 40; ++i) {
    const Vector3 n = Vector3(std::cos(i), std::sin(i), 0.05 * i - 0.6).normalized();
    const SurfaceLook here = look_at(one, one.center_W + 0.3 * n, n);
    const SurfaceLook there = look_at(other, other.center_W + 0.3 * turn * n, turn * n);
    EXPECT_NEAR(there.albedo, here.albedo, 1e-6);
    EXPECT_LT((there.normal_W - turn * here.normal_W).norm(), 1e-4);
    EXPECT_LT(std::abs(here.normal_W.norm() - 1.0), 1e-12);
    least = std::min(least, here.albedo);
    most = std::max(most, here.albedo);
  }
  EXPECT_GT(most - least, 0.01);
}

// Over many rocks: mean and deviation of their albedos, and of the texture where faces blend.
TEST(TerrainLook, RocksDifferAsMuchAsStated) {
  std::vector<terrain::Rock> rocks(2000, terrain::EllipsoidRock(0, 0, 0, 0.1, 0.1, 0.1));
  const terrain::Terrain terrain = terrain::FlatWith(rocks);
  const auto statistics = [&](double spread, double contrast, const Vector3& n) {
    LookParams params = PlainLook();
    params.rock_albedo_spread = spread;
    params.rock.contrast = contrast;
    TerrainLook look(terrain, SunParams{}, params, kKey);
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double ratio = look.At(PointAt(0.1 * n, n, i), kTinyX, kTinyY).albedo / 0.2;
      sum += ratio / 2000;
      square += ratio * ratio / 2000;
    }
    return std::pair(sum, std::sqrt(square - sum * sum));
  };
  // A deviation from 2000 is good to 1.6 %: 3.29 times that for alpha 0.001. The control is 10 %
  // off. Texture pieces repeat and neighbour each other, so theirs is good to a few percent.
  const auto [mean, spread] = statistics(0.15, 0.0, Vector3::UnitZ());
  EXPECT_NEAR(mean, 1.0, 3.29 * 0.15 / std::sqrt(2000.0));
  EXPECT_NEAR(spread, 0.15, 0.15 * 0.052);
  EXPECT_GT(std::abs(spread - 1.1 * 0.15), 0.15 * 0.052);
  for (const Vector3& n : {Vector3(1, 0, 0), Vector3(1, 1, 1), Vector3(1, -1, 0.1)}) {
    EXPECT_NEAR(statistics(0.0, 0.1, n.normalized()).second, 0.1, 0.012);
  }
}

// With few taps a strip of ground is blurred across: its texture is paler.
TEST(TerrainLook, TapsKeepTheTextureOfStrips) {
  const terrain::Terrain terrain = terrain::FlatWith({});
  const auto deviation = [&](std::int64_t taps) {
    const LookParams params{
        .soil_graininess = 0.0, .drift = {0.1, 2.0, 0.05, 0.003125, 0.0}, .texture_taps = taps};
    TerrainLook look(terrain, {}, params, kKey);
    double sum = 0.0;
    double square = 0.0;
    for (int i = 0; i < 400; ++i) {
      const auto point =
          PointAt({0.31 * i, 0.17 * i, 0.0}, Vector3::UnitZ(), SurfacePoint::kGround);
      const double albedo = look.At(point, {0.01, 0.0, 0.0}, {0.0, 0.08, 0.0}).albedo;
      sum += albedo / 400;
      square += albedo * albedo / 400;
    }
    return std::sqrt(std::max(square - sum * sum, 0.0));  // rounding, of one value
  };
  EXPECT_LT(deviation(1), 0.8 * deviation(4));
  EXPECT_LT(deviation(4), 0.95 * deviation(8));
  // The strip is eight times as long as wide: more taps would be the same.
  EXPECT_DOUBLE_EQ(deviation(8), deviation(16));
}

}  // namespace
}  // namespace rockyard::rendering

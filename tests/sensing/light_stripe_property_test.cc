// Symmetries and determinism of the light stripe sensor.
#include <gtest/gtest.h>

#include "core/distributions.h"
#include "sensing/stripe_scene.h"

namespace rockyard::sensing {
namespace {

using core::SampleUniform;
using messages::kStripeRows;
using messages::kStripes;

std::vector<terrain::Rock> RandomRocks(std::uint32_t scene) {
  core::RandomStream stream({20260103, 0}, core::Purpose::kTest, scene);
  std::vector<terrain::Rock> rocks;
  for (int i = 0; i < 8; ++i) {
    const double a = SampleUniform(stream, 0.03, 0.12);
    const double x = SampleUniform(stream, 0.40, 0.80);
    const double y = SampleUniform(stream, -0.5, 0.5);
    rocks.push_back(
        EllipsoidRock(x, y, 0.2 * a, a, 0.7 * a, 0.6 * a, SampleUniform(stream, 0.0, 3.1)));
  }
  return rocks;
}

terrain::Rock Mirrored(terrain::Rock rock) {
  rock.center_W.y() = -rock.center_W.y();
  rock.yaw_rad = -rock.yaw_rad;
  return rock;
}

bool Same(const messages::StripeScan& a, const messages::StripeScan& b) {
  for (std::size_t row = 0; row < kStripeRows; ++row) {
    for (std::size_t stripe = 0; stripe < kStripes; ++stripe) {
      const auto& p = a.pixels[row][stripe];
      const auto& q = b.pixels[row][stripe];
      if (p.detected != q.detected || p.column_px != q.column_px) return false;
    }
  }
  return true;
}

TEST(LightStripePropertyTest, MirroredSceneGivesMirroredScan) {
  // The centre stripe belongs to the left camera and has no mirror image.
  const LightStripe sensor(NoiselessParams());
  int found = 0;
  for (std::uint32_t scene = 0; scene < 300; ++scene) {
    const auto rocks = RandomRocks(scene);
    std::vector<terrain::Rock> mirrored;
    for (const terrain::Rock& rock : rocks) mirrored.push_back(Mirrored(rock));
    const auto a = sensor.Scan(FlatWith(rocks), PoseAt(0, 0.02, 0, 0.1), {1, 0}, 0);
    const auto b = sensor.Scan(FlatWith(mirrored), PoseAt(0, -0.02, 0, -0.1), {1, 0}, 0);
    for (std::size_t row = 0; row < kStripeRows; ++row) {
      for (const std::size_t stripe : {0u, 1u, 3u, 4u}) {
        const auto& p = a.pixels[row][stripe];
        const auto& q = b.pixels[row][kStripes - 1 - stripe];
        EXPECT_EQ(p.detected, q.detected);
        // Rounding half a pixel may go either way.
        EXPECT_NEAR(p.column_px, -q.column_px, 1.0);
        found += p.detected;
      }
    }
  }
  EXPECT_GT(found, 3000);
}

TEST(LightStripePropertyTest, MovingSceneAndRoverTogetherChangesNothing) {
  const LightStripe sensor(NoiselessParams());
  const math::Transform X = PoseAt(-3.0, 5.0, 0.0, 2.0);
  for (std::uint32_t scene = 0; scene < 100; ++scene) {
    auto rocks = RandomRocks(scene);
    const auto before = sensor.Scan(FlatWith(rocks), PoseAt(0, 0, 0), {1, 0}, 0);
    for (terrain::Rock& rock : rocks) {
      rock.center_W = X * rock.center_W;
      rock.yaw_rad += 2.0;
    }
    const auto after = sensor.Scan(FlatWith(rocks), X, {1, 0}, 0);
    for (std::size_t row = 0; row < kStripeRows; ++row) {
      for (std::size_t stripe = 0; stripe < kStripes; ++stripe) {
        EXPECT_EQ(before.pixels[row][stripe].detected, after.pixels[row][stripe].detected);
        EXPECT_NEAR(before.pixels[row][stripe].column_px, after.pixels[row][stripe].column_px, 1.0);
      }
    }
  }
}

TEST(LightStripePropertyTest, AScanDependsOnItsArgumentsAlone) {
  LightStripeParams params;
  params.wrong_place_probability = 0.2;
  params.missed_probability = 0.2;
  const LightStripe sensor(params);
  const terrain::Terrain terrain = FlatWith(RandomRocks(1));
  const auto first = sensor.Scan(terrain, PoseAt(0, 0, 0), {5, 3}, 17);
  for (int other = 0; other < 5; ++other) sensor.Scan(terrain, PoseAt(0.1, 0, 0), {5, 3}, other);
  EXPECT_TRUE(Same(first, sensor.Scan(terrain, PoseAt(0, 0, 0), {5, 3}, 17)));
  EXPECT_FALSE(Same(first, sensor.Scan(terrain, PoseAt(0, 0, 0), {5, 3}, 18)));
  EXPECT_FALSE(Same(first, sensor.Scan(terrain, PoseAt(0, 0, 0), {5, 4}, 17)));
  EXPECT_FALSE(Same(first, sensor.Scan(terrain, PoseAt(0, 0, 0), {6, 3}, 17)));
}

TEST(LightStripePropertyTest, TheSamePointsAreMisplacedOnEveryTerrain) {
  LightStripeParams params;
  params.wrong_place_probability = 0.3;
  const LightStripe sensor(params);
  const auto nothing_visible = PoseAt(0, 0, 50.0);
  for (std::int64_t number = 0; number < 50; ++number) {
    const auto alone = sensor.Scan(FlatWith({}), nothing_visible, {1, 0}, number);
    const auto rocky = sensor.Scan(FlatWith(RandomRocks(2)), PoseAt(0, 0, 0), {1, 0}, number);
    for (std::size_t row = 0; row < kStripeRows; ++row) {
      for (std::size_t stripe = 0; stripe < kStripes; ++stripe) {
        if (!alone.pixels[row][stripe].detected) continue;
        EXPECT_EQ(alone.pixels[row][stripe].column_px, rocky.pixels[row][stripe].column_px);
      }
    }
  }
}

}  // namespace
}  // namespace rockyard::sensing

// Symmetries and determinism of the light stripe sensor.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "perception/hazard_detector.h"
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
  return std::ranges::equal(a.pixels.points(), b.pixels.points(), [](const auto& p, const auto& q) {
    return p.detected == q.detected && p.column_px == q.column_px;
  });
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
    for (std::size_t i = 0; i < before.pixels.points().size(); ++i) {
      const messages::StripePixel& pixel = after.pixels.points()[i];
      EXPECT_EQ(before.pixels.points()[i].detected, pixel.detected);
      EXPECT_NEAR(before.pixels.points()[i].column_px, pixel.column_px, 1.0);
    }
  }
}

TEST(LightStripePropertyTest, AScanDependsOnItsArgumentsAlone) {
  LightStripeParams params{.wrong_place_probability = 0.2, .missed_probability = 0.2};
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
  LightStripeParams params{.wrong_place_probability = 0.3};
  const LightStripe sensor(params);
  const auto nothing_visible = PoseAt(0, 0, 50.0);
  for (std::int64_t number = 0; number < 50; ++number) {
    const auto alone = sensor.Scan(FlatWith({}), nothing_visible, {1, 0}, number);
    const auto rocky = sensor.Scan(FlatWith(RandomRocks(2)), PoseAt(0, 0, 0), {1, 0}, number);
    for (std::size_t i = 0; i < alone.pixels.points().size(); ++i) {
      if (!alone.pixels.points()[i].detected) continue;
      EXPECT_EQ(alone.pixels.points()[i].column_px, rocky.pixels.points()[i].column_px);
    }
  }
}

// Which rocks a straight approach sees, without noise. Section 6 of Matthies 1995: "on average
// rocks must be about 1.5 times higher" than the neighbour threshold to be seen, since the sparse
// points miss their tops. The bounds here are those of the geometry, not of that statement.

// Share of rocks of one height, a third of them below ground, anywhere across the rover's width,
// that are detected by scans every 6.5 cm before its front reaches them.
double ShareSeen(double height_m, int rocks) {
  const LightStripe sensor(NoiselessParams());
  const perception::Triangulator triangulator(sensor.calibration());
  int seen = 0;
  for (int i = 0; i < rocks; ++i) {
    core::RandomStream stream({20260108, static_cast<std::uint32_t>(i)}, core::Purpose::kTest);
    const double c = 0.75 * height_m;
    const double a = c / core::SampleUniform(stream, 0.5, 1.0);
    const double y = core::SampleUniform(stream, -0.24, 0.24);
    const double yaw = core::SampleUniform(stream, 0.0, 3.0);
    const terrain::Terrain field =
        FlatWith({EllipsoidRock(2.0, y, height_m - c, a, 0.85 * a, c, yaw)});
    double x = core::SampleUniform(stream, 0.8, 0.865);
    bool hazard = false;
    for (; !hazard && x + 0.325 < 2.0 - a; x += 0.065) {
      const auto scan = sensor.Scan(field, PoseAt(x, 0, 0), {1, 0}, 0);
      hazard = perception::ReportHazards(triangulator.Elevations(scan), {}).any();
    }
    seen += hazard;
  }
  return static_cast<double>(seen) / rocks;
}

TEST(DetectabilityTest, HigherRocksAreSeenMoreOften) {
  double before = 0.0;
  for (const double height_m : {0.03, 0.05, 0.07, 0.09, 0.12}) {
    const double share = ShareSeen(height_m, 500);
    EXPECT_GE(share, before) << height_m;
    before = share;
  }
  // No two points of a rock and of flat ground differ by more than its height: only points that it
  // hides from a camera can betray a rock below the threshold.
  EXPECT_LT(ShareSeen(0.03, 500), 0.15);
  EXPECT_GT(ShareSeen(0.12, 500), 0.98);
}

}  // namespace
}  // namespace rockyard::sensing

// The grid and the candidate list against a plain reference that tests every rock by marching, and
// against one that solves every rock.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "core/random.h"
#include "terrain/field.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

using core::SampleUniform;
using math::Vector3;

struct Ray {
  Vector3 origin_W;
  Vector3 direction_W;
  double max_distance_m;
};

// Implicit function of a rock: negative inside.
double InsideOut(const Rock& rock, const Vector3& p_W) {
  const Eigen::AngleAxisd turn(-rock.yaw_rad, Vector3::UnitZ());
  const Vector3 p = (turn * (p_W - rock.center_W)).cwiseQuotient(rock.semi_axes_m);
  if (rock.cap_growth == 0.0) return p.squaredNorm() - 1.0;
  const double s = 1.0 - p.z();
  const double width2 = (rock.cap_growth + (1.0 - rock.cap_growth) * s) * s;
  return s < 0.0 || s > 1.0 ? 1.0 : p.head<2>().squaredNorm() - width2;
}

// Rocks within a ray's reach.
std::vector<Rock> RocksInReach(const Terrain& terrain, const Ray& ray) {
  std::vector<Rock> rocks;
  for (const Rock& rock : terrain.rocks()) {
    const double reach = ray.max_distance_m + rock.semi_axes_m.maxCoeff();
    if ((rock.center_W - ray.origin_W).norm() <= reach) rocks.push_back(rock);
  }
  return rocks;
}

// True where a point is in a rock, under the ground or behind a wall.
bool Solid(const Terrain& terrain, const std::vector<Rock>& rocks, const Vector3& p_W) {
  if (p_W.z() <= terrain.ground().Height(p_W.x(), p_W.y())) return true;
  for (const Wall& wall : terrain.walls()) {
    if (wall.normal_W.dot(p_W) >= wall.offset_m) return true;
  }
  for (const Rock& rock : rocks) {
    if (InsideOut(rock, p_W) <= 0.0) return true;
  }
  return false;
}

double DistanceOf(const std::optional<RayHit>& hit) {
  return hit ? hit->distance_m : std::numeric_limits<double>::infinity();
}

// Distance to the first solid point in steps of `step_m`; infinity where there is none.
double MarchedDistance(const Terrain& terrain, const Ray& ray, double step_m) {
  const std::vector<Rock> rocks = RocksInReach(terrain, ray);
  for (double t = 0.0; t <= ray.max_distance_m; t += step_m) {
    if (Solid(terrain, rocks, ray.origin_W + t * ray.direction_W)) return t;
  }
  return std::numeric_limits<double>::infinity();
}

Ray RandomRay(core::RandomStream& stream) {
  const double azimuth = SampleUniform(stream, 0.0, 2.0 * std::numbers::pi);
  const double down = SampleUniform(stream, -1.0, 0.3);
  const Vector3 direction = Vector3(std::cos(azimuth), std::sin(azimuth), down).normalized();
  return {{SampleUniform(stream, -3.0, 11.0), SampleUniform(stream, -3.0, 3.0),
           SampleUniform(stream, 0.02, 0.6)},
          direction,
          SampleUniform(stream, 0.2, 4.0)};
}

// From ellipsoids to nearly cones.
constexpr std::array kPointedness = {0.0, 0.3, 0.62, 0.63, 0.87, 0.99};

Terrain DenseTerrain(std::uint32_t trial, double pointedness = 0.0) {
  TerrainParams params =
      trial % 2 == 0
          ? MooreIn(ArenaKind::kWalled, kVikingLander2K, OverlapRule::kAllow)
          : MooreIn(ArenaKind::kVirtualUnfolded, kVikingLander2K, OverlapRule::kRelocate);
  params.ground.slope_rad = 0.1 * trial;
  params.ground.slope_direction_rad = 1.0;
  params.rocks.pointedness = pointedness;
  return BuildField(params, {11, trial}, {}).terrain;
}

// The hit that testing every rock gives.
double PlainDistance(const Terrain& terrain, const Ray& ray) {
  std::vector<int> all(terrain.rocks().size());
  std::iota(all.begin(), all.end(), 0);
  return DistanceOf(terrain.CastRay(ray.origin_W, ray.direction_W, ray.max_distance_m, all));
}

TEST(RayDifferentialTest, GridAgreesWithTestingEveryRock) {
  int hits = 0;
  for (std::uint32_t trial = 0; trial < 2 * kPointedness.size(); ++trial) {
    const Terrain terrain = DenseTerrain(trial % 4, kPointedness[trial / 2]);
    core::RandomStream stream({12, trial}, core::Purpose::kTest);
    for (int i = 0; i < 10000; ++i) {
      const Ray ray = RandomRay(stream);
      const auto hit = terrain.CastRay(ray.origin_W, ray.direction_W, ray.max_distance_m);
      const double plain = PlainDistance(terrain, ray);
      ASSERT_EQ(DistanceOf(hit), plain) << i;
      const Vector3 end = ray.origin_W + ray.max_distance_m * ray.direction_W;
      const double shortened = ray.max_distance_m - 1e-9;
      if (std::abs(plain - shortened) > 1e-6) {
        ASSERT_EQ(terrain.Occluded(ray.origin_W, end, 1e-9), plain < shortened) << i;
      }
      hits += hit && hit->surface == Surface::kRock;
    }
  }
  EXPECT_GT(hits, 4000);
}

class CandidatesTest : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Pointedness, CandidatesTest, testing::Values(0.0, 0.87));

TEST_P(CandidatesTest, AroundTheRayAreEnough) {
  const Terrain terrain = DenseTerrain(1, GetParam());
  core::RandomStream stream({13, 0}, core::Purpose::kTest);
  std::vector<int> near;
  for (int i = 0; i < 20000; ++i) {
    const Ray ray = RandomRay(stream);
    terrain.RocksNear(ray.origin_W.x(), ray.origin_W.y(), ray.max_distance_m, near);
    const auto full = terrain.CastRay(ray.origin_W, ray.direction_W, ray.max_distance_m);
    const auto local = terrain.CastRay(ray.origin_W, ray.direction_W, ray.max_distance_m, near);
    const auto distance_m =
        terrain.RayDistance(ray.origin_W, ray.direction_W, ray.max_distance_m, near);
    ASSERT_EQ(full.has_value(), local.has_value());
    ASSERT_EQ(full.has_value(), distance_m.has_value());
    if (full) {
      ASSERT_EQ(full->distance_m, local->distance_m);
      ASSERT_EQ(full->distance_m, *distance_m);
    }
    const Vector3 end = ray.origin_W + ray.max_distance_m * ray.direction_W;
    ASSERT_EQ(terrain.Occluded(ray.origin_W, end, 1e-6),
              terrain.Occluded(ray.origin_W, end, 1e-6, near));
  }
}

TEST(RayDifferentialTest, AgreesWithMarchingThroughTheImplicitSurfaces) {
  constexpr double kStep_m = 2e-4;
  for (std::uint32_t trial = 0; trial < kPointedness.size(); ++trial) {
    const Terrain terrain = DenseTerrain(trial % 2, kPointedness[trial]);
    core::RandomStream stream({14, trial}, core::Purpose::kTest);
    int missed_by_march = 0;
    for (int i = 0; i < 100; ++i) {
      Ray ray = RandomRay(stream);
      ray.max_distance_m = 1.0;
      // One-sided walls are defined for rays from inside only.
      ray.origin_W.x() = SampleUniform(stream, -1.9, 9.9);
      ray.origin_W.y() = SampleUniform(stream, -1.9, 1.9);
      const auto hit = terrain.CastRay(ray.origin_W, ray.direction_W, ray.max_distance_m);
      const double marched = MarchedDistance(terrain, ray, kStep_m);
      if (hit && std::isinf(marched)) {
        ++missed_by_march;  // a chord shorter than the step, or a hit in the last step
      } else if (hit) {
        // Marching can step over a grazing chord, never stop early.
        EXPECT_GE(marched, hit->distance_m - 1e-9) << i;
        if (marched > hit->distance_m + kStep_m + 1e-9) ++missed_by_march;
      } else {
        EXPECT_TRUE(std::isinf(marched)) << i;
      }
    }
    EXPECT_LE(missed_by_march, 2);
  }
}

TEST(RayDifferentialTest, RoughGroundAgreesWithMarching) {
  GroundParams params{.roughness_rms_m = 0.04};
  const Terrain terrain(Ground(params, {15, 0}), {}, {});
  core::RandomStream stream({16, 0}, core::Purpose::kTest);
  constexpr double kStep_m = 5e-4;
  int grazing = 0;
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    Ray ray = RandomRay(stream);
    ray.max_distance_m = 1.0;
    ray.origin_W.z() += terrain.ground().Height(ray.origin_W.x(), ray.origin_W.y());
    const auto hit = terrain.CastRay(ray.origin_W, ray.direction_W, ray.max_distance_m);
    const double marched = MarchedDistance(terrain, ray, kStep_m);
    const double distance = DistanceOf(hit);
    hits += hit.has_value();
    if (std::isinf(distance) && std::isinf(marched)) continue;
    grazing += std::abs(marched - distance) > kStep_m + 1e-9 ? 1 : 0;
  }
  EXPECT_GT(hits, 100);
  EXPECT_LE(grazing, 2);
}

TEST(HeightDifferentialTest, EqualsTestingEveryRock) {
  const Terrain terrain = DenseTerrain(2);
  std::vector<RockShape> shapes;
  for (const Rock& rock : terrain.rocks()) shapes.emplace_back(rock);
  core::RandomStream stream({18, 0}, core::Purpose::kTest);
  int on_rock = 0;
  for (int i = 0; i < 5000; ++i) {
    const double x = SampleUniform(stream, -4.0, 12.0);
    const double y = SampleUniform(stream, -4.0, 4.0);
    const double ground_m = terrain.ground().Height(x, y);
    double plain_m = ground_m;
    for (const RockShape& shape : shapes) plain_m = std::max(plain_m, shape.Top(x, y));
    ASSERT_EQ(terrain.Height(x, y), plain_m);
    on_rock += plain_m > ground_m;
  }
  EXPECT_GT(on_rock, 200);
}

TEST(RocksNearDifferentialTest, EqualsTestingEveryRock) {
  const Terrain terrain = DenseTerrain(3);
  core::RandomStream stream({17, 0}, core::Purpose::kTest);
  std::vector<int> near;
  for (int i = 0; i < 2000; ++i) {
    const double x = SampleUniform(stream, -4.0, 12.0);
    const double y = SampleUniform(stream, -7.0, 7.0);
    const double radius = SampleUniform(stream, 0.0, 2.0);
    terrain.RocksNear(x, y, radius, near);
    std::vector<int> plain;
    for (std::size_t j = 0; j < terrain.rocks().size(); ++j) {
      const Rock& rock = terrain.rocks()[j];
      const double distance = std::hypot(rock.center_W.x() - x, rock.center_W.y() - y);
      if (distance <= radius + rock.semi_axes_m.x()) plain.push_back(static_cast<int>(j));
    }
    ASSERT_EQ(near, plain);
  }
}

// A rock that was moved is where every query finds it: as on a terrain built with it there.

TerrainParams RoughField() {
  TerrainParams params = PlainMoore(kNominalK);
  params.ground.roughness_rms_m = 0.02;
  params.ground.slope_rad = math::DegToRad(5.0);
  return params;
}

// The share of many rays, heights and neighbourhoods that the two terrains answer differently.
double Disagreement(const Terrain& one, const Terrain& other) {
  int different = 0;
  constexpr int kQueries = 4000;
  core::RandomStream stream({7, 0}, core::Purpose::kTest);
  std::vector<int> near_one, near_other;
  for (int i = 0; i < kQueries; ++i) {
    const double x_m = -3.0 + 15.0 * stream.Uniform();
    const double y_m = -3.0 + 6.0 * stream.Uniform();
    const double angle = 2.0 * std::numbers::pi * stream.Uniform();
    const math::Vector3 direction_W =
        math::Vector3(std::cos(angle), std::sin(angle), -0.3).normalized();
    const auto hit = one.CastRay({x_m, y_m, 0.4 + one.Height(x_m, y_m)}, direction_W, 5.0);
    const auto hit_other =
        other.CastRay({x_m, y_m, 0.4 + other.Height(x_m, y_m)}, direction_W, 5.0);
    one.RocksNear(x_m, y_m, 0.5, near_one);
    other.RocksNear(x_m, y_m, 0.5, near_other);
    const bool same_hit =
        hit.has_value() == hit_other.has_value() &&
        (!hit || (hit->point_W == hit_other->point_W && hit->normal_W == hit_other->normal_W &&
                  hit->rock == hit_other->rock));
    if (!same_hit || near_one != near_other || one.Height(x_m, y_m) != other.Height(x_m, y_m)) {
      ++different;
    }
  }
  return static_cast<double>(different) / kQueries;
}

TEST(MoveRock, QueriesAreThoseOfATerrainBuiltWithTheRocksThere) {
  Terrain moved = BuildField(RoughField(), {3, 0}, {}).terrain;
  const Terrain before = moved;
  ASSERT_GT(moved.rocks().size(), 20U);
  moved.MoveRock(0, 0.4, -0.3);
  moved.MoveRock(1, -0.01, 0.02);
  moved.MoveRock(2, 14.0, 5.0);  // far outside the old grid
  const std::vector<Rock> rocks(moved.rocks().begin(), moved.rocks().end());
  const Terrain built(moved.ground(), rocks, {});
  EXPECT_EQ(Disagreement(moved, built), 0.0);
  EXPECT_GT(Disagreement(moved, before), 0.005);  // the comparison can tell
}

TEST(MoveRock, KeepsItsHeightAboveTheGround) {
  Terrain terrain = BuildField(RoughField(), {3, 0}, {}).terrain;
  const Rock before = terrain.rocks()[4];
  terrain.MoveRock(4, 1.0, 0.5);
  const Rock& after = terrain.rocks()[4];
  EXPECT_DOUBLE_EQ(after.center_W.x(), before.center_W.x() + 1.0);
  EXPECT_DOUBLE_EQ(after.center_W.y(), before.center_W.y() + 0.5);
  const auto above = [&](const Rock& rock) {
    return rock.center_W.z() - terrain.ground().Height(rock.center_W.x(), rock.center_W.y());
  };
  EXPECT_NEAR(above(after), above(before), 1e-12);
  EXPECT_GT(std::abs(after.center_W.z() - before.center_W.z()), 1e-3);  // the ground does vary
}

}  // namespace
}  // namespace rockyard::terrain

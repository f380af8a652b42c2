// A rock that was moved is where every query finds it: as on a terrain built with it there.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "terrain/field.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

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

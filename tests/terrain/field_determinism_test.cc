#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/hash.h"
#include "terrain/field.h"

namespace rockyard::terrain {
namespace {

// Over every number of a field's rocks.
std::uint64_t HashRocks(const Terrain& terrain) {
  core::Hasher hasher;
  for (const Rock& rock : terrain.rocks()) {
    for (int i = 0; i < 3; ++i) hasher.Real(rock.center_W[i]).Real(rock.semi_axes_m[i]);
    hasher.Real(rock.yaw_rad).Real(rock.diameter_m).Real(rock.height_m);
  }
  return hasher.value();
}

TEST(FieldDeterminismTest, SameKeySameFieldWhateverWasBuiltBefore) {
  const TerrainParams params;
  const std::uint64_t first = HashRocks(BuildField(params, {51, 7}, {}).terrain);
  for (std::uint32_t trial = 0; trial < 20; ++trial) BuildField(params, {52, trial}, {});
  EXPECT_EQ(HashRocks(BuildField(params, {51, 7}, {}).terrain), first);
}

TEST(FieldDeterminismTest, SeedsAndTrialsGiveDifferentFields) {
  const TerrainParams params;
  std::set<std::uint64_t> hashes;
  for (std::uint32_t trial = 0; trial < 50; ++trial) {
    hashes.insert(HashRocks(BuildField(params, {51, trial}, {}).terrain));
    hashes.insert(HashRocks(BuildField(params, {53, trial}, {}).terrain));
  }
  EXPECT_EQ(hashes.size(), 100u);
}

TEST(FieldDeterminismTest, RayHitsRepeatToTheBit) {
  const Terrain a = BuildField({}, {51, 7}, {}).terrain;
  const Terrain b = BuildField({}, {51, 7}, {}).terrain;
  for (int i = 0; i < 1000; ++i) {
    const math::Vector3 direction(std::cos(i), std::sin(i), -0.3);
    const math::Vector3 origin(0.007 * i, 0.0, 0.3);
    const auto hit_a = a.CastRay(origin, direction.normalized(), 3.0);
    const auto hit_b = b.CastRay(origin, direction.normalized(), 3.0);
    ASSERT_EQ(hit_a.has_value(), hit_b.has_value());
    if (hit_a) {
      ASSERT_EQ(hit_a->point_W, hit_b->point_W);
    }
  }
}

}  // namespace
}  // namespace rockyard::terrain

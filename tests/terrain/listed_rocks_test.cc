#include <gtest/gtest.h>

#include <cstdint>

#include "terrain/field.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

TerrainParams TwoRocks() {
  TerrainParams params;
  params.arena.kind = ArenaKind::kOpen;
  params.rocks.kind = RockFieldKind::kListed;
  params.rocks.listed = {
      .x_m = {1.5, 3.0}, .y_m = {0.25, -0.5}, .diameter_m = {0.4, 0.6}, .height_m = {0.3, 0.2}};
  return params;
}

// Round, as high and as wide at the ground's height of their widest level as listed: the full
// height 2 c has burial_mean of it below the ground, h = 2 c (1 - 1/3), so c = 3 h / 4.
TEST(ListedRocksTest, StandAsListed) {
  const Field field = BuildField(TwoRocks(), {1, 0}, {});
  ASSERT_EQ(field.terrain.rocks().size(), 2u);
  EXPECT_EQ(field.audit.placed, 2);
  EXPECT_EQ(field.audit.expected_drawn, 0.0);
  const Rock& first = field.terrain.rocks()[0];
  EXPECT_EQ(first.center_W.x(), 1.5);
  EXPECT_EQ(first.center_W.y(), 0.25);
  EXPECT_EQ(first.semi_axes_m.x(), 0.2);
  EXPECT_EQ(first.semi_axes_m.y(), 0.2);
  EXPECT_NEAR(first.semi_axes_m.z(), 0.75 * 0.3, 1e-12);
  EXPECT_NEAR(first.center_W.z() + first.semi_axes_m.z(), 0.3, 1e-12);
  EXPECT_EQ(first.height_m, 0.3);
}

TEST(ListedRocksTest, AreTheSameInEveryTrial) {
  const Field one = BuildField(TwoRocks(), {1, 0}, {});
  const Field other = BuildField(TwoRocks(), {7, 99}, {});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(one.terrain.rocks()[i].center_W, other.terrain.rocks()[i].center_W);
    EXPECT_EQ(one.terrain.rocks()[i].semi_axes_m, other.terrain.rocks()[i].semi_axes_m);
  }
}

// Neither clear zones nor overlap move or drop what was placed by hand.
TEST(ListedRocksTest, StayWhereTheyArePut) {
  TerrainParams params = TwoRocks();
  params.rocks.clear_radius_m = 5.0;
  params.rocks.overlap = OverlapRule::kReject;
  params.rocks.listed.x_m[1] = 1.6;
  params.rocks.listed.y_m[1] = 0.25;
  EXPECT_EQ(BuildField(params, {1, 0}, {}).audit.placed, 2);
}

}  // namespace
}  // namespace rockyard::terrain

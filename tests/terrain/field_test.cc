#include "terrain/field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "terrain/arena.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

int CountIn(const Terrain& terrain, const Rectangle& area) {
  int count = 0;
  for (const Rock& rock : terrain.rocks()) {
    count += area.Contains(rock.center_W.x(), rock.center_W.y()) ? 1 : 0;
  }
  return count;
}

class ExactCountTest : public testing::TestWithParam<std::tuple<int, ArenaKind>> {};

INSTANTIATE_TEST_SUITE_P(PublishedCounts, ExactCountTest,
                         testing::Combine(testing::Values(5, 10, 15),
                                          testing::Values(ArenaKind::kOpen, ArenaKind::kWalled,
                                                          ArenaKind::kVirtualUnfolded,
                                                          ArenaKind::kVirtualReflected)));

TEST_P(ExactCountTest, HoldsInEveryField) {
  const auto [count, arena] = GetParam();
  const TerrainParams params = ExactCount(count, arena);
  for (std::uint32_t trial = 0; trial < 50; ++trial) {
    const Field field = BuildField(params, {3, trial}, {});
    EXPECT_EQ(CountIn(field.terrain, CountArea(params.rocks)), count);
    for (const Rock& rock : field.terrain.rocks()) {
      EXPECT_GE(rock.diameter_m, 0.25);
      EXPECT_LE(rock.diameter_m, 0.35);
    }
    EXPECT_EQ(field.audit.placed, static_cast<int>(std::lround(field.audit.expected_drawn)));
    EXPECT_EQ(field.audit.dropped_for_overlap, 0);
    EXPECT_EQ(field.audit.dropped_in_clear_zones, 0);
  }
}

// Every parameter on which the layout depends keeps the strip's first five rocks when five are
// added.
TEST(ExactCountTest, LargerCountsKeepTheFirstRocks) {
  const Field few = BuildField(ExactCount(5, ArenaKind::kVirtualReflected), {3, 1}, {});
  const Field many = BuildField(ExactCount(10, ArenaKind::kVirtualReflected), {3, 1}, {});
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(few.terrain.rocks()[i].center_W, many.terrain.rocks()[i].center_W);
    EXPECT_EQ(few.terrain.rocks()[i].diameter_m, many.terrain.rocks()[i].diameter_m);
  }
}

// Beyond the count area the open field goes on at the same density.
TEST(ExactCountTest, OpenFieldGoesOn) {
  const TerrainParams params = ExactCount(15, ArenaKind::kOpen);
  const Field field = BuildField(params, {3, 0}, {});
  EXPECT_NEAR(field.audit.placed / params.LayoutArea(), 15 / 17.6, 0.01);
}

class FieldRuleTest : public testing::TestWithParam<ArenaKind> {
 protected:
  TerrainParams Params(OverlapRule overlap, LineRule line = LineRule::kMerge) const {
    TerrainParams params;
    params.rocks.k_per_m2 = kVikingLander2K;
    params.rocks.overlap = overlap;
    params.rocks.mirror_line = line;
    params.arena.kind = GetParam();
    return params;
  }
};

INSTANTIATE_TEST_SUITE_P(Arenas, FieldRuleTest,
                         testing::Values(ArenaKind::kOpen, ArenaKind::kWalled,
                                         ArenaKind::kVirtualUnfolded,
                                         ArenaKind::kVirtualReflected));

// Whether two rocks are one rock and its image about a mirror line at y = +-1.1 m.
bool AreImages(const Rock& a, const Rock& b) {
  const double middle_m = 0.5 * std::abs(a.center_W.y() + b.center_W.y());
  // Lines of unfolded strips lie at odd multiples of 1.1 m. A picometre for rounding.
  return a.center_W.x() == b.center_W.x() && a.diameter_m == b.diameter_m &&
         std::abs(std::remainder(middle_m - 1.1, 2.2)) < 1e-12;
}

struct Overlaps {
  int with_own_image = 0;
  int with_others = 0;
};

Overlaps CountOverlaps(const Terrain& terrain) {
  Overlaps overlaps;
  const auto rocks = terrain.rocks();
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = (rocks[i].center_W.head<2>() - rocks[j].center_W.head<2>()).norm();
      if (distance >= rocks[i].semi_axes_m.x() + rocks[j].semi_axes_m.x() - 1e-12) continue;
      ++(AreImages(rocks[i], rocks[j]) ? overlaps.with_own_image : overlaps.with_others);
    }
  }
  return overlaps;
}

// Rocks across a mirror line overlap their own image, and nothing else does, whatever image.
TEST_P(FieldRuleTest, RejectAndRelocateLeaveNoOverlapEvenWithImages) {
  const bool lines =
      GetParam() == ArenaKind::kVirtualUnfolded || GetParam() == ArenaKind::kVirtualReflected;
  for (std::uint32_t trial = 0; trial < 5; ++trial) {
    for (const OverlapRule rule : {OverlapRule::kReject, OverlapRule::kRelocate}) {
      const Overlaps merged = CountOverlaps(BuildField(Params(rule), {5, trial}, {}).terrain);
      EXPECT_EQ(merged.with_others, 0);
      EXPECT_EQ(merged.with_own_image > 0, lines);
      const Overlaps kept_off =
          CountOverlaps(BuildField(Params(rule, LineRule::kKeepOff), {5, trial}, {}).terrain);
      EXPECT_EQ(kept_off.with_others + kept_off.with_own_image, 0);
    }
    // The check itself can fail.
    EXPECT_GT(
        CountOverlaps(BuildField(Params(OverlapRule::kAllow), {5, trial}, {}).terrain).with_others,
        0);
  }
}

TEST_P(FieldRuleTest, NoRockReachesIntoTheClearZones) {
  Course course;
  course.waypoints = {{3.0, 0.6}, {5.0, -0.6}};
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    const Field field = BuildField(Params(OverlapRule::kRelocate), {5, trial}, course);
    for (const Rock& rock : field.terrain.rocks()) {
      const double reach = 0.5 + rock.semi_axes_m.x();
      EXPECT_GE(std::hypot(rock.center_W.x(), rock.center_W.y()), reach);
      EXPECT_GE(std::hypot(rock.center_W.x() - 3.0, rock.center_W.y() - 0.6), reach);
      EXPECT_GE(std::hypot(rock.center_W.x() - 5.0, rock.center_W.y() + 0.6), reach);
      EXPECT_GE(std::hypot(rock.center_W.x() - 7.6, rock.center_W.y()), reach);
    }
  }
}

TEST_P(FieldRuleTest, AuditAddsUp) {
  for (const OverlapRule rule :
       {OverlapRule::kAllow, OverlapRule::kReject, OverlapRule::kRelocate}) {
    const Field field = BuildField(Params(rule), {5, 2}, {});
    const FieldAudit& audit = field.audit;
    EXPECT_EQ(audit.placed, audit.drawn - audit.dropped_for_overlap - audit.dropped_in_clear_zones);
    EXPECT_EQ(static_cast<int>(field.terrain.rocks().size()), audit.placed + audit.mirror_images);
    EXPECT_NEAR(audit.expected_drawn,
                (MooreNumberPerM2(kVikingLander2K, 0.1) - kVikingLander2K) * audit.layout_area_m2,
                1e-9);
    EXPECT_LT(audit.outline_cover, audit.disc_cover);
    EXPECT_LT(audit.belly_high_per_m2, audit.detectable_per_m2);
    EXPECT_LT(audit.expected_placed, audit.expected_drawn);
  }
}

TEST(FieldTest, AuditCountsHighRocksOfTheLayoutOnly) {
  const Field field = BuildField(ExactCount(15, ArenaKind::kVirtualUnfolded), {9, 0}, {});
  int detectable = 0;
  int belly_high = 0;
  for (int i = 0; i < field.audit.placed; ++i) {
    const double height_m = field.terrain.rocks()[static_cast<std::size_t>(i)].height_m;
    detectable += height_m >= 0.075 ? 1 : 0;
    belly_high += height_m >= 0.13 ? 1 : 0;
  }
  EXPECT_DOUBLE_EQ(field.audit.detectable_per_m2, detectable / 17.6);
  EXPECT_DOUBLE_EQ(field.audit.belly_high_per_m2, belly_high / 17.6);
  EXPECT_EQ(field.audit.mirror_images, 4 * 15);
}

TEST(FieldTest, RocksStandOnTheGround) {
  TerrainParams params;
  params.ground.slope_rad = 0.2;
  params.ground.roughness_rms_m = 0.03;
  const Field field = BuildField(params, {9, 1}, {});
  ASSERT_GT(field.terrain.rocks().size(), 10u);
  for (const Rock& rock : field.terrain.rocks()) {
    const double top_m = rock.center_W.z() + rock.semi_axes_m.z();
    const double ground_m = field.terrain.ground().Height(rock.center_W.x(), rock.center_W.y());
    EXPECT_NEAR(top_m - ground_m, rock.height_m, 1e-12);
  }
}

TEST(FieldTest, NoneIsBareGround) {
  TerrainParams params;
  params.rocks.kind = RockFieldKind::kNone;
  const Field field = BuildField(params, {9, 2}, {});
  EXPECT_TRUE(field.terrain.rocks().empty());
  EXPECT_EQ(field.audit.expected_cover, 0.0);
}

TEST(FieldTest, CourseOutsideTheArenaIsAUserError) {
  Course course;
  course.goal_x_m = 11.0;
  EXPECT_THROW(BuildField({}, {1, 0}, course), core::UserError);
  course.goal_x_m = 7.6;
  course.goal_y_m = 1.2;  // beyond the mirror line
  EXPECT_THROW(BuildField({}, {1, 0}, course), core::UserError);
  course.goal_y_m = 0.0;
  course.waypoints = {{3.0, 0.5}, {5.0, -0.5}};
  EXPECT_NO_THROW(BuildField({}, {1, 0}, course));
  course.waypoints[1].y_m = -1.2;
  EXPECT_THROW(BuildField({}, {1, 0}, course), core::UserError);
}

}  // namespace
}  // namespace rockyard::terrain

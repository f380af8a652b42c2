#include "terrain/field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.h"
#include "core/params_text.h"
#include "terrain/arena.h"
#include "terrain/rock_layout.h"
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
  EXPECT_NEAR(BuildField(params, {3, 0}, {}).audit.placed / params.LayoutArea(), 15 / 17.6, 0.01);
}

class FieldRuleTest : public testing::TestWithParam<ArenaKind> {
 protected:
  TerrainParams Params(OverlapRule overlap, LineRule line = LineRule::kMerge) const {
    return MooreIn(GetParam(), kVikingLander2K, overlap, line);
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
  Course course{.waypoints = {{3.0, 0.6}, {5.0, -0.6}}};
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
  TerrainParams params{.ground = {.slope_rad = 0.2, .roughness_rms_m = 0.03}};
  const Field field = BuildField(params, {9, 1}, {});
  ASSERT_GT(field.terrain.rocks().size(), 10u);
  for (const Rock& rock : field.terrain.rocks()) {
    const double top_m = rock.center_W.z() + rock.semi_axes_m.z();
    const double ground_m = field.terrain.ground().Height(rock.center_W.x(), rock.center_W.y());
    EXPECT_NEAR(top_m - ground_m, rock.height_m, 1e-12);
  }
}

TEST(FieldTest, NoneIsBareGround) {
  TerrainParams params{.rocks = {.kind = RockFieldKind::kNone}};
  const Field field = BuildField(params, {9, 2}, {});
  EXPECT_TRUE(field.terrain.rocks().empty());
  EXPECT_EQ(field.audit.expected_cover, 0.0);
}

TEST(FieldTest, CourseOutsideTheArenaIsAUserError) {
  Course course{.goal_x_m = 11.0};
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
  EXPECT_EQ(field.audit.expected_drawn, 2.0);
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

TEST(ListedRocksTest, HaveTheirOwnBurialWidthAndYaw) {
  TerrainParams params = TwoRocks();
  params.ground.slope_rad = 0.2;
  params.rocks.listed.buried_share = {0.5, 0.25};
  params.rocks.listed.width_ratio = {0.5, 0.8};
  params.rocks.listed.yaw_deg = {30.0, -60.0};
  const Field field = BuildField(params, {1, 0}, {});
  const Rock& first = field.terrain.rocks()[0];
  EXPECT_EQ(first.semi_axes_m.y(), 0.1);
  EXPECT_NEAR(first.semi_axes_m.z(), 0.3, 1e-12);  // half of the full height stands out
  EXPECT_NEAR(first.yaw_rad, std::numbers::pi / 6.0, 1e-15);
  const Rock& second = field.terrain.rocks()[1];
  EXPECT_NEAR(second.semi_axes_m.y(), 0.24, 1e-15);
  EXPECT_NEAR(second.semi_axes_m.z(), 0.2 / 1.5, 1e-12);
  EXPECT_NEAR(second.yaw_rad, -std::numbers::pi / 3.0, 1e-15);
  // They stand on the slope, which rises along x.
  for (const Rock& rock : field.terrain.rocks()) {
    const double ground_m = std::tan(0.2) * rock.center_W.x();
    EXPECT_NEAR(rock.center_W.z() + rock.semi_axes_m.z() - ground_m, rock.height_m, 1e-12);
  }
}

TEST(ListedRocksTest, ListsOfShapesThatSayTheDefaultsChangeNothing) {
  TerrainParams params = TwoRocks();
  const Field plain = BuildField(params, {1, 0}, {});
  params.rocks.listed.buried_share = {params.rocks.burial_mean, params.rocks.burial_mean};
  params.rocks.listed.width_ratio = {1.0, 1.0};
  params.rocks.listed.yaw_deg = {0.0, 0.0};
  const Field told = BuildField(params, {1, 0}, {});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(plain.terrain.rocks()[i].semi_axes_m, told.terrain.rocks()[i].semi_axes_m);
    EXPECT_EQ(plain.terrain.rocks()[i].center_W, told.terrain.rocks()[i].center_W);
    EXPECT_EQ(plain.terrain.rocks()[i].yaw_rad, told.terrain.rocks()[i].yaw_rad);
  }
}

// The rest is the field that its law lays by itself, but for the rocks that listed ones displace.
class RestOfRocksTest : public testing::TestWithParam<std::pair<RestOfRocks, RockFieldKind>> {
 protected:
  TerrainParams Params(OverlapRule overlap) const {
    TerrainParams params = TwoRocks();
    params.rocks.listed.rest = GetParam().first;
    params.rocks.max_diameter_m = 0.4;
    params.rocks.overlap = overlap;
    return params;
  }
};

INSTANTIATE_TEST_SUITE_P(BothLaws, RestOfRocksTest,
                         testing::Values(std::pair{RestOfRocks::kMoore, RockFieldKind::kMoore},
                                         std::pair{RestOfRocks::kGolombek,
                                                   RockFieldKind::kGolombek}));

TEST_P(RestOfRocksTest, LiesBesideTheListedRocks) {
  TerrainParams params = Params(OverlapRule::kAllow);
  const Field field = BuildField(params, {11, 0}, {});
  params.rocks.kind = GetParam().second;
  const Field alone = BuildField(params, {11, 0}, {});
  ASSERT_EQ(field.audit.placed, alone.audit.placed + 2);
  EXPECT_EQ(field.terrain.rocks()[0].diameter_m, 0.4);
  EXPECT_EQ(field.terrain.rocks()[1].diameter_m, 0.6);
  for (std::size_t i = 0; i < alone.terrain.rocks().size(); ++i) {
    EXPECT_EQ(field.terrain.rocks()[i + 2].center_W, alone.terrain.rocks()[i].center_W);
  }
  EXPECT_NEAR(field.audit.expected_drawn, alone.audit.expected_drawn + 2.0, 1e-9);
  EXPECT_NEAR(field.audit.expected_placed, alone.audit.expected_placed + 2.0, 1e-9);
  EXPECT_NEAR(field.audit.expected_cover - alone.audit.expected_cover,
              0.25 * std::numbers::pi * (0.16 + 0.36) / field.audit.layout_area_m2, 1e-12);
  EXPECT_TRUE(ExpectedInCorridor(Params(OverlapRule::kAllow), {}).empty());
}

TEST_P(RestOfRocksTest, KeepsOffTheListedRocks) {
  const auto overlaps = [&](OverlapRule rule) {
    int count = 0;
    for (std::uint32_t trial = 0; trial < 40; ++trial) {
      const Field field = BuildField(Params(rule), {12, trial}, {});
      const auto rocks = field.terrain.rocks();
      for (std::size_t i = 2; i < rocks.size(); ++i) {
        for (std::size_t j = 0; j < 2; ++j) {
          const double apart_m = (rocks[i].center_W - rocks[j].center_W).head<2>().norm();
          count += apart_m < 0.5 * (rocks[i].diameter_m + rocks[j].diameter_m) ? 1 : 0;
        }
      }
    }
    return count;
  };
  EXPECT_EQ(overlaps(OverlapRule::kRelocate), 0);
  EXPECT_EQ(overlaps(OverlapRule::kReject), 0);
  EXPECT_GT(overlaps(OverlapRule::kAllow), 0);
}

// A list as long as the longest that is allowed, a metre apart.
std::string ManyRocks(std::size_t rocks, std::size_t bad) {
  std::string x_m;
  std::string y_m;
  std::string diameter_m;
  std::string height_m;
  for (std::size_t i = 0; i < rocks; ++i) {
    const char* comma = i == 0 ? "" : ",";
    x_m += comma + std::to_string(static_cast<double>(i % 400) - 200.0);
    y_m += comma + std::to_string(static_cast<double>(i / 400) - 125.0);
    diameter_m += std::string(comma) + (i == bad ? "7.5" : "0.3");
    height_m += std::string(comma) + "0.2";
  }
  return R"({"arena": {"kind": "open"}, "rocks": {"kind": "listed", "listed": {"x_m": [)" + x_m +
         R"(], "y_m": [)" + y_m + R"(], "diameter_m": [)" + diameter_m + R"(], "height_m": [)" +
         height_m + "]}}}";
}

TEST(ListedRocksTest, AHundredThousandAreReadAndStand) {
  constexpr std::size_t kRocks = 100000;
  const TerrainParams params = core::ReadText<TerrainParams>(ManyRocks(kRocks, kRocks));
  const Field field = BuildField(params, {1, 0}, {});
  ASSERT_EQ(field.terrain.rocks().size(), kRocks);
  EXPECT_NEAR(field.terrain.Height(199.0, 124.0), 0.2, 1e-12);
  EXPECT_EQ(field.terrain.Height(199.5, 124.5), 0.0);
  const auto hit = field.terrain.CastRay({150.5, 3.0, 0.1}, math::Vector3::UnitX(), 5.0);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->rock, 351 + 128 * 400);
}

TEST(ListedRocksTest, ABadEntryOfALongListIsNamed) {
  const std::string problems = core::ProblemsOf<TerrainParams>(ManyRocks(100000, 70123));
  EXPECT_NE(problems.find("rocks.listed.diameter_m[70123]"), std::string::npos) << problems;
  EXPECT_EQ(problems.find("70122"), std::string::npos);
  const std::string too_long = core::ProblemsOf<TerrainParams>(ManyRocks(100001, 100001));
  EXPECT_NE(too_long.find("has 100001 elements"), std::string::npos) << too_long;
  EXPECT_NE(too_long.find("use at most 100000"), std::string::npos);
}

TEST(ListedRocksTest, ListsOfOtherLengthsSayWhich) {
  const std::string problems = core::ProblemsOf<TerrainParams>(
      R"({"rocks": {"kind": "listed", "listed": {"x_m": [1, 2], "y_m": [1, 2],
          "diameter_m": [0.3], "height_m": [0.1, 0.2]}}})");
  EXPECT_NE(problems.find("rocks.listed.diameter_m"), std::string::npos) << problems;
  EXPECT_NE(problems.find("has 1 entries where x_m has 2"), std::string::npos) << problems;
  EXPECT_EQ(problems.find("height_m"), std::string::npos) << problems;
}

// The work and the memory of placing rocks: both are counted, not timed.

// Discs of 0.2 m on a lattice over the layout, so many per m2.
Placement Fill(const Rectangle& layout, double per_m2) {
  Placement placement(layout, {}, 0.0, std::nullopt);
  const double spacing_m = 1.0 / std::sqrt(per_m2);
  for (double x_m = layout.x_min_m; x_m < layout.x_max_m; x_m += spacing_m) {
    for (double y_m = layout.y_min_m; y_m < layout.y_max_m; y_m += spacing_m) {
      placement.Add({x_m, y_m, 0.1});
    }
  }
  return placement;
}

std::size_t MostInOneCell(const Placement& placement) {
  std::size_t most = 0;
  for (const auto& discs : placement.cells()) most = std::max(most, discs.size());
  return most;
}

// At two rocks per m2 a cell of half a metre meets those within 0.7 m along x and y: one or two.
TEST(PlacementWorkTest, WorkForOneRockDoesNotGrowWithTheLengthOfTheField) {
  for (const double length_m : {12.0, 100.0, 1000.0}) {
    const Placement placement = Fill({-2.0, length_m - 2.0, -6.0, 6.0}, 2.0);
    EXPECT_LE(MostInOneCell(placement), 2u) << length_m;
    EXPECT_LE(placement.cells().size(), 4.2 * 12.5 * length_m) << length_m;
  }
}

// A square kilometre has cells of 2 m instead of half a metre: at one rock in 40 m2, one in each.
TEST(PlacementWorkTest, CellsOfWideFieldsGrow) {
  const Placement placement = Fill({-500.0, 500.0, -500.0, 500.0}, 1.0 / 40.0);
  EXPECT_LE(placement.cells().size(), 252'000u);
  EXPECT_LE(MostInOneCell(placement), 1u);
}

}  // namespace
}  // namespace rockyard::terrain

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "terrain/arena.h"
#include "terrain/field.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

using core::SampleUniform;
using math::Vector3;

bool SameRock(const Rock& a, const Rock& b) {
  return a.center_W == b.center_W && a.semi_axes_m == b.semi_axes_m && a.yaw_rad == b.yaw_rad &&
         a.diameter_m == b.diameter_m && a.height_m == b.height_m;
}

// The layout's own rocks, without images.
std::vector<Rock> LayoutRocks(const Field& field) {
  const auto rocks = field.terrain.rocks();
  return {rocks.begin(), rocks.begin() + field.audit.placed};
}

class NestingTest
    : public testing::TestWithParam<std::tuple<RockFieldKind, ArenaKind, OverlapRule, double>> {};

// Two clusters per m2, or none.
INSTANTIATE_TEST_SUITE_P(
    LawsArenasAndRules, NestingTest,
    testing::Combine(testing::Values(RockFieldKind::kMoore, RockFieldKind::kGolombek),
                     testing::Values(ArenaKind::kOpen, ArenaKind::kVirtualUnfolded,
                                     ArenaKind::kVirtualReflected),
                     testing::Values(OverlapRule::kAllow, OverlapRule::kReject,
                                     OverlapRule::kRelocate),
                     testing::Values(0.0, 2.0)));

TEST_P(NestingTest, FieldsOfGrowingAbundanceContainEachOther) {
  TerrainParams params;
  std::tie(params.rocks.kind, params.arena.kind, params.rocks.overlap,
           params.rocks.clusters_per_m2) = GetParam();
  const bool moore = params.rocks.kind == RockFieldKind::kMoore;
  for (std::uint32_t trial = 0; trial < 5; ++trial) {
    std::vector<Rock> smaller;
    // Covers of a hundredth of a percent to all of the reference, as for k.
    for (const double k : {0.0001, 0.001, kNominalK, 0.008, kVikingLander2K, 0.02}) {
      (moore ? params.rocks.k_per_m2 : params.rocks.cover) = moore ? k : 20.0 * k;
      const std::vector<Rock> larger = LayoutRocks(BuildField(params, {31, trial}, {}));
      ASSERT_GE(larger.size(), smaller.size());
      EXPECT_TRUE(std::equal(smaller.begin(), smaller.end(), larger.begin(), SameRock)) << k;
      smaller = larger;
    }
    EXPECT_GT(smaller.size(), 60u);
  }
}

// Negative control: without the common reference field, fields do not nest.
TEST(NestingTest, AnotherReferenceIsAnotherField) {
  TerrainParams params;
  const std::vector<Rock> with = LayoutRocks(BuildField(params, {31, 0}, {}));
  params.rocks.k_reference_per_m2 = 0.03;
  const std::vector<Rock> without = LayoutRocks(BuildField(params, {31, 0}, {}));
  EXPECT_FALSE(std::equal(with.begin(), with.end(), without.begin(), without.end(), SameRock));
}

TEST(NestingTest, AnotherReferenceCoverIsAnotherField) {
  TerrainParams params;
  params.rocks.kind = RockFieldKind::kGolombek;
  const std::vector<Rock> with = LayoutRocks(BuildField(params, {31, 0}, {}));
  params.rocks.cover_reference = 0.3;
  const std::vector<Rock> without = LayoutRocks(BuildField(params, {31, 0}, {}));
  EXPECT_FALSE(std::equal(with.begin(), with.end(), without.begin(), without.end(), SameRock));
}

// Choices about shape leave sizes, and choices about burial leave positions, as they were.
TEST(StreamTest, OneParameterShiftsNoOther) {
  TerrainParams params = PlainMoore(kNominalK);
  const std::vector<Rock> before = LayoutRocks(BuildField(params, {32, 0}, {}));
  params.rocks.burial_mean = 0.2;
  params.rocks.min_width_ratio = 0.5;
  const std::vector<Rock> after = LayoutRocks(BuildField(params, {32, 0}, {}));
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].diameter_m, after[i].diameter_m);
    EXPECT_EQ(before[i].center_W.x(), after[i].center_W.x());
    EXPECT_EQ(before[i].yaw_rad, after[i].yaw_rad);
    EXPECT_NE(before[i].height_m, after[i].height_m);
  }
}

// One rock after another finds its place as easily as in a short field, at the density of the law
// all along, and queries far from the origin find what is there.
TEST(KilometreTest, IsTheSameFieldAllAlong) {
  TerrainParams params = PlainMoore(kNominalK);
  params.rocks.overlap = OverlapRule::kRelocate;
  params.arena.length_m = 1000.0;
  const Field field = BuildField(params, {33, 0}, {0.0, 0.0, 900.0, 0.0});
  // Poisson: five deviations.
  EXPECT_NEAR(field.audit.placed, field.audit.expected_placed,
              5.0 * std::sqrt(field.audit.expected_placed));
  EXPECT_LT(field.audit.relocated, 0.1 * field.audit.placed);
  constexpr std::size_t kParts = 10;
  std::array<int, kParts> in_part{};
  for (const Rock& rock : field.terrain.rocks()) {
    const double share = (rock.center_W.x() - params.arena.x_min_m) / params.arena.length_m;
    ASSERT_TRUE(share >= 0.0 && share < 1.0);
    ++in_part[static_cast<std::size_t>(share * kParts)];
  }
  const double expected = field.audit.expected_placed / kParts;
  for (const int count : in_part) EXPECT_NEAR(count, expected, 5.0 * std::sqrt(expected));
  std::vector<int> found;
  for (const double x_m : {0.0, 450.0, 997.0}) {
    field.terrain.RocksNear(x_m, 0.0, 2.0, found);
    std::vector<int> meeting;
    for (std::size_t i = 0; i < field.terrain.rocks().size(); ++i) {
      const Rock& rock = field.terrain.rocks()[i];
      const double reach_m = 2.0 + rock.semi_axes_m.x();
      if (std::hypot(rock.center_W.x() - x_m, rock.center_W.y()) <= reach_m) {
        meeting.push_back(static_cast<int>(i));
      }
    }
    EXPECT_EQ(found, meeting);
    EXPECT_GT(found.size(), 5u);
  }
}

// Pairs of rocks whose round outlines of the drawn diameter overlap.
int Overlaps(const Field& field) {
  const auto rocks = field.terrain.rocks();
  int overlaps = 0;
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double reach_m = 0.5 * (rocks[i].diameter_m + rocks[j].diameter_m);
      const double distance_m = (rocks[i].center_W - rocks[j].center_W).head<2>().norm();
      if (distance_m < reach_m) ++overlaps;
    }
  }
  return overlaps;
}

// A square kilometre of large rocks; where they may overlap, some do.
TEST(KilometreTest, WideFieldsKeepTheirRocksApart) {
  TerrainParams params = PlainMoore(kNominalK);
  params.arena.length_m = 1000.0;
  params.arena.width_m = 1000.0;
  params.rocks.min_diameter_m = 1.0;
  params.rocks.max_diameter_m = 2.0;
  EXPECT_GT(Overlaps(BuildField(params, {34, 0}, {})), 0);
  params.rocks.overlap = OverlapRule::kRelocate;
  const Field field = BuildField(params, {34, 0}, {});
  EXPECT_GT(field.audit.placed, 3000);
  EXPECT_GT(field.audit.relocated, 0);
  EXPECT_EQ(Overlaps(field), 0);
}

class MirrorTest : public testing::TestWithParam<OverlapRule> {};

INSTANTIATE_TEST_SUITE_P(Rules, MirrorTest,
                         testing::Values(OverlapRule::kAllow, OverlapRule::kRelocate));

// Heights are equal at points mirrored about either line, as far as the layout reaches.
TEST_P(MirrorTest, SurfaceIsSymmetricAboutBothLines) {
  const TerrainParams params = MooreIn(ArenaKind::kVirtualUnfolded, kVikingLander2K, GetParam());
  const Terrain terrain = BuildField(params, {33, 0}, {}).terrain;
  int on_rock = 0;
  for (double x = -1.97; x < 10.0; x += 0.0731) {
    for (double d = 0.013; d < 2.0; d += 0.0917) {
      for (const double line : {1.1, -1.1}) {
        EXPECT_NEAR(terrain.Height(x, line + d), terrain.Height(x, line - d), 1e-9);
        on_rock += terrain.Height(x, line + d) > 0.0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(on_rock, 500);
}

TEST(MirrorTest, UnfoldedAndReflectedShareTheStrip) {
  TerrainParams params{.arena = {.kind = ArenaKind::kVirtualUnfolded}};
  const Field unfolded = BuildField(params, {34, 0}, {});
  params.arena.kind = ArenaKind::kVirtualReflected;
  const Field reflected = BuildField(params, {34, 0}, {});
  const std::vector<Rock> a = LayoutRocks(unfolded);
  const std::vector<Rock> b = LayoutRocks(reflected);
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end(), SameRock));
  // Every reflected rock is one of the unfolded plane; those beyond the arena are missing.
  for (const Rock& rock : reflected.terrain.rocks()) {
    EXPECT_LE(std::abs(rock.center_W.y()), 2.0);
    const auto all = unfolded.terrain.rocks();
    EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                            [&rock](const Rock& other) { return SameRock(rock, other); }));
  }
}

TEST(LayoutTest, CentresLieInTheLayoutArea) {
  for (const ArenaKind kind : {ArenaKind::kOpen, ArenaKind::kWalled, ArenaKind::kVirtualUnfolded,
                               ArenaKind::kVirtualReflected}) {
    TerrainParams params{.arena = {.kind = kind}};
    const Rectangle area = LayoutBounds(params);
    for (const Rock& rock : LayoutRocks(BuildField(params, {35, 0}, {}))) {
      EXPECT_TRUE(area.Contains(rock.center_W.x(), rock.center_W.y()));
    }
  }
}

// Rays, heights and normals describe one surface.

class SurfaceTest : public testing::TestWithParam<double> {
 protected:
  SurfaceTest() {
    TerrainParams params{
        .ground = {.slope_rad = 0.15, .slope_direction_rad = 2.0, .roughness_rms_m = GetParam()},
        .rocks = {.k_per_m2 = kVikingLander2K}};
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

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "core/params_text.h"
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

}  // namespace
}  // namespace rockyard::terrain

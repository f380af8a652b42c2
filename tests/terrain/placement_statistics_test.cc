// Where rocks lie, and what the overlap rules and clear zones do to the counts. Fixed seeds.
#include <gtest/gtest.h>

#include "core/random.h"
#include "core/statistical_checks.h"
#include "terrain/arena.h"
#include "terrain/field.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

struct Totals {
  double drawn = 0.0;
  double expected_drawn = 0.0;
  double expected_placed = 0.0;
  double placed = 0.0;
  double dropped_for_overlap = 0.0;
  double disc_cover = 0.0;
  double expected_cover = 0.0;
};

Totals Sum(const TerrainParams& params, std::uint64_t seed, int fields, const Course& course = {}) {
  Totals totals;
  for (int i = 0; i < fields; ++i) {
    const FieldAudit audit =
        BuildField(params, {seed, static_cast<std::uint32_t>(i)}, course).audit;
    totals.drawn += audit.drawn;
    totals.expected_drawn += audit.expected_drawn;
    totals.expected_placed += audit.expected_placed;
    totals.placed += audit.placed;
    totals.dropped_for_overlap += audit.dropped_for_overlap;
    totals.disc_cover += audit.disc_cover / fields;
    totals.expected_cover += audit.expected_cover / fields;
  }
  return totals;
}

TEST(PlacementTest, PositionsAreUniformOverTheLayoutArea) {
  const TerrainParams params = PlainMoore(kVikingLander2K);
  const Rectangle area = LayoutBounds(params);
  constexpr int kColumns = 12;
  constexpr int kRows = 4;
  std::vector<double> observed(kColumns * kRows, 0.0);
  double total = 0.0;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Field field = BuildField(params, {71, i}, {});
    for (const Rock& rock : field.terrain.rocks()) {
      const int column = static_cast<int>(rock.center_W.x() - area.x_min_m);
      const int row = static_cast<int>(rock.center_W.y() - area.y_min_m);
      observed[static_cast<std::size_t>(row * kColumns + column)] += 1.0;
      total += 1.0;
    }
  }
  const std::vector<double> expected(observed.size(), total / kColumns / kRows);
  EXPECT_GT(core::ChiSquareP(observed, expected), kAlpha);
  // Negative control: 10 % more towards one end.
  std::vector<double> tilted = expected;
  for (std::size_t i = 0; i < tilted.size(); ++i) {
    tilted[i] *= 0.9 + 0.2 * (static_cast<double>(i % kColumns) + 0.5) / kColumns;
  }
  EXPECT_LT(core::ChiSquareP(observed, tilted), kRejects);
}

// Across the strip between the mirror lines, up to the lines; they leave bands without centres
// where rocks keep off them.
TEST(PlacementTest, PositionsAreUniformUpToTheMirrorLines) {
  constexpr int kStrips = 11;
  const auto p_value = [](LineRule line) {
    TerrainParams params = PlainMoore(kNominalK);
    params.arena.kind = ArenaKind::kVirtualReflected;
    params.rocks.overlap = OverlapRule::kRelocate;
    params.rocks.mirror_line = line;
    std::vector<double> observed(kStrips, 0.0);
    double total = 0.0;
    for (std::uint32_t i = 0; i < 400; ++i) {
      const Field field = BuildField(params, {75, i}, {});
      for (int j = 0; j < field.audit.placed; ++j) {
        const double y_m = field.terrain.rocks()[static_cast<std::size_t>(j)].center_W.y();
        observed[static_cast<std::size_t>((y_m + 1.1) / 2.2 * kStrips)] += 1.0;
        total += 1.0;
      }
    }
    return core::ChiSquareP(observed, std::vector<double>(kStrips, total / kStrips));
  };
  EXPECT_GT(p_value(LineRule::kMerge), kAlpha);
  EXPECT_LT(p_value(LineRule::kKeepOff), kRejects);
}

// Without an overlap rule, clear zones thin the field by exactly what their area says.
class ClearZoneTest : public testing::TestWithParam<std::tuple<ArenaKind, RockFieldKind>> {};

INSTANTIATE_TEST_SUITE_P(
    ArenasAndLaws, ClearZoneTest,
    testing::Combine(testing::Values(ArenaKind::kVirtualReflected, ArenaKind::kOpen),
                     testing::Values(RockFieldKind::kMoore, RockFieldKind::kGolombek)));

TEST_P(ClearZoneTest, RemovesItsShare) {
  TerrainParams params = MooreIn(std::get<0>(GetParam()), kVikingLander2K, OverlapRule::kAllow);
  params.rocks.kind = std::get<1>(GetParam());
  params.rocks.cover = kVikingLander2Cover;
  params.arena.open_margin_m = 0.0;
  const Totals totals = Sum(params, 72, 150);
  const double sigma = std::sqrt(totals.expected_placed);
  EXPECT_NEAR(totals.placed, totals.expected_placed, 3.3 * sigma);
  EXPECT_GT(std::abs(totals.placed - totals.expected_drawn), 5.0 * sigma);  // negative control
  EXPECT_NEAR(totals.disc_cover / totals.expected_cover, 1.0, 0.05);
}

// The same with two clear zones more, 3.3 deviations; what start and goal alone would leave lies
// more than 5 away.
TEST(PlacementTest, ClearZonesOfWaypointsAreExpected) {
  TerrainParams params = PlainMoore(kVikingLander2K);
  params.rocks.clear_radius_m = 0.5;
  Course course;
  const Totals without = Sum(params, 75, 300, course);
  course.waypoints = {{3.0, 0.5}, {5.0, -0.5}};
  const Totals totals = Sum(params, 75, 300, course);
  const double sigma = std::sqrt(totals.expected_placed);
  EXPECT_NEAR(totals.placed, totals.expected_placed, 3.3 * sigma);
  EXPECT_GT(without.expected_placed - totals.placed, 5.0 * sigma);
}

TEST(PlacementTest, RelocationKeepsTheCounts) {
  TerrainParams params = PlainMoore(kVikingLander2K);
  params.rocks.overlap = OverlapRule::kRelocate;
  const Totals totals = Sum(params, 73, 100);
  EXPECT_EQ(totals.dropped_for_overlap, 0.0);
  EXPECT_NEAR(totals.placed, totals.expected_drawn, 3.3 * std::sqrt(totals.expected_drawn));
}

// Rejection keeps fewer rocks the denser the field; the loss is documented in
// src/terrain/README.md.
TEST(PlacementTest, RejectionLosesRocksInDenseFields) {
  double last_loss = 0.0;
  for (const double k : {0.001, kNominalK, kVikingLander2K}) {
    TerrainParams params = PlainMoore(k);
    params.rocks.overlap = OverlapRule::kReject;
    const Totals totals = Sum(params, 74, 100);
    const double loss = totals.dropped_for_overlap / totals.drawn;
    EXPECT_GT(loss, last_loss);
    last_loss = loss;
    RecordProperty("loss_at_k_" + std::to_string(k), std::to_string(loss));
  }
  EXPECT_GT(last_loss, 0.1);
  EXPECT_LT(last_loss, 0.4);
}

// Rocks in the corridor of the course against the law, by placement rule. Fixed seeds.

constexpr std::array<double, 4> kClasses{0.2, 0.3, 0.5, 1.0};

// Two-sided p-value of a Poisson number.
double PoissonP(double observed, double mean) {
  const double lower = boost::math::gamma_q(observed + 1.0, mean);
  const double upper = observed == 0.0 ? 1.0 : boost::math::gamma_p(observed, mean);
  return std::min(1.0, 2.0 * std::min(lower, upper));
}

TerrainParams Nominal(OverlapRule overlap, LineRule line = LineRule::kMerge) {
  return MooreIn(ArenaKind::kVirtualReflected, kNominalK, overlap, line);
}

// Expected and observed over all fields.
std::vector<CorridorClass> Count(const TerrainParams& params, std::uint64_t seed, int fields) {
  std::vector<CorridorClass> classes = ExpectedInCorridor(params, {});
  for (int i = 0; i < fields; ++i) {
    const Field field = BuildField(params, {seed, static_cast<std::uint32_t>(i)}, {});
    CountInCorridor(field.terrain.rocks(), {}, classes);
  }
  for (CorridorClass& c : classes) c.expected *= fields;
  return classes;
}

TEST(AreaNearTest, AgreesWithRandomPoints) {
  const Rectangle area{-1.0, 2.0, -0.5, 0.7};
  core::RandomStream stream({91, 0}, core::Purpose::kRockPlacement);
  constexpr int kPoints = 200000;
  // Inside, across one edge, across a corner, from outside, and around it all.
  for (const auto& [x, y, r] :
       {std::array{0.5, 0.1, 0.3}, std::array{0.5, 0.1, 0.65}, std::array{2.0, 0.7, 0.4},
        std::array{-1.3, 0.0, 0.6}, std::array{0.4, -0.6, 1.1}, std::array{0.0, 0.0, 9.0}}) {
    int near = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double px = core::SampleUniform(stream, area.x_min_m, area.x_max_m);
      const double py = core::SampleUniform(stream, area.y_min_m, area.y_max_m);
      near += std::hypot(px - x, py - y) < r ? 1 : 0;
    }
    const double share = AreaNear(area, x, y, r) / area.Area();
    const double sigma = std::sqrt(share * (1.0 - share) / kPoints);
    EXPECT_NEAR(near / static_cast<double>(kPoints), share, 4.0 * sigma + 1e-9) << x << " " << r;
  }
  EXPECT_EQ(AreaNear(area, 0.0, 0.0, 0.0), 0.0);
  EXPECT_EQ(AreaNear(area, 3.0, 0.0, 0.9), 0.0);
}

// One size, so that the integral over sizes is a single value.
TEST(ExpectedInCorridorTest, IsTheClosedFormForOneSize) {
  TerrainParams params = ExactCount(10, ArenaKind::kVirtualReflected);
  params.rocks.uniform_min_diameter_m = 0.3;
  params.rocks.uniform_max_diameter_m = 0.3;
  const std::vector<CorridorClass> classes = ExpectedInCorridor(params, {});
  ASSERT_EQ(classes.size(), 1u);
  // Zones of .65 m about (0, 0) and (7.6, 0): in the corridor (|y| < .5) a half of each clipped
  // strip; in the count area (x from -.2 to 7.8) a disc less its segment beyond .2 m.
  const double r = 0.65;
  const auto half_strip = [r](double half) {
    return half * std::sqrt(r * r - half * half) + r * r * std::asin(half / r);
  };
  const double corridor = 7.6 - 2.0 * half_strip(0.5);
  const double segment = r * r * std::acos(0.2 / r) - 0.2 * std::sqrt(r * r - 0.2 * 0.2);
  const double area = 17.6 - 2.0 * (std::numbers::pi * r * r - segment);
  EXPECT_NEAR(classes[0].expected, 10.0 * corridor / area, 1e-9);
}

TEST(ExpectedInCorridorTest, MooreClassesAddUpToTheLaw) {
  TerrainParams params = Nominal(OverlapRule::kAllow);
  params.rocks.clear_radius_m = 0.0;
  // Rocks of .1 m and more without zones would fill the corridor's 7.6 m2; zones of D/2 are left.
  double sum = 0.0;
  for (const CorridorClass& c : ExpectedInCorridor(params, {})) sum += c.expected;
  const double law = params.rocks.RocksPerM2() * 7.6;
  EXPECT_LT(sum, law);
  EXPECT_GT(sum, 0.995 * law);
  params.rocks.max_diameter_m = 0.25;
  const std::vector<CorridorClass> cut = ExpectedInCorridor(params, {});
  ASSERT_EQ(cut.size(), 2u);
  EXPECT_EQ(cut[1].to_m, 0.25);
}

TEST(ExpectedInCorridorTest, IsEmptyWhereThereIsNoLawOrNoCorridor) {
  TerrainParams params = Nominal(OverlapRule::kAllow);
  EXPECT_EQ(ExpectedInCorridor(params, {}).size(), 4u);
  EXPECT_TRUE(ExpectedInCorridor(params, {0.0, 0.0, 7.6, 0.4}).empty());  // not along x
  EXPECT_TRUE(ExpectedInCorridor(params, {0.0, 0.0, 7.6, 0.0, {{3.0, 0.0}}}).empty());
  EXPECT_TRUE(ExpectedInCorridor(params, {0.0, 0.7, 7.6, 0.7}).empty());  // over the line
  EXPECT_TRUE(ExpectedInCorridor(params, {0.0, 0.0, 1.9, 0.0}).empty());  // zones meet
  EXPECT_FALSE(ExpectedInCorridor(params, {0.0, 0.0, 2.1, 0.0}).empty());
  params.rocks.kind = RockFieldKind::kNone;
  EXPECT_TRUE(ExpectedInCorridor(params, {}).empty());
}

// Poisson positions: every class holds what the law says.
TEST(CorridorTest, MergedFieldsWithoutOverlapRuleFollowTheLaw) {
  TerrainParams params = Nominal(OverlapRule::kAllow);
  for (const RockFieldKind law : {RockFieldKind::kMoore, RockFieldKind::kGolombek}) {
    params.rocks.kind = law;
    const std::vector<CorridorClass> classes = Count(params, 92, 4000);
    ASSERT_EQ(classes.size(), kClasses.size());
    for (std::size_t i = 0; i < classes.size(); ++i) {
      EXPECT_EQ(classes[i].to_m, kClasses[i]);
      EXPECT_GT(PoissonP(classes[i].observed, classes[i].expected), kAlpha) << i;
    }
  }
}

// Negative control: the other law's expectations, at as many rocks of a decimetre.
TEST(CorridorTest, OneLawIsNotTheOther) {
  TerrainParams golombek = Nominal(OverlapRule::kAllow);
  golombek.rocks.kind = RockFieldKind::kGolombek;
  TerrainParams moore = Nominal(OverlapRule::kAllow);
  moore.rocks.k_per_m2 *= golombek.rocks.RocksPerM2() / moore.rocks.RocksPerM2();
  const std::vector<CorridorClass> found = Count(golombek, 92, 1000);
  const std::vector<CorridorClass> expected = ExpectedInCorridor(moore, {});
  EXPECT_LT(PoissonP(found[1].observed, 1000 * expected[1].expected), kRejects);
}

// Relocation moves rocks of nominal terrain by what other rocks ask, which is little: less than
// chance shows in the larger classes (1.4 % and more for one deviation), a few tenths of a percent
// in the smallest.
TEST(CorridorTest, MergedAndRelocatedFieldsStayNearTheLaw) {
  for (const CorridorClass& c : Count(Nominal(OverlapRule::kRelocate), 93, 4000)) {
    EXPECT_GT(PoissonP(c.observed, c.expected), kAlpha) << c.from_m;
    if (c.to_m <= 0.2) {
      EXPECT_NEAR(c.observed / c.expected, 1.0, 0.02);
    }
  }
}

// Negative control: rocks that keep off the lines have |y| <= h - D/2, which makes the corridor
// denser by h / (h - D/2).
TEST(CorridorTest, KeepingOffTheLinesFillsTheCorridor) {
  const std::vector<CorridorClass> classes =
      Count(Nominal(OverlapRule::kRelocate, LineRule::kKeepOff), 93, 4000);
  ASSERT_EQ(classes.size(), 4u);
  for (const CorridorClass& c : classes) {
    EXPECT_LT(PoissonP(c.observed, c.expected), kRejects) << c.from_m;
  }
  // Mean of h / (h - D/2) over each class with density D^-3.66, h = 1.1 m.
  for (std::size_t i = 0; i < 2; ++i) {
    double sum = 0.0;
    double weight = 0.0;
    for (double d = classes[i].from_m; d < classes[i].to_m; d += 1e-4) {
      weight += std::pow(d, -3.66);
      sum += std::pow(d, -3.66) * 1.1 / (1.1 - 0.5 * d);
    }
    EXPECT_NEAR(classes[i].observed / classes[i].expected, sum / weight, 0.03) << i;
  }
}

// Rocks that are left out where they would overlap are missing, the more the larger.
TEST(CorridorTest, RejectedRocksAreMissing) {
  double last = 1.0;
  for (const CorridorClass& c : Count(Nominal(OverlapRule::kReject), 94, 2000)) {
    EXPECT_LT(c.observed / c.expected, last);
    last = c.observed / c.expected;
  }
  EXPECT_LT(last, 0.8);
}

TEST(CorridorTest, ExactCountsFollowTheirArea) {
  TerrainParams params = ExactCount(10, ArenaKind::kVirtualReflected);
  const std::vector<CorridorClass> merged = Count(params, 95, 4000);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_GT(PoissonP(merged[0].observed, merged[0].expected), kAlpha);
  params.rocks.mirror_line = LineRule::kKeepOff;
  const std::vector<CorridorClass> kept_off = Count(params, 95, 4000);
  EXPECT_LT(PoissonP(kept_off[0].observed, kept_off[0].expected), kRejects);
}

}  // namespace
}  // namespace rockyard::terrain

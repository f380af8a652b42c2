// Where rocks lie, and what the overlap rules and clear zones do to the counts. Fixed seeds.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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
TEST(PlacementTest, ClearZonesRemoveTheirShare) {
  for (const ArenaKind kind : {ArenaKind::kVirtualReflected, ArenaKind::kOpen}) {
    const Totals totals = Sum(MooreIn(kind, kVikingLander2K, OverlapRule::kAllow), 72, 150);
    const double sigma = std::sqrt(totals.expected_placed);
    EXPECT_NEAR(totals.placed, totals.expected_placed, 3.3 * sigma);
    EXPECT_GT(std::abs(totals.placed - totals.expected_drawn), 5.0 * sigma);  // negative control
    EXPECT_NEAR(totals.disc_cover / totals.expected_cover, 1.0, 0.05);
  }
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

}  // namespace
}  // namespace rockyard::terrain

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/stereo_sensing/stereo_sensing.h"
#include "experiments/stereo_sensing/stereo_sums.h"
#include "navigation/navigator_set_params.h"
#include "terrain/placed_rocks.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

using sensing::DepthImage;

// A view of one row along x, whose pixels all look along the axis but for their column: f = 10 px,
// B = 0.1 m, so that d = 1 / Z.
sensing::StereoView OneRow(int columns) {
  sensing::StereoView view;
  view.columns = columns;
  view.rows = 1;
  view.focal_px = 10.0;
  view.baseline_m = 0.1;
  view.along_row = {0.0, -0.1, 0.0};
  return view;
}

// All of it seen by both, lit, far from margins and jumps.
sensing::StereoTruth TruthOf(const std::vector<double>& disparities_px) {
  const auto columns = static_cast<Eigen::Index>(disparities_px.size());
  sensing::StereoTruth truth;
  truth.left_px = Eigen::Map<const DepthImage>(disparities_px.data(), 1, columns);
  truth.both_px = truth.left_px;
  truth.jumps = sensing::PixelNumbers::Constant(1, columns, 1000);
  truth.behind = sensing::PixelFlags::Constant(1, columns, false);
  truth.rocks = sensing::PixelNumbers::Constant(1, columns, -1);
  truth.shaded = sensing::PixelFlags::Constant(1, columns, false);
  truth.margin = sensing::PixelFlags::Constant(1, columns, false);
  return truth;
}

DepthImage Matched(const std::vector<double>& disparities_px) {
  return Eigen::Map<const DepthImage>(disparities_px.data(), 1,
                                      static_cast<Eigen::Index>(disparities_px.size()));
}

constexpr PixelLimits kEverything{0.0, 100.0, 0.5, 16.0, 3};

TEST(PixelErrorsTest, PerfectMatchesHaveNoErrors) {
  const std::vector<double> row(20, 4.0);
  StereoSums sums;
  AddPixels(TruthOf(row), Matched(row), OneRow(20), kEverything, sums);
  EXPECT_EQ(sums.all.pixels, 20.0);
  EXPECT_EQ(sums.all.good, 20.0);
  EXPECT_EQ(sums.all.error2_px2, 0.0);
  EXPECT_EQ(sums.range_error2_m2, 0.0);
  EXPECT_EQ(sums.kinds[0].good, 20.0);
  EXPECT_EQ(sums.pairs[0], 19.0);
  EXPECT_EQ(sums.pairs[6], 13.0);
  EXPECT_EQ(sums.products_px2[0], 0.0);
}

TEST(PixelErrorsTest, AddsErrorsAndTheirSquares) {
  // Errors +0.5, -0.25, none, wrong by 1, not matched.
  StereoSums sums;
  AddPixels(TruthOf({4, 4, 4, 4, 4}), Matched({4.5, 3.75, 4, 5, 0}), OneRow(5), kEverything, sums);
  EXPECT_EQ(sums.all.pixels, 5.0);
  EXPECT_EQ(sums.all.good, 3.0);
  EXPECT_EQ(sums.all.wrong, 1.0);
  EXPECT_DOUBLE_EQ(sums.all.bias_px, 0.25);
  EXPECT_DOUBLE_EQ(sums.all.error2_px2, 0.25 + 0.0625);
  // Neighbours: (0.5)(-0.25) and (-0.25)(0); two apart (0.5)(0).
  EXPECT_EQ(sums.pairs[0], 2.0);
  EXPECT_DOUBLE_EQ(sums.products_px2[0], -0.125);
  EXPECT_EQ(sums.pairs[1], 1.0);
  EXPECT_EQ(sums.pairs[2], 0.0);
}

TEST(PixelErrorsTest, RangesFollowFromDisparitiesAlongTheRay) {
  // Pixel 3 looks along (1, -0.3, 0): |e| = sqrt(1.09). Z = 1 / d = 0.25 m, and 0.2 m as matched.
  sensing::StereoTruth truth = TruthOf({0, 0, 0, 4});
  StereoSums sums;
  AddPixels(truth, Matched({0, 0, 0, 4.8}), OneRow(4), kEverything, sums);
  const double ray = std::sqrt(1.09);
  const double error_m = ray * (1.0 / 4.8 - 0.25);
  EXPECT_DOUBLE_EQ(sums.range_m, 0.25 * ray);
  EXPECT_NEAR(sums.range_bias_m, error_m, 1e-15);
  EXPECT_NEAR(sums.range_error2_m2, error_m * error_m, 1e-15);
  // dr/dd = -|e| / d^2, here by a difference quotient; on the axis r^2 / (f B).
  const double h = 1e-5;
  const double slope = ray * (1.0 / (4.0 - h) - 1.0 / (4.0 + h)) / (2.0 * h);
  EXPECT_NEAR(std::sqrt(sums.range_step2_m2), slope, 1e-9);
  EXPECT_DOUBLE_EQ(std::sqrt(sums.axis_step2_m2), 0.25 * 0.25 * 1.09);
}

TEST(PixelErrorsTest, EveryPixelIsOfOneKind) {
  sensing::StereoTruth truth = TruthOf(std::vector<double>(12, 4.0));
  truth.jumps.row(0) << 5, 4, 3, 2, 1, 1, 2, 3, 4, 5, 6, 7;
  truth.behind.leftCols(5).setConstant(true);
  truth.shaded.leftCols(4).setConstant(true);
  truth.margin(0, 11) = true;
  truth.both_px(0, 10) = 0.0;
  StereoSums sums;
  AddPixels(truth, Matched(std::vector<double>(12, 4.25)), OneRow(12), kEverything, sums);
  EXPECT_EQ(sums.all.pixels, 10.0);
  EXPECT_EQ(sums.kinds[0].pixels, 2.0);  // 4 and 5 columns from the jump, lit
  EXPECT_EQ(sums.kinds[1].pixels, 3.0);  // up to 3, to the right of it
  EXPECT_EQ(sums.kinds[2].pixels, 3.0);  // and to the left, behind
  EXPECT_EQ(sums.kinds[3].pixels, 2.0);  // 5 and 4, in shadow
  EXPECT_EQ(sums.fronts[0].pixels, 1.0);
  EXPECT_EQ(sums.behinds[0].pixels, 1.0);
  EXPECT_EQ(sums.behinds[4].pixels, 1.0);
  EXPECT_EQ(sums.fronts[5].pixels, 0.0);  // what the left eye alone sees
  EXPECT_EQ(sums.margin.pixels, 1.0);
  EXPECT_EQ(sums.margin.good, 1.0);
  EXPECT_EQ(sums.hidden_pixels, 1.0);
  EXPECT_EQ(sums.hidden_matched, 1.0);
  // Pairs are of plain pixels only.
  EXPECT_EQ(sums.pairs[0], 1.0);
  EXPECT_DOUBLE_EQ(sums.products_px2[0], 0.0625);
}

TEST(PixelErrorsTest, ACellEndsBeforeItsFarthestDistance) {
  // Column 0 looks along the axis: ranges of 0.5, and in the next call 0.25 m.
  PixelLimits limits = kEverything;
  limits.nearest_m = 0.25;
  limits.farthest_m = 0.5;
  StereoSums sums;
  AddPixels(TruthOf({2}), Matched({2}), OneRow(1), limits, sums);
  EXPECT_EQ(sums.all.pixels, 0.0);
  AddPixels(TruthOf({4}), Matched({4}), OneRow(1), limits, sums);
  EXPECT_EQ(sums.all.pixels, 1.0);
  AddPixels(TruthOf({4.001}), Matched({4}), OneRow(1), limits, sums);
  EXPECT_EQ(sums.all.pixels, 1.0);
}

TEST(PixelErrorsTest, WhatIsNotSearchedDoesNotCount) {
  StereoSums sums;
  AddPixels(TruthOf({0.4, 0.5, 16, 16.1, 0}), Matched({0.5, 0.5, 16, 16, 4}), OneRow(5),
            kEverything, sums);
  EXPECT_EQ(sums.all.pixels, 2.0);
  EXPECT_EQ(sums.all.good, 2.0);
}

TEST(StereoColumnsTest, HoldEverySumAndEveryBase) {
  std::size_t known = 0;
  ForEachColumn(StereoSums{}, [&](const truth::ValueInfo& column, double) {
    EXPECT_NE(truth::FindColumn(StereoColumns(), column.name), nullptr) << column.name;
    ++known;
  });
  std::size_t summed = 0;
  for (const truth::ValueInfo& column : StereoColumns()) {
    if (column.role == truth::ColumnRole::kFactor) continue;
    ++summed;
    const bool refers = !truth::IsBase(column.role);
    EXPECT_EQ(column.of.empty(), !refers) << column.name;
    if (refers) {
      EXPECT_NE(truth::FindColumn(StereoColumns(), column.of), nullptr) << column.name;
    }
  }
  EXPECT_EQ(summed, known);
}

messages::MapView Map(int nx, int ny) {
  messages::MapView map;
  map.x0_m = -1.0;
  map.y0_m = -1.0;
  map.nx = nx;
  map.ny = ny;
  map.cells.assign(static_cast<std::size_t>(nx * ny), {true, 0.0, true, 255, 255});
  return map;
}

messages::MapCellView& CellAt(messages::MapView& map, int ix, int iy) {
  return map.cells[static_cast<std::size_t>(iy * map.nx + ix)];
}

TEST(LookMapTest, VerdictsFollowGoodnessWithinTheMap) {
  messages::MapView map = Map(10, 5);  // x from -1 to 1, y from -1 to 0
  CellAt(map, 3, 1).goodness = 42;
  CellAt(map, 4, 1).goodness = 43;
  CellAt(map, 5, 1).known = false;
  EXPECT_EQ(VerdictAt(map, -0.3, -0.7, 42.0), Verdict::kHazard);
  EXPECT_EQ(VerdictAt(map, -0.1, -0.7, 42.0), Verdict::kClear);
  EXPECT_EQ(VerdictAt(map, 0.1, -0.7, 42.0), Verdict::kUnknown);
  EXPECT_EQ(VerdictAt(map, 0.99, -0.01, 42.0), Verdict::kClear);
  EXPECT_EQ(VerdictAt(map, 1.0, -0.5, 42.0), Verdict::kUnknown);
  EXPECT_EQ(VerdictAt(map, 0.5, 0.0, 42.0), Verdict::kUnknown);
  EXPECT_EQ(VerdictAt(map, -1.01, -0.5, 42.0), Verdict::kUnknown);
}

// Level ground before the rover, 2 cm apart, with a step of the given height on a square of 40 cm
// around (1.5, 0).
messages::PointCloud GroundWithStep(double height_m) {
  messages::PointCloud cloud{
      .number = 0, .direction = messages::LookDirection::kAhead, .points_R = {}};
  for (int i = 0; i < 110; ++i) {
    for (int j = -60; j <= 60; ++j) {
      const double x_m = 0.5 + 0.02 * i;
      const double y_m = 0.02 * j;
      const bool on_step = std::abs(x_m - 1.5) < 0.2 && std::abs(y_m) < 0.2;
      cloud.points_R.emplace_back(x_m, y_m, on_step ? height_m : 0.0);
    }
  }
  return cloud;
}

TEST(LookMapTest, GestaltMarksAStepWhereItLiesInR) {
  navigation::NavigatorSet set = navigation::StandardNavigators();
  const navigation::NavigatorKind& gestalt = set.Named("gestalt");
  const messages::MapView high = MapOfLook(gestalt, GroundWithStep(0.3));
  EXPECT_EQ(VerdictAt(high, 1.5, 0.0, 42.0), Verdict::kHazard);
  EXPECT_EQ(VerdictAt(high, 1.1, 0.9, 42.0), Verdict::kClear);
  EXPECT_EQ(VerdictAt(high, -2.0, 0.0, 42.0), Verdict::kUnknown);
  const messages::MapView level = MapOfLook(gestalt, GroundWithStep(0.0));
  EXPECT_EQ(VerdictAt(level, 1.5, 0.0, 42.0), Verdict::kClear);
}

TEST(LookMapTest, ANavigatorWithoutAMapIsRefused) {
  const navigation::NavigatorSet set = navigation::StandardNavigators();
  EXPECT_THROW(MapOfLook(set.Named("pathfinder"), GroundWithStep(0.3)), std::runtime_error);
}

// An image of four pixels, all on one rock 2 m ahead.
struct RockInView {
  sensing::StereoView view;
  sensing::StereoTruth truth;
};

RockInView SeenRock() {
  RockInView seen;
  seen.view.columns = 4;
  seen.view.rows = 1;
  seen.view.focal_px = 10.0;
  seen.view.baseline_m = 0.1;
  seen.view.along_row = {0.0, -0.01, 0.0};
  seen.truth.both_px = sensing::DepthImage::Constant(1, 4, 0.5);  // Z = 1 / d = 2 m
  seen.truth.left_px = seen.truth.both_px;
  seen.truth.rocks = sensing::PixelNumbers::Constant(1, 4, 0);
  return seen;
}

StereoSums FindsOf(const RockInView& seen, double height_m, const messages::MapView& perfect,
                   const messages::MapView& map, const DistanceBin& bin = {1.0, 3.0}) {
  terrain::Rock rock = terrain::EllipsoidRock(2.1, 0.0, 0.0, 0.1, 0.1, height_m);
  StereoSums sums;
  AddRocksInView({}, terrain::FlatWith({rock}), seen.truth, seen.view, {perfect, map}, bin, sums);
  return sums;
}

messages::MapView HazardAt(double x_m, double y_m) {
  messages::MapView map = Map(20, 10);
  CellAt(map, static_cast<int>((x_m + 1.0) / 0.2), static_cast<int>((y_m + 1.0) / 0.2)).goodness =
      0;
  return map;
}

TEST(RockFindsTest, ARockIsFoundWhereItsVisibleMiddleIsAHazard) {
  const messages::MapView clear = Map(20, 10);
  const messages::MapView there = HazardAt(2.05, -0.05);
  const messages::MapView beside = HazardAt(2.25, -0.05);
  StereoSums sums = FindsOf(SeenRock(), 0.2, there, clear);
  EXPECT_EQ(sums.rocks[1].rocks, 1.0);
  EXPECT_EQ(sums.rocks[1].perfect, 1.0);
  EXPECT_EQ(sums.rocks[1].found, 0.0);
  sums = FindsOf(SeenRock(), 0.2, beside, there);
  EXPECT_EQ(sums.rocks[1].perfect, 0.0);
  EXPECT_EQ(sums.rocks[1].found, 1.0);
}

TEST(RockFindsTest, RocksAreCountedByHalvesOfTheHazardsHeight) {
  const messages::MapView clear = Map(20, 10);
  const auto class_of = [&](double height_m) {
    const StereoSums sums = FindsOf(SeenRock(), height_m, clear, clear);
    for (std::size_t i = 0; i < sums.rocks.size(); ++i) {
      if (sums.rocks[i].rocks == 1.0) return static_cast<int>(i);
    }
    return -1;
  };
  EXPECT_EQ(class_of(0.099), -1);
  EXPECT_EQ(class_of(0.101), 0);
  EXPECT_EQ(class_of(0.199), 0);
  EXPECT_EQ(class_of(0.201), 1);
  EXPECT_EQ(class_of(0.301), 2);
  EXPECT_EQ(class_of(0.401), 3);
  EXPECT_EQ(class_of(2.0), 3);
}

TEST(RockFindsTest, RocksOutOfViewOrOfTheBinDoNotCount) {
  const messages::MapView clear = Map(20, 10);
  EXPECT_EQ(FindsOf(SeenRock(), 0.2, clear, clear, {1.0, 1.9}).rocks[1].rocks, 0.0);
  EXPECT_EQ(FindsOf(SeenRock(), 0.2, clear, clear, {2.1, 3.0}).rocks[1].rocks, 0.0);
  RockInView seen = SeenRock();
  seen.truth.both_px(0, 0) = 0.0;  // three pixels are too few
  EXPECT_EQ(FindsOf(seen, 0.2, clear, clear).rocks[1].rocks, 0.0);
}

TEST(RockFindsTest, CellsAreHeldAgainstThoseOfPerfectMatches) {
  messages::MapView perfect = Map(20, 10);
  messages::MapView map = Map(20, 10);
  CellAt(perfect, 15, 5).goodness = 0;  // a hazard that is found
  CellAt(map, 15, 5).goodness = 0;
  CellAt(perfect, 15, 4).goodness = 10;  // one that is missed
  CellAt(map, 14, 4).goodness = 0;       // imagined
  CellAt(map, 14, 5).known = false;
  CellAt(perfect, 13, 5).known = false;  // nothing to compare with
  CellAt(map, 13, 5).goodness = 0;
  sensing::StereoView view;  // at the origin
  StereoSums sums;
  AddCellsOfMap({}, view, {perfect, map}, {0.0, 100.0}, sums);
  EXPECT_EQ(sums.hazard_cells, 2.0);
  EXPECT_EQ(sums.hazard_found, 1.0);
  EXPECT_EQ(sums.clear_cells, 200.0 - 3.0);
  EXPECT_EQ(sums.clear_known, 200.0 - 4.0);
  EXPECT_EQ(sums.imagined, 1.0);
  // Cells within 0.2 m of the origin: the four around it, whose middles are 0.14 m away.
  sums = {};
  AddCellsOfMap({}, view, {Map(20, 10), map}, {0.0, 0.2}, sums);
  EXPECT_EQ(sums.clear_cells, 4.0);
}

}  // namespace
}  // namespace rockyard::experiments

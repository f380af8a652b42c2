#include "experiments/stereo_sensing/look_map.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "experiments/stereo_sensing/rock_finds.h"
#include "navigation/navigator_set_params.h"
#include "terrain/placed_rocks.h"

namespace rockyard::experiments {
namespace {

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

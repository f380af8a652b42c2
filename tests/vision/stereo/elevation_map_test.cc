#include "vision/stereo/elevation_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rockyard::vision {
namespace {

using Eigen::Vector3d;

// Ahead is x, up is z: so right is -y.
std::vector<Vector3d> Slope() {
  std::vector<Vector3d> points;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 100; ++j) {
      const double x_m = 2.0 + 0.01 * (i + 0.5);
      const double y_m = -0.5 + 0.01 * (j + 0.5);
      points.emplace_back(x_m, y_m, 0.1 * x_m - 0.3 * y_m);
    }
  }
  return points;
}

TEST(ElevationMap, HoldsTheHeightsOfAPlane) {
  const std::vector<Vector3d> points = Slope();
  const ElevationGrid grid = GridOver(points, Vector3d::UnitX(), Vector3d::UnitZ(), 0.1);
  EXPECT_EQ(grid.right, -Vector3d::UnitY());
  EXPECT_EQ(grid.columns, 10);
  EXPECT_EQ(grid.rows, 20);
  EXPECT_NEAR(grid.away_from_m, 2.0, 1e-9);
  EXPECT_NEAR(grid.right_from_m, -0.5, 1e-9);
  const Image<float> heights_m = ElevationMap(points, grid);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      // The last row is nearest, column 0 is far to the left: at the largest y.
      const double x_m = 2.0 + 0.1 * (grid.rows - 1 - row + 0.5);
      const double y_m = 0.5 - 0.1 * (column + 0.5);
      EXPECT_NEAR(heights_m.At(column, row), 0.1 * x_m - 0.3 * y_m, 1e-6);
    }
  }
}

TEST(ElevationMap, HeightsCountUpwardsWhereTheFramePointsDown) {
  const std::vector<Vector3d> points{{1.05, 0.05, 2.0}, {1.05, 0.05, 4.0}};
  const ElevationGrid grid = GridOver(points, Vector3d::UnitX(), -Vector3d::UnitZ(), 0.1);
  EXPECT_EQ(grid.right, Vector3d::UnitY());
  const Image<float> heights_m = ElevationMap(points, grid);
  ASSERT_EQ(heights_m.width(), 1);
  EXPECT_FLOAT_EQ(heights_m.At(0, 0), -3.0F);
}

// One point in a hundred is a wrong match a kilometre away.
TEST(ElevationMap, StrayPointsDoNotWidenTheGrid) {
  std::vector<Vector3d> points = Slope();
  for (int i = 0; i < 100; ++i) points.emplace_back(1000.0, -1000.0, 0.0);
  const ElevationGrid grid = GridOver(points, Vector3d::UnitX(), Vector3d::UnitZ(), 0.1);
  EXPECT_LE(grid.columns, 11);
  EXPECT_LE(grid.rows, 21);
  const Image<float> heights_m = ElevationMap(points, grid);
  for (const float height_m : heights_m.values()) EXPECT_LT(std::abs(height_m), 1.0F);
}

TEST(ElevationMap, CellsGrowWhereThereWouldBeTooMany) {
  const std::vector<Vector3d> points{{0.0, 0.0, 0.0}, {50.0, 0.0, 0.0}, {100.0, 7.0, 0.0}};
  const ElevationGrid grid = GridOver(points, Vector3d::UnitX(), Vector3d::UnitZ(), 0.01, 50);
  EXPECT_GE(grid.cell_m, 2.0);
  EXPECT_LE(grid.rows, 50);
  EXPECT_GE(grid.rows, 45);
}

TEST(ElevationMap, CellsWithoutPointsAreUnknown) {
  const std::vector<Vector3d> points{{0.05, 0.05, 1.0}, {0.35, 0.05, 1.0}};
  const ElevationGrid grid = GridOver(points, Vector3d::UnitX(), Vector3d::UnitZ(), 0.1);
  const Image<float> heights_m = ElevationMap(points, grid);
  ASSERT_EQ(heights_m.height(), 4);
  EXPECT_FALSE(std::isnan(heights_m.At(0, 0)));
  EXPECT_TRUE(std::isnan(heights_m.At(0, 1)));
  EXPECT_FALSE(std::isnan(heights_m.At(0, 3)));
}

TEST(ElevationMap, OfNoPointsHasNoCells) {
  const ElevationGrid grid = GridOver({}, Vector3d::UnitX(), Vector3d::UnitZ(), 0.1);
  EXPECT_EQ(grid.columns, 0);
  EXPECT_TRUE(ElevationMap({}, grid).empty());
}

}  // namespace
}  // namespace rockyard::vision

#include "campaign/site/height_grid.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace rockyard::campaign {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

using image_files::RasterWindow;
using testing::DoubleNear;

HeightGrid GridOf(std::int64_t rows, std::int64_t columns, double (*height)(double, double)) {
  HeightGrid grid{1.0, rows, columns, {}};
  for (std::int64_t r = 0; r < rows; ++r) {
    for (std::int64_t c = 0; c < columns; ++c) {
      grid.heights_m.push_back(height(static_cast<double>(c), static_cast<double>(r)));
    }
  }
  return grid;
}

double Quadratic(double x, double y) { return 3.0 + 2.0 * x - y + 0.25 * x * x - 0.5 * x * y; }

TEST(CubicAtTest, IsExactForQuadratics) {
  const HeightGrid grid = GridOf(8, 9, Quadratic);
  for (double y = 1.0; y <= 6.0; y += 0.37) {
    for (double x = 1.0; x <= 7.0; x += 0.41) {
      ASSERT_THAT(CubicAt(grid.heights_m, 9, x, y), DoubleNear(Quadratic(x, y), 1e-12));
    }
  }
}

TEST(CubicAtTest, HasEveryNodeAndNothingBeyond) {
  HeightGrid grid = GridOf(5, 6, [](double x, double y) { return std::sin(7.0 * x + y); });
  for (std::int64_t r = 0; r < 5; ++r) {
    for (std::int64_t c = 0; c < 6; ++c) {
      const double height =
          CubicAt(grid.heights_m, 6, static_cast<double>(c), static_cast<double>(r));
      ASSERT_THAT(height, DoubleNear(grid.At(c, r), 1e-12));
    }
  }
  EXPECT_TRUE(std::isnan(CubicAt(grid.heights_m, 6, -0.1, 2.0)));
  EXPECT_TRUE(std::isnan(CubicAt(grid.heights_m, 6, 2.0, 4.1)));
  EXPECT_TRUE(std::isnan(CubicAt(grid.heights_m, 6, kGap, 2.0)));
  grid.At(3, 2) = kGap;
  EXPECT_TRUE(std::isnan(CubicAt(grid.heights_m, 6, 1.5, 1.5)));
  EXPECT_FALSE(std::isnan(CubicAt(grid.heights_m, 6, 0.5, 1.5)));
}

double DistanceOf(std::int64_t rows, std::int64_t columns) {
  return std::sqrt(static_cast<double>(rows * rows + columns * columns));
}

// Against all windows, one by one.
TEST(NearestCleanTest, IsTheNearestOfAll) {
  HeightGrid grid = GridOf(20, 30, [](double x, double y) {
    return std::fmod(7.0 * x + 13.0 * y, 41.0) < 1.0 ? kGap : 1.0;
  });
  grid.At(15, 10) = kGap;
  const RasterWindow around{100, 200, 20, 30};
  const RasterWindow wanted{108, 213, 4, 6};
  double nearest = 1e9;
  for (std::int64_t r = 0; r + 4 <= 20; ++r) {
    for (std::int64_t c = 0; c + 6 <= 30; ++c) {
      bool clean = true;
      for (std::int64_t i = 0; i < 24; ++i) clean &= !std::isnan(grid.At(c + i % 6, r + i / 6));
      if (clean) nearest = std::min(nearest, DistanceOf(r - 8, c - 13));
    }
  }
  const auto found = NearestClean(grid.heights_m, around, wanted);
  ASSERT_TRUE(found.has_value());
  EXPECT_GT(nearest, 0.0) << "or the test asks for nothing";
  EXPECT_DOUBLE_EQ(DistanceOf(found->row - 108, found->column - 213), nearest);
  EXPECT_EQ(found->rows, 4);
  EXPECT_EQ(found->columns, 6);
  const std::vector<double> none(600, kGap);
  EXPECT_FALSE(NearestClean(none, around, wanted).has_value());
}

TEST(FillGapsTest, PlanesComeBack) {
  const auto plane = [](double x, double y) { return 5.0 - 0.3 * x + 0.2 * y; };
  const HeightGrid whole = GridOf(30, 40, plane);
  HeightGrid grid = whole;
  for (std::int64_t r = 10; r < 16; ++r) {
    for (std::int64_t c = 20; c < 27; ++c) grid.At(c, r) = kGap;
  }
  EXPECT_EQ(FillGaps(grid), 42);
  for (std::size_t i = 0; i < grid.heights_m.size(); ++i) {
    ASSERT_THAT(grid.heights_m[i], DoubleNear(whole.heights_m[i], 2e-5)) << i;
  }
}

TEST(FillGapsTest, WideGapsAndManyAreLeft) {
  HeightGrid wide = GridOf(100, 100, Quadratic);
  for (std::int64_t r = 10; r < 21; ++r) {
    for (std::int64_t c = 10; c < 21; ++c) wide.At(c, r) = kGap;
  }
  EXPECT_FALSE(FillGaps(wide).has_value());
  HeightGrid many = GridOf(10, 10, Quadratic);
  for (std::int64_t i = 0; i < 6; ++i) many.At(i, i) = kGap;
  EXPECT_FALSE(FillGaps(many).has_value());
  many = GridOf(10, 10, Quadratic);
  for (std::int64_t i = 0; i < 5; ++i) many.At(i, i) = kGap;
  EXPECT_EQ(FillGaps(many), 5);
}

}  // namespace
}  // namespace rockyard::campaign

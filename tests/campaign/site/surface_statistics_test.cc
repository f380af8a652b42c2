// Against surfaces whose slopes and roughness are known. Fixed fields; bounds are some four
// deviations of what 20 others gave, so that alpha is below 1e-4.
#include "campaign/site/surface_statistics.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "terrain/relief.h"

namespace rockyard::campaign {
namespace {

using testing::DoubleNear;

constexpr std::int64_t kSide = 120;

// Terrain's own fractal at nodes 1 m apart, as means over squares of `width` m.
HeightGrid FractalGrid(double hurst, int width, std::uint64_t seed) {
  const terrain::RoughnessField field(1.0, hurst, 64.0, {seed, 0});
  const std::int64_t all = kSide + width - 1;
  std::vector<double> points;
  for (std::int64_t r = 0; r < all; ++r) {
    for (std::int64_t c = 0; c < all; ++c) {
      points.push_back(
          field.Sample(static_cast<double>(c) + 0.3, static_cast<double>(r) + 0.7).height_m);
    }
  }
  HeightGrid grid{1.0, kSide, kSide, {}};
  for (std::int64_t r = 0; r < kSide; ++r) {
    for (std::int64_t c = 0; c < kSide; ++c) {
      double sum = 0.0;
      for (std::int64_t i = 0; i < std::int64_t{width} * width; ++i) {
        sum += points[static_cast<std::size_t>((r + i / width) * all + c + i % width)];
      }
      grid.heights_m.push_back(sum / (width * width));
    }
  }
  return grid;
}

// RMS of the octaves of FractalGrid's field from a wavelength downwards.
double TrueRms(double hurst, double wavelength_m) {
  double below = 0.0;
  double whole = 0.0;
  for (int j = 0; 64.0 * std::exp2(-j) >= 0.1; ++j) {
    const double octave = std::exp2(-2.0 * hurst * j);
    whole += octave;
    if (64.0 * std::exp2(-j) <= 1.001 * wavelength_m) below += octave;
  }
  return std::sqrt(below / whole);
}

TEST(SlopesTest, OfAPlaneAndOfHalfOfOne) {
  HeightGrid grid{0.5, 20, 20, {}};
  for (int i = 0; i < 400; ++i) grid.heights_m.push_back(0.5 * (i % 20) * std::tan(0.1));
  const SlopeFigures slopes = SlopesOf(grid);
  EXPECT_THAT(slopes.median_deg, DoubleNear(0.1 * 180.0 / std::numbers::pi, 1e-9));
  EXPECT_THAT(slopes.high_deg, DoubleNear(slopes.median_deg, 1e-9));
  // A fifth of the nodes is steep, so that the median is 0.
  for (int i = 0; i < 400; ++i) grid.heights_m[i] = i % 20 < 16 ? 0.0 : 0.5 * (i % 20 - 15);
  EXPECT_EQ(SlopesOf(grid).median_deg, 0.0);
  EXPECT_THAT(SlopesOf(grid).high_deg, DoubleNear(45.0, 1e-9));
}

TEST(SecondIncrementsTest, PlanesAddNothingAndNoiseIsSixfold) {
  HeightGrid grid = FractalGrid(0.7, 1, 3);
  HeightGrid tilted = grid;
  for (std::int64_t r = 0; r < kSide; ++r) {
    for (std::int64_t c = 0; c < kSide; ++c) {
      tilted.At(c, r) += 0.4 * static_cast<double>(c) - 0.1 * static_cast<double>(r);
    }
  }
  EXPECT_NEAR(SecondIncrements(tilted, 3) / SecondIncrements(grid, 3), 1.0, 1e-9);
  // White noise of variance s has the increments s (1 + 4 + 1).
  const terrain::RoughnessField noise(1.0, 0.5, 0.2, {1, 0});
  for (std::int64_t i = 0; i < kSide * kSide; ++i) {
    grid.heights_m[static_cast<std::size_t>(i)] =
        noise.Sample(0.731 * static_cast<double>(i % kSide), 0.917 * static_cast<double>(i / kSide))
            .height_m;
  }
  EXPECT_NEAR(SecondIncrements(grid, 5), 6.0, 0.5);
  EXPECT_EQ(SecondIncrements(HeightGrid{1.0, 4, 4, std::vector<double>(16, 1.0)}, 2), 0.0);
}

TEST(ResolutionTest, IsTheWidthOfMeans) {
  for (const double hurst : {0.5, 0.7, 0.9}) {
    for (const int width : {2, 4, 8}) {
      const Resolution found = EstimateResolution(FractalGrid(hurst, width, 7));
      EXPECT_NEAR(found.effective_m / width, 1.0, 0.45) << hurst << " " << width;
      EXPECT_FALSE(found.at_least);
    }
    EXPECT_EQ(EstimateResolution(FractalGrid(hurst, 1, 7)).effective_m, 1.0);
  }
}

TEST(ResolutionTest, OfASmoothSurfaceIsABound) {
  HeightGrid bowl{1.0, 60, 60, {}};
  for (int i = 0; i < 3600; ++i)
    bowl.heights_m.push_back(0.01 * ((i % 60) * (i % 60) + (i / 60) * (i / 60)));
  const Resolution found = EstimateResolution(bowl);
  EXPECT_TRUE(found.at_least);
  EXPECT_GE(found.effective_m, 8.0);
}

TEST(RoughnessBelowTest, GoesOnWhereTheModelEnds) {
  for (const double hurst : {0.5, 0.7, 0.9}) {
    for (const int width : {1, 2, 4}) {
      const auto found = RoughnessBelow(FractalGrid(hurst, width, 11), width);
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(found->wavelength_m, width);
      EXPECT_NEAR(found->hurst, hurst, 0.12) << width;
      EXPECT_NEAR(found->rms_m / TrueRms(hurst, width), 1.0, 0.35) << hurst << " " << width;
    }
  }
}

// The negative control: a smoothed model that is taken for a sharp one has too little below it.
TEST(RoughnessBelowTest, OfAModelThatIsTakenForSharpIsTooSmall) {
  const auto found = RoughnessBelow(FractalGrid(0.5, 8, 11), 1.0);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(found->rms_m / TrueRms(0.5, 1.0), 0.65);
}

TEST(RoughnessBelowTest, NeedsRoomAndRelief) {
  const HeightGrid level{1.0, 30, 30, std::vector<double>(900, 2.0)};
  EXPECT_FALSE(RoughnessBelow(level, 1.0).has_value());
  EXPECT_FALSE(RoughnessBelow(FractalGrid(0.7, 1, 1), 40.0).has_value());
  HeightGrid fine = FractalGrid(0.7, 1, 1);
  fine.cell_m = 0.05;
  EXPECT_FALSE(RoughnessBelow(fine, 0.1).has_value()) << "no wheel notices";
  EXPECT_EQ(RoughnessBelow(fine, 0.4)->wavelength_m, 0.4);
}

}  // namespace
}  // namespace rockyard::campaign

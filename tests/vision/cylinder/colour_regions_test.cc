#include "vision/cylinder/colour_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/random.h"
#include "vision/cylinder/colour_model.h"
#include "vision/each_pixel.h"

namespace rockyard::vision {
namespace {

// Classes, gaps and regions of colours, by hand and against a flood fill.

using enum CylinderColour;

// b, m, r: the classes; anything else: background.
ClassImage Classes(const std::vector<std::string_view>& rows) {
  const auto width = static_cast<int>(rows.front().size());
  return ImageOf(width, static_cast<int>(rows.size()), [&](int x, int y) {
    const char letter = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
    const std::size_t place = std::string_view("bmr").find(letter);
    return place == std::string_view::npos ? kBackground : 1 + place;
  });
}

std::string Letters(const ClassImage& classes, int row) {
  std::string text;
  for (const std::uint8_t label : classes.Row(row)) text += ".bmr"[label];
  return text;
}

std::string Filled(std::string_view row, int longest = 4, int at_row = 0) {
  std::vector<std::string_view> rows(static_cast<std::size_t>(at_row + 1), row);
  ClassImage classes = Classes(rows);
  FillGaps(longest, classes);
  return Letters(classes, at_row);
}

TEST(ColourClassTest, SurfacesAreOfTheirClassesAndGroundIsOfNone) {
  const ColourClassParams params;
  const auto scaled = [](double red, double green, double blue, double exposure) {
    return Rgb{static_cast<std::uint8_t>(exposure * red),
               static_cast<std::uint8_t>(exposure * green),
               static_cast<std::uint8_t>(exposure * blue)};
  };
  for (const double exposure : {60.0, 120.0, 240.0}) {
    EXPECT_EQ(ClassOf(scaled(0.12, 0.30, 0.85, exposure), params), LabelOf(kBlue));
    EXPECT_EQ(ClassOf(scaled(0.95, 0.25, 0.60, exposure), params), LabelOf(kMagenta));
    EXPECT_EQ(ClassOf(scaled(1.00, 0.35, 0.10, exposure), params), LabelOf(kRed));
    EXPECT_EQ(ClassOf(scaled(0.45, 0.27, 0.16, exposure), params), kBackground);
    EXPECT_EQ(ClassOf(scaled(0.15, 0.80, 0.25, exposure), params), kBackground);
  }
  const ColourClassParams green{.red = GreenRatios()};
  EXPECT_EQ(ClassOf(scaled(0.15, 0.80, 0.25, 240.0), green), LabelOf(kRed));
}

TEST(ColourClassTest, RangesHoldTheirEndsAndDarkPixelsHaveNoClass) {
  ColourClassParams params{.magenta = {PrimaryColour::kRed, 0.2, 0.4, 0.5, 0.8},
                           .red = {PrimaryColour::kRed, 0.2, 0.4, 0.1, 0.2}};
  EXPECT_EQ(ClassOf({100, 20, 50}, params), LabelOf(kMagenta));
  EXPECT_EQ(ClassOf({100, 40, 80}, params), LabelOf(kMagenta));
  EXPECT_EQ(ClassOf({100, 19, 50}, params), kBackground);
  EXPECT_EQ(ClassOf({100, 41, 80}, params), kBackground);
  EXPECT_EQ(ClassOf({100, 20, 49}, params), kBackground);
  EXPECT_EQ(ClassOf({100, 20, 81}, params), kBackground);
  EXPECT_EQ(ClassOf({100, 30, 15}, params), LabelOf(kRed));
  params.darkest = 50.0;
  EXPECT_EQ(ClassOf({50, 15, 30}, params), LabelOf(kMagenta));
  EXPECT_EQ(ClassOf({49, 15, 30}, params), kBackground);
  EXPECT_EQ(ClassOf({0, 0, 0}, params), kBackground);
}

TEST(ColourClassTest, RowsAboveTheAreaOfInterestAreBackground) {
  const ColourImage image(3, 4, {240, 60, 144});
  const ClassImage classes = ClassifyColours(image, 2, {});
  EXPECT_EQ(Letters(classes, 1), "...");
  EXPECT_EQ(Letters(classes, 2), "mmm");
}

TEST(FillGapsTest, OneToFourPixelsBetweenTwoColoursAreFilledFromBothSides) {
  EXPECT_EQ(Filled("bb..mm"), "bbbmmm");
  EXPECT_EQ(Filled("b....m"), "bbbmmm");
  EXPECT_EQ(Filled("b.m"), "bbm");
  EXPECT_EQ(Filled("b...m"), "bbbmm");
  EXPECT_EQ(Filled("b.....m"), "b.....m");
  EXPECT_EQ(Filled("b..m", 1), "b..m");
  EXPECT_EQ(Filled("b.m..r.b"), "bbmmrrrb");
}

TEST(FillGapsTest, TheMiddleOfAnOddGapAlternatesWithTheRow) {
  EXPECT_EQ(Filled("b.m", 4, 1), "bmm");
  EXPECT_EQ(Filled("b...m", 4, 1), "bbmmm");
  EXPECT_EQ(Filled("b..m", 4, 1), "bbmm");
}

TEST(FillGapsTest, GapsOfOneColourAndAtEndsStay) {
  EXPECT_EQ(Filled("b..b"), "b..b");
  EXPECT_EQ(Filled("..b.."), "..b..");
  EXPECT_EQ(Filled("bm"), "bm");
  EXPECT_EQ(Filled("....."), ".....");
}

TEST(ColourRegionsTest, CornersDoNotTouchAndMixturesHangTogether) {
  const ClassImage classes = Classes({"bb...m",  //
                                      "..rr.m",  //
                                      ".mr..."});
  const auto any = FindRegions(classes, WholeOf(classes), RegionColours::kAny);
  ASSERT_EQ(any.size(), 3U);
  EXPECT_EQ(any[0].pixels, 2);
  EXPECT_EQ(any[1].pixels, 2);
  const ColourRegion& mixed = any[2];
  EXPECT_EQ(mixed.pixels, 4);
  EXPECT_FALSE(mixed.colour);
  EXPECT_EQ((std::array{mixed.left, mixed.top, mixed.right, mixed.bottom}),
            (std::array{1, 1, 3, 2}));
  EXPECT_DOUBLE_EQ(mixed.centroid.x(), 2.0);
  EXPECT_DOUBLE_EQ(mixed.centroid.y(), 1.5);
  const auto single = FindRegions(classes, WholeOf(classes), RegionColours::kSingle);
  ASSERT_EQ(single.size(), 4U);
  EXPECT_EQ(single[2].colour, kRed);
  EXPECT_EQ(single[2].pixels, 3);
  EXPECT_EQ(single[3].colour, kMagenta);
}

TEST(ColourRegionsTest, PartsOfAnImageEndWhereTheyEnd) {
  const ClassImage classes = Classes({"bbbb", "bbbb", "bbbb"});
  const auto regions = FindRegions(classes, {1, 1, 2, 2}, RegionColours::kAny);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].pixels, 4);
  EXPECT_EQ(regions[0].left, 1);
  EXPECT_EQ(regions[0].top, 1);
}

TEST(ColourRegionsTest, ShapesThatMeetBelowAreOneRegion) {
  const ClassImage classes = Classes({"b.b.b",  //
                                      "b.b.b",  //
                                      "bbbbb"});
  const auto regions = FindRegions(classes, WholeOf(classes), RegionColours::kSingle);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].pixels, 11);
}

// Sizes of regions by a flood fill, sorted.
std::vector<int> FloodedSizes(ClassImage classes, RegionColours colours) {
  std::vector<int> sizes;
  for (int y = 0; y < classes.height(); ++y) {
    for (int x = 0; x < classes.width(); ++x) {
      if (classes.At(x, y) == kBackground) continue;
      const std::uint8_t start = classes.At(x, y);
      std::vector<std::pair<int, int>> stack = {{x, y}};
      int pixels = 0;
      while (!stack.empty()) {
        const auto [i, j] = stack.back();
        stack.pop_back();
        if (i < 0 || j < 0 || i >= classes.width() || j >= classes.height()) continue;
        const std::uint8_t label = classes.At(i, j);
        if (label == kBackground || (colours == RegionColours::kSingle && label != start)) continue;
        classes.At(i, j) = kBackground;
        ++pixels;
        for (const auto& [di, dj] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          stack.emplace_back(i + di, j + dj);
        }
      }
      sizes.push_back(pixels);
    }
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

TEST(ColourRegionsTest, RandomImagesHaveTheRegionsOfAFloodFill) {
  for (std::uint32_t i = 0; i < 60; ++i) {
    core::RandomStream stream({7, i}, core::Purpose::kTest);
    ClassImage classes(1 + static_cast<int>(20 * stream.Uniform()),
                       1 + static_cast<int>(20 * stream.Uniform()));
    const double density = stream.Uniform();
    for (std::uint8_t& label : classes.values()) {
      label = stream.Uniform() < density ? static_cast<std::uint8_t>(1 + 3 * stream.Uniform())
                                         : kBackground;
    }
    for (const RegionColours colours : {RegionColours::kAny, RegionColours::kSingle}) {
      std::vector<int> sizes;
      const auto regions = FindRegions(classes, WholeOf(classes), colours);
      for (const ColourRegion& region : regions) sizes.push_back(region.pixels);
      std::sort(sizes.begin(), sizes.end());
      EXPECT_EQ(sizes, FloodedSizes(classes, colours)) << i;
    }
  }
}

TEST(ColourRegionsTest, TheLargestIsTheFirstOfSeveral) {
  EXPECT_FALSE(LargestOf({}));
  ColourRegion small;
  small.pixels = 3;
  ColourRegion large;
  large.left = 1;
  large.pixels = 5;
  ColourRegion other = large;
  other.left = 2;
  EXPECT_EQ(LargestOf({small, large, other})->left, 1);
}

// Colours of the quadrants against those of the surfaces.

const std::vector<CylinderColour> kAll = {CylinderColour::kBlue, CylinderColour::kMagenta,
                                          CylinderColour::kRed};

// What the surfaces look like in a light, before a camera of a saturation.
std::vector<SeenColour> SeenIn(const LogRatios& light, double saturation, double variance) {
  std::vector<SeenColour> seen;
  for (const CylinderColour colour : kAll) {
    seen.push_back({colour, light + saturation * SurfaceOf(colour, {}),
                    variance * Eigen::Matrix2d::Identity()});
  }
  return seen;
}

double SquaresOf(const std::vector<SeenColour>& seen, const LogRatios& light = LogRatios::Zero()) {
  const std::vector<double> residuals = ColourResiduals(seen, light, {}, {});
  EXPECT_EQ(residuals.size(), 2 * seen.size() + 3);
  return std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
}

// The same for one light and one saturation, term by term.
double PlainSquares(const std::vector<SeenColour>& seen, const LogRatios& light,
                    double saturation) {
  const ColourModelParams params;
  double squares = light.squaredNorm() / std::pow(params.light_sd, 2) +
                   std::pow((saturation - params.saturation) / params.saturation_sd, 2);
  for (const SeenColour& colour : seen) {
    const Eigen::Matrix2d covariance =
        colour.covariance + std::pow(params.surface_sd, 2) * Eigen::Matrix2d::Identity();
    const LogRatios left = colour.ratios - light - saturation * SurfaceOf(colour.colour, {});
    squares += left.dot(covariance.inverse() * left);
  }
  return squares;
}

TEST(ColourModel, ResidualsAreThoseOfTheBestLightAndSaturation) {
  std::vector<SeenColour> seen = SeenIn({0.1, -0.2}, 0.7, 0.02);
  seen[0].ratios += LogRatios(0.3, -0.1);
  seen[0].covariance << 0.5, 0.2, 0.2, 0.1;
  seen[2].ratios += LogRatios(-0.2, 0.4);
  // By a grid over the three unknowns, 0.01 apart.
  double least = std::numeric_limits<double>::infinity();
  for (int red = -50; red <= 50; ++red) {
    for (int blue = -50; blue <= 50; ++blue) {
      for (int saturation = 40; saturation <= 110; ++saturation) {
        least = std::min(least, PlainSquares(seen, {0.01 * red, 0.01 * blue}, 0.01 * saturation));
      }
    }
  }
  EXPECT_LE(SquaresOf(seen), least);
  EXPECT_NEAR(SquaresOf(seen), least, 0.02);
}

TEST(ColourModel, TheSurfacesInAnyLikelyLightAreThemselves) {
  for (const double light : {-0.2, 0.0, 0.2}) {
    for (const double saturation : {0.65, 0.8, 0.95}) {
      EXPECT_LT(SquaresOf(SeenIn({light, -light}, saturation, 0.01)), 3.0);
      EXPECT_LT(SquaresOf(SeenIn({light, -light}, saturation, 0.01), {light, -light}), 1.0);
    }
  }
  // Controls: blue and orange, or blue and pink, that changed their places.
  for (const std::size_t other : {1U, 2U}) {
    std::vector<SeenColour> swapped = SeenIn(LogRatios::Zero(), 0.8, 0.01);
    std::swap(swapped[0].ratios, swapped[other].ratios);
    EXPECT_GT(SquaresOf(swapped), 20.0);
  }
}

// A ratio that nobody knows excuses none that is known: orange too dark in red to tell its red over
// green, and blue.
TEST(ColourModel, EachRatioCountsByWhatIsKnownOfIt) {
  std::vector<SeenColour> seen = SeenIn(LogRatios::Zero(), 0.8, 0.01);
  seen[2].ratios[1] = 1.1;
  seen[2].covariance = Eigen::Vector2d(100.0, 0.01).asDiagonal();
  EXPECT_GT(SquaresOf(seen), 20.0);
  // Control: the mean of both variances for both.
  seen[2].covariance = Eigen::Vector2d(50.0, 50.0).asDiagonal();
  EXPECT_LT(SquaresOf(seen), 3.0);
}

TEST(ColourModel, WhiteningIsTheInverseRoot) {
  Eigen::Matrix2d covariance;
  covariance << 2.0, 0.7, 0.7, 0.5;
  const Eigen::Matrix2d whitening = WhiteningOf(covariance);
  EXPECT_TRUE((whitening * covariance * whitening).isIdentity(1e-12));
  EXPECT_TRUE(whitening.isApprox(whitening.transpose()));
}

TEST(ColourModel, DirectionsAreThoseOfTheSurfaces) {
  ColourModelParams plain{.saturation = 1.0};
  const SurfaceColourParams surfaces;
  const Eigen::Vector3d blue(surfaces.blue[0], surfaces.blue[1], surfaces.blue[2]);
  const Eigen::Vector3d light(1.5, 1.0, 0.8);
  const Eigen::Vector3d seen =
      DirectionOf(CylinderColour::kBlue, LogRatiosOf(100.0 * light), surfaces, plain);
  EXPECT_TRUE(seen.isApprox(light.cwiseProduct(blue).normalized(), 1e-9));
  EXPECT_NEAR(seen.norm(), 1.0, 1e-12);
  // Crosstalk draws it towards the light's.
  plain.saturation = 0.0;
  EXPECT_TRUE(DirectionOf(CylinderColour::kBlue, LogRatiosOf(100.0 * light), surfaces, plain)
                  .isApprox(light.normalized(), 1e-9));
}

}  // namespace
}  // namespace rockyard::vision

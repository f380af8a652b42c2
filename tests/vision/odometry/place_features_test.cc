// Places of features: differences along rows, fractions of a pixel, and covariances.

#include "vision/odometry/place_features.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include "core/random.h"
#include "vision/cameras/rectification.h"
#include "vision/each_pixel.h"
#include "vision/odometry/refine_match.h"
#include "vision/odometry/synthetic_sequence.h"
#include "vision/odometry/window_samples.h"
#include "vision/stereo/instruction_sets.h"

namespace rockyard::vision {
namespace {

constexpr ImageSize kSize{256, 192};

GrayImage Noise(int width, int height, std::uint32_t number) {
  core::RandomStream stream({256, 0}, core::Purpose::kTest, number);
  return ImageOf(width, height, [&](int, int) { return stream.NextU32() & 0xFF; });
}

std::uint32_t PlainDifference(const GrayImage& left, const GrayImage& right, int column, int row,
                              int disparity) {
  std::uint32_t sum = 0;
  for (int y = row - 7; y <= row + 7; ++y) {
    for (int x = column - 7; x <= column + 7; ++x) {
      sum += static_cast<std::uint32_t>(
          std::abs(int{left.At(x, y)} - int{right.At(x - disparity, y)}));
    }
  }
  return sum;
}

// At every corner of what is allowed, of noise and of black on white, on every instruction set.
TEST(RowDifferencesTest, AreThoseOfThePlainSums) {
  const GrayImage black(70, 20, 0);
  const GrayImage white(70, 20, 255);
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    for (const auto& [left, right] :
         {std::pair{Noise(70, 20, 1), Noise(70, 20, 2)}, std::pair{black, white}}) {
      for (const int column : {40, 54, 61}) {
        for (const int row : {7, 10, 12}) {
          const int first = column - 61;  // the right window ends at the last column but one
          std::vector<std::uint16_t> differences(static_cast<std::size_t>(column - 7 - first) + 1);
          RowDifferences(left, right, column, row, first, differences);
          for (std::size_t i = 0; i < differences.size(); ++i) {
            ASSERT_EQ(differences[i],
                      PlainDifference(left, right, column, row, first + static_cast<int>(i)))
                << column << " " << row << " " << i;
          }
        }
      }
    }
  }
}

// A plain sum in the order of the lanes, to the bit, on every instruction set.
TEST(TemplateSumsTest, AreThePlainSumsToTheBit) {
  const GrayImage image = Noise(40, 20, 3);
  core::RandomStream stream({257, 0}, core::Purpose::kTest, 0);
  std::array<std::array<float, kTemplateRows * kTemplateLanes>, 3> rows{};
  for (auto& numbers : rows) {
    for (float& number : numbers) number = static_cast<float>(core::SampleUniform(stream, -60, 60));
  }
  const TemplatePlace place{&image.At(5, 2), 40, 0.3F, 0.7F};
  const auto plain_sums = [&](std::size_t side) {
    TemplateSums plain;
    for (std::size_t row = 0; row < side; ++row) {
      for (std::size_t i = 0; i < kTemplateLanes; ++i) {
        const auto grey = [&](int right, int below) {
          return static_cast<float>(
              image.At(5 + static_cast<int>(i) + right, 2 + static_cast<int>(row) + below));
        };
        const float upper =
            (1.0F - 0.3F) * (1.0F - 0.7F) * grey(0, 0) + 0.3F * (1.0F - 0.7F) * grey(1, 0);
        const float lower = (1.0F - 0.3F) * 0.7F * grey(0, 1) + 0.3F * 0.7F * grey(1, 1);
        const std::size_t at = row * kTemplateLanes + i;
        const float d = upper + lower - 101.25F - rows[0][at];
        plain.d[i] += d;
        plain.across_d[i] += rows[1][at] * d;
        plain.down_d[i] += rows[2][at] * d;
        plain.squares[i] += d * d;
      }
    }
    return plain;
  };
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    for (const std::size_t side : {5U, 9U, 15U}) {
      TemplateSums sums;
      SumTemplate({rows[0].data(), rows[1].data(), rows[2].data(), 101.25F, side}, place, sums);
      const TemplateSums plain = plain_sums(side);
      EXPECT_EQ(sums.d, plain.d);
      EXPECT_EQ(sums.across_d, plain.across_d);
      EXPECT_EQ(sums.down_d, plain.down_d);
      EXPECT_EQ(sums.squares, plain.squares);
    }
  }
}

// Of an image of 30 x 20 pixels, for windows of 15 and of 9 pixels; of these the last row that is
// read, of 17 pixels, may not end behind the image.
TEST(TemplateSumsTest, KnowsWhichWindowsAnImageHas) {
  const GrayImage image(30, 20);
  for (const auto& [side, reach] : {std::pair{15U, 7.0}, std::pair{9U, 4.0}}) {
    const auto has = [&](double x, double y) { return HasTemplate(image, {x, y}, side); };
    EXPECT_TRUE(has(reach, reach));
    EXPECT_FALSE(has(reach - 0.01, reach));
    EXPECT_FALSE(has(reach, reach - 0.01));
    EXPECT_TRUE(has(30.0 - reach - 2.01, reach));
    EXPECT_FALSE(has(30.0 - reach - 2.0, reach));
    EXPECT_TRUE(has(reach, 20.0 - reach - 1.01));
    EXPECT_FALSE(has(reach, 20.0 - reach - 1.0));
    EXPECT_FALSE(has(std::nan(""), reach));
  }
  EXPECT_TRUE(HasTemplate(image, {17.9, 14.9}, 9));
  EXPECT_FALSE(HasTemplate(image, {18.0, 14.9}, 9));
  EXPECT_TRUE(HasTemplate(image, {18.0, 13.9}, 9));
}

// Features of a plane: the place on it, within the covariance that is told, and its disparity free
// of bias. Means over some 200 features, whose windows overlap little.
TEST(FeaturePlacerTest, PlacesFeaturesOnThePlaneThatTheyAreOf) {
  const RectifiedPair pair = PlanePair(kSize);
  const AlignedImages images = SeePlane(pair, math::Transform::Identity(), {}, 0);
  const Features features = FeatureDetector({}, kSize).Detect(images.left);
  const PlacementParams params;
  const FeaturePlacer placer(pair, params, images.left, images.right);
  int wrong = 0;  // another place altogether
  double sum_px = 0.0, squares_px2 = 0.0, count = 0.0;
  for (const Feature& feature : features) {
    const Pixel pixel(feature.column, feature.row);
    const auto place = placer.Place(pixel, 0.04 * Eigen::Matrix2d::Identity());
    if (!place) continue;
    const double truth_px = PlaneDisparity_px(pair, pixel);
    const double off_px = place->disparity_px - truth_px;
    if (std::abs(off_px) > 0.5) {
      ++wrong;
      continue;
    }
    EXPECT_EQ(place->left, pixel);
    EXPECT_DOUBLE_EQ(place->covariance_px2(0, 0), 0.04);
    EXPECT_DOUBLE_EQ(place->covariance_px2(0, 2), 0.0);
    EXPECT_GE(place->covariance_px2(2, 2), params.noise_px * params.noise_px);
    const auto point = Triangulate(pair.left, pair.right, pixel, place->disparity_px);
    EXPECT_EQ(place->p_A, point->p_A);
    EXPECT_EQ(place->covariance_m2, point->Covariance(place->covariance_px2));
    sum_px += off_px;
    squares_px2 += off_px * off_px;
    count += 1.0;
  }
  ASSERT_GT(count, 0.7 * static_cast<double>(features.size()));
  EXPECT_LE(wrong, 3);
  EXPECT_LT(std::abs(sum_px / count), 0.03);
  EXPECT_LT(std::sqrt(squares_px2 / count), 0.12);
}

// A pattern whose gradients do not cancel over a window, moved by a fraction of a pixel and taken
// under other light: the place is that of the pattern, whatever the light adds.
TEST(WindowTemplateTest, FindsFractionsOfPixelsUnderOtherLight) {
  const auto pattern = [](double x, double y, double brighter) {
    return ImageOf(60, 60, [&](int column, int row) {
      const double u = column - x;
      const double v = row - y;
      return std::lround(40.0 + brighter + 1.2 * u + 0.8 * v + 25.0 * std::sin(0.45 * u) +
                         20.0 * std::cos(0.5 * v + 0.1 * u));
    });
  };
  const GrayImage first = pattern(0.0, 0.0, 0.0);
  for (const std::size_t side : {9U, 15U}) {
    const WindowTemplate window(first, {30.0, 30.0}, {}, side);
    for (const double brighter : {0.0, 30.0}) {
      const auto found = window.Find(pattern(0.3, -0.4, brighter), {30.0, 30.0}, {});
      ASSERT_TRUE(found) << brighter;
      EXPECT_NEAR(found->pixel.x(), 30.3, 0.03) << brighter;
      EXPECT_NEAR(found->pixel.y(), 29.6, 0.03) << brighter;
    }
  }
  const WindowTemplate flat(GrayImage(60, 60, 90), {30.0, 30.0});
  EXPECT_FALSE(flat.Find(first, {30.0, 30.0}, {}));
  EXPECT_FALSE(flat.Find(first, {30.0, 30.0}, {.along_row = true}));
}

// Windows along the row alone, as WindowTemplate has found them: their variance is the place's.
TEST(FeaturePlacerTest, HasTheVarianceOfTheWindowThatItFound) {
  const RectifiedPair pair = PlanePair(kSize);
  const AlignedImages images = SeePlane(pair, math::Transform::Identity(), {}, 0);
  PlacementParams params;
  const Pixel pixel(150, 110);
  for (const std::int64_t window_px : {9, 15}) {
    params.window_px = window_px;
    const auto place = FeaturePlacer(pair, params, images.left, images.right)
                           .PlaceOn(DisparitySlope::Zero(), pixel, Eigen::Matrix2d::Identity());
    ASSERT_TRUE(place);
    const auto found =
        WindowTemplate(images.left, pixel, ViewChange{}, static_cast<std::size_t>(window_px))
            .Find(images.right, Pixel(pixel.x() - std::round(place->disparity_px), pixel.y()),
                  {.along_row = true, .noise_px = params.noise_px});
    ASSERT_TRUE(found);
    EXPECT_NEAR(place->covariance_px2(2, 2), found->covariance_px2(0, 0),
                1e-3 * found->covariance_px2(0, 0));
  }
}

// A window of noise that the right eye sees twice, off by 10 grey levels at 40 px and by more at
// another disparity, nearer or farther.
TEST(FeaturePlacerTest, HasNoPlaceWhereAnotherDisparityIsAlmostAsGood) {
  constexpr ImageSize kWide{120, 40};
  const Pixel pixel(80, 20);
  GrayImage left = Noise(kWide.columns, kWide.rows, 4);
  for (std::uint8_t& value : left.values()) value = static_cast<std::uint8_t>(value / 2 + 60);
  const auto placed = [&](int other_px, int other_off) {
    GrayImage right = Noise(kWide.columns, kWide.rows, 5);
    for (const auto& [disparity_px, off] : {std::pair{40, 10}, std::pair{other_px, other_off}}) {
      for (int y = 11; y <= 29; ++y) {
        for (int x = 71; x <= 89; ++x) {
          const int grey = left.At(x, y) + ((x + y) % 2 == 0 ? off : -off);
          right.At(x - disparity_px, y) = static_cast<std::uint8_t>(grey);
        }
      }
    }
    return FeaturePlacer(PlanePair(kWide), {}, left, right)
        .Place(pixel, Eigen::Matrix2d::Identity());
  };
  for (const int other_px : {15, 65}) {
    EXPECT_FALSE(placed(other_px, 11)) << other_px;
    const auto place = placed(other_px, 12);  // more than a ninth worse
    ASSERT_TRUE(place) << other_px;
    EXPECT_NEAR(place->disparity_px, 40.0, 0.1);
  }
}

TEST(FeaturePlacerTest, HasNoPlaceWhereItCannotBeSure) {
  const RectifiedPair pair = PlanePair(kSize);
  const AlignedImages images = SeePlane(pair, math::Transform::Identity(), {}, 0);
  const Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  const Pixel middle(150, 110);
  const auto placed = [&](const PlacementParams& params, const AlignedImages& seen,
                          const Pixel& pixel) {
    return FeaturePlacer(pair, params, seen.left, seen.right).Place(pixel, covariance).has_value();
  };
  ASSERT_TRUE(placed({}, images, middle));
  // Beyond the images' edges.
  EXPECT_FALSE(placed({}, images, {6, 110}));
  EXPECT_FALSE(placed({}, images, {250, 110}));
  EXPECT_FALSE(placed({}, images, {150, 6}));
  EXPECT_FALSE(placed({}, images, {150, 185}));
  // Disparities of the plane lie outside of the range.
  EXPECT_FALSE(placed({.min_disparity_px = 60.0}, images, middle));
  EXPECT_FALSE(placed({.max_disparity_px = 8.0}, images, middle));
  // No texture, and one that repeats every 12 px.
  const AlignedImages blank{GrayImage(kSize.columns, kSize.rows, 90),
                            GrayImage(kSize.columns, kSize.rows, 90)};
  EXPECT_FALSE(placed({}, blank, middle));
  const auto waves = [](double phase) {
    return ImageOf(kSize.columns, kSize.rows, [&](int x, int) {
      return std::lround(110 + 50 * std::cos(2.0 * std::numbers::pi * x / 12.0 + phase));
    });
  };
  EXPECT_FALSE(placed({}, {waves(0.0), waves(2.0)}, middle));
}

}  // namespace
}  // namespace rockyard::vision

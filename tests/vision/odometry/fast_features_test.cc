// Features and matches have the bits of their plain definitions, with every instruction set.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/random.h"
#include "plain_features.h"
#include "textured_image.h"
#include "vision/each_pixel.h"
#include "vision/odometry/best_matches.h"
#include "vision/odometry/detect_features.h"
#include "vision/odometry/harris.h"
#include "vision/odometry/match_features.h"
#include "vision/odometry/window.h"
#include "vision/stereo/correlator.h"
#include "vision/stereo/instruction_sets.h"

namespace rockyard::vision {
namespace {

// Few features a region, weak corners too: small images have some.
FeatureDetectorParams SmallParams(Adapted adapted) {
  return {.regions_across = 2,
          .regions_down = 2,
          .min_features = 3,
          .max_features = 9,
          .adapted = adapted,
          .border_px = 4};
}

void ExpectSameFeatures(const GrayImage& image, const FeatureDetectorParams& params,
                        const Image<std::uint8_t>& free = {}) {
  const Features expected = PlainFeatures(image, params, free);
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    const FeatureDetector detector(params, {image.width(), image.height()}, free);
    ASSERT_EQ(detector.Detect(image), expected)
        << image.width() << " x " << image.height() << ", " << InstructionSet();
  }
}

std::vector<GrayImage> VariedImages(int width, int height, std::uint32_t number) {
  const WaveTexture texture(number, 4.0, 20.0);
  return {texture.Render(width, height, 0.0, 0.0, 25.0, 1.5, 0),
          texture.Render(width, height, 0.0, 0.0, 2.0, 0.5, 0),
          texture.Render(width, height, 0.0, 0.0, 400.0, 0.0, 0),
          RandomImage(width, height, 256, number),
          RandomImage(width, height, 2, number + 1),
          GrayImage(width, height, 255)};
}

void ExpectSameResponse(const GrayImage& image, const ImageArea& area, double weight) {
  const std::int32_t whole = HarrisWeight(weight);
  const Image<std::int64_t> expected = PlainResponse(image, whole);
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    const GradientSums sums(image, area);
    HarrisRows rows(image, area, whole);
    AlignedBuffer<std::int32_t> kept(static_cast<std::size_t>(area.width()) + 64);
    AlignedBuffer<std::int32_t> passing(kept.size());
    for (int y = area.top; y < area.bottom; ++y) {
      sums.WriteResponse(y, whole, kept.data());
      rows.WriteResponse(y, passing.data());
      for (int x = area.left; x < area.right; ++x) {
        for (const auto& response : {std::cref(kept), std::cref(passing)}) {
          ASSERT_EQ(response.get().data()[x - area.left], expected.At(x, y))
              << "(" << x << ", " << y << ") of " << image.width() << " x " << image.height()
              << ", " << InstructionSet();
        }
      }
    }
  }
}

// Black and white pixels have the steepest slopes there are.
TEST(FastFeaturesTest, ResponsesOfEveryAreaAndWeight) {
  for (const int levels : {2, 17, 256}) {
    const GrayImage image = RandomImage(83, 21, levels, 40U);
    for (const double weight : {0.0, 0.04, 0.15, 0.25}) {
      for (const ImageArea& area :
           {ImageArea{0, 83, 0, 21}, ImageArea{3, 80, 3, 18}, ImageArea{1, 2, 4, 5},
            ImageArea{2, 70, 17, 21}, ImageArea{40, 83, 0, 4}, ImageArea{81, 83, 5, 9},
            ImageArea{5, 5, 0, 9}, ImageArea{17, 40, 9, 15}}) {
        ExpectSameResponse(image, area, weight);
      }
    }
  }
}

TEST(FastFeaturesTest, ResponsesOfImagesOfEverySize) {
  for (int width = 1; width <= 40; ++width) {
    const int height = 1 + (7 * width) % 11;
    ExpectSameResponse(RandomImage(width, height, 2, 50U), {0, width, 0, height}, 0.04);
  }
}

// Two columns of black and white, or two rows, or four squares: the largest sums of every kind.
TEST(FastFeaturesTest, TheSteepestSlopesFit) {
  for (int kind = 0; kind < 4; ++kind) {
    const GrayImage image = ImageOf(24, 24, [&](int x, int y) {
      const bool on_x = x % 4 < 2;
      const bool on_y = y % 4 < 2;
      const bool on = kind == 0   ? on_x
                      : kind == 1 ? on_y
                      : kind == 2 ? on_x != on_y
                                  : (x + y) % 4 < 2;
      return on ? 255 : 0;
    });
    for (const double weight : {0.0, 0.25}) ExpectSameResponse(image, {0, 24, 0, 24}, weight);
  }
}

TEST(FastFeaturesTest, FeaturesOfManyImages) {
  for (std::uint32_t number = 0; number < 6; ++number) {
    for (const GrayImage& image : VariedImages(90 + 7 * static_cast<int>(number), 61, number)) {
      for (const Adapted adapted : {Adapted::kThreshold, Adapted::kWeight}) {
        ExpectSameFeatures(image, SmallParams(adapted));
      }
    }
  }
}

TEST(FastFeaturesTest, FeaturesOfTinyImages) {
  FeatureDetectorParams params = SmallParams(Adapted::kThreshold);
  for (int width = 1; width <= 24; ++width) {
    params.regions_across = 1 + width % 4;
    for (const int height : {1, 3, 9, 14}) {
      ExpectSameFeatures(RandomImage(width, height, 256, 60U), params);
    }
  }
}

// A threshold of nothing makes a corner of the first pixel of every flat patch, so that equal
// responses meet each other.
TEST(FastFeaturesTest, FeaturesOfEveryReachAndThreshold) {
  FeatureDetectorParams params = SmallParams(Adapted::kThreshold);
  GrayImage patches = RandomImage(75, 44, 3, 70U);
  for (int y = 10; y < 30; ++y) std::fill_n(patches.Row(y).begin() + 20, 30, std::uint8_t{1});
  for (const int reach : {1, 2, 3, 5, 8, 17, 32}) {
    params.suppression_px = reach;
    params.min_threshold = 0.0;
    params.threshold = 0.0;
    params.max_features = 1000;
    ExpectSameFeatures(patches, params);
    params.min_threshold = 1e4;
    params.threshold = 5e6;
    ExpectSameFeatures(patches, params);
    params.adapted = reach % 2 == 0 ? Adapted::kWeight : Adapted::kThreshold;
  }
}

// A picture repeated has equal corners.
TEST(FastFeaturesTest, FeaturesThatAreEqualKeepTheirOrder) {
  const GrayImage tile = RandomImage(9, 9, 256, 71U);
  const GrayImage image = ImageOf(99, 72, [&](int x, int y) { return tile.At(x % 9, y % 9); });
  for (const int reach : {1, 4, 8, 9, 10}) {
    FeatureDetectorParams params = SmallParams(Adapted::kThreshold);
    params.suppression_px = reach;
    ExpectSameFeatures(image, params);
  }
}

TEST(FastFeaturesTest, FeaturesOfEveryBorderAndMask) {
  const GrayImage image = RandomImage(80, 50, 256, 80U);
  FeatureDetectorParams params = SmallParams(Adapted::kThreshold);
  params.max_features = 50;
  Image<std::uint8_t> free(80, 50, 1);
  for (int x = 20; x < 41; ++x) free.At(x, 40 - x / 2) = 0;
  free.At(70, 8) = 0;
  for (const int border : {4, 5, 8, 12, 30}) {
    params.border_px = border;
    ExpectSameFeatures(image, params);
    ExpectSameFeatures(image, params, free);
  }
}

TEST(FastFeaturesTest, FeaturesOfEveryRegionAndCount) {
  const GrayImage image = WaveTexture(9, 3.0, 15.0).Render(97, 53, 0.0, 0.0, 25.0, 1.0, 0);
  for (const CountedIn counted_in : {CountedIn::kRegion, CountedIn::kImage}) {
    for (const int regions : {1, 2, 3, 5, 7}) {
      for (const int most : {1, 4, 40}) {
        const FeatureDetectorParams params{
            .regions_across = regions,
            .regions_down = 1 + regions % 3,
            .min_features = most / 2,
            .max_features = most,
            .counted_in = counted_in,
            .adapted = regions == 3 ? Adapted::kWeight : Adapted::kThreshold,
            .border_px = 5};
        ExpectSameFeatures(image, params);
      }
    }
  }
}

Features RandomFeatures(int count, int width, int height, int border, std::uint32_t number) {
  core::RandomStream stream({2015, 0}, core::Purpose::kTest, number);
  Features features;
  for (int i = 0; i < count; ++i) {
    features.push_back(
        {static_cast<std::int16_t>(core::SampleUniform(stream, border, width - border)),
         static_cast<std::int16_t>(core::SampleUniform(stream, border, height - border)), 1});
  }
  return features;
}

WindowSet WindowsOf(const GrayImage& image, const Features& features, int side) {
  WindowSet windows(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    CopyWindow(image, features[i], side, windows.At(i));
  }
  return windows;
}

std::vector<int> BytesOf(const std::uint8_t* window, int side) {
  std::vector<int> bytes;
  for (int row = 0; row < side; ++row) {
    bytes.insert(bytes.end(), window + row * 16, window + row * 16 + side);
  }
  return bytes;
}

// What a window leaves free is 0, whatever was there before.
void ExpectZeroBeside(const std::uint8_t* window, int side) {
  for (int i = 0; i < 256; ++i) {
    if (i / 16 >= side || i % 16 >= side) {
      ASSERT_EQ(window[i], 0) << i;
    }
  }
}

TEST(FastFeaturesTest, WindowsOfEverySide) {
  const GrayImage image = RandomImage(40, 30, 256, 90U);
  for (int side = 1; side <= 15; side += 2) {
    const auto reach = static_cast<std::int16_t>(side / 2);
    for (const Feature& feature : {Feature{reach, reach, 0}, Feature{20, 15, 0},
                                   Feature{static_cast<std::int16_t>(39 - reach),
                                           static_cast<std::int16_t>(29 - reach), 0}}) {
      alignas(64) std::uint8_t window[256];
      std::fill_n(window, 256, std::uint8_t{77});
      CopyWindow(image, feature, side, window);
      EXPECT_EQ(BytesOf(window, side), PlainWindowAt(image, feature, side));
      ExpectZeroBeside(window, side);
    }
  }
}

TEST(FastFeaturesTest, WarpedWindowsOfEveryKind) {
  const GrayImage image = RandomImage(60, 50, 256, 91U);
  core::RandomStream stream({2016, 0}, core::Purpose::kTest, 0);
  for (int number = 0; number < 400; ++number) {
    const double spread = number % 10 == 0 ? 80.0 : number % 2 == 0 ? 0.2 : 1.0;
    Eigen::Matrix2d by_offset = number % 4 < 2 ? Eigen::Matrix2d(Eigen::Matrix2d::Identity())
                                               : Eigen::Matrix2d(Eigen::Matrix2d::Zero());
    for (double& value : by_offset.reshaped()) {
      value += core::SampleUniform(stream, -spread, spread);
    }
    const Feature feature{static_cast<std::int16_t>(core::SampleUniform(stream, 0.0, 60.0)),
                          static_cast<std::int16_t>(core::SampleUniform(stream, 0.0, 50.0)), 0};
    const int side = 1 + 2 * (number % 8);
    const PlainWindow expected = PlainWarpedWindow(image, feature, by_offset, side);
    for (const std::int64_t set : InstructionSets()) {
      const UseInstructionSet use(set);
      alignas(64) std::uint8_t window[256];
      std::fill_n(window, 256, std::uint8_t{77});
      WarpWindow(image, feature, by_offset, side, window);
      ASSERT_EQ(BytesOf(window, side), expected) << number << ", " << InstructionSet();
      ExpectZeroBeside(window, side);
    }
  }
}

// White against black is the largest difference, and fits.
TEST(FastFeaturesTest, DifferencesOfBlackAndWhite) {
  const GrayImage black(15, 15, 0);
  const GrayImage white(15, 15, 255);
  const Features five(5, Feature{7, 7, 0});
  const WindowSet first = WindowsOf(black, five, 15);
  const WindowSet second = WindowsOf(white, five, 15);
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    std::vector<std::uint16_t> differences(5);
    WindowDifferences(first.At(0), second, 0, differences);
    EXPECT_EQ(differences, std::vector<std::uint16_t>(5, 225 * 255)) << InstructionSet();
    WindowDifferences(first.At(0), first, 0, differences);
    EXPECT_EQ(differences, std::vector<std::uint16_t>(5, 0)) << InstructionSet();
  }
}

std::vector<BestWindow> WithoutSecond(std::vector<BestWindow> windows) {
  for (BestWindow& window : windows) window.second = kNoDifference;
  return windows;
}

void ExpectLeast(const WindowSet& first, const WindowSet& second, const BestWindows& expected) {
  const BestWindows least = FindLeastDifferent(first, second);
  EXPECT_EQ(least.of_first, WithoutSecond(expected.of_first)) << InstructionSet();
  EXPECT_EQ(least.of_second, WithoutSecond(expected.of_second)) << InstructionSet();
}

// More windows than are compared at once, many of them alike.
TEST(FastFeaturesTest, TheBestOfManyWindows) {
  constexpr std::size_t kFirst = 300;
  constexpr std::size_t kSecond = 4200;
  const GrayImage image = RandomImage(64, 48, 3, 92U);
  const Features first_features = RandomFeatures(kFirst, 64, 48, 1, 1);
  const Features second_features = RandomFeatures(kSecond, 64, 48, 1, 2);
  const WindowSet first = WindowsOf(image, first_features, 3);
  const WindowSet second = WindowsOf(image, second_features, 3);
  BestWindows expected{std::vector<BestWindow>(kFirst), std::vector<BestWindow>(kSecond)};
  const auto offer = [](std::size_t index, int difference, BestWindow& best) {
    if (difference < best.difference) {
      best = {static_cast<std::int32_t>(index), static_cast<std::uint16_t>(difference),
              best.difference};
    } else if (difference < best.second) {
      best.second = static_cast<std::uint16_t>(difference);
    }
  };
  for (std::size_t i = 0; i < kFirst; ++i) {
    const PlainWindow window = PlainWindowAt(image, first_features[i], 3);
    for (std::size_t j = 0; j < kSecond; ++j) {
      const int difference = PlainDifference(window, PlainWindowAt(image, second_features[j], 3));
      offer(j, difference, expected.of_first[i]);
      offer(i, difference, expected.of_second[j]);
    }
  }
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    const BestWindows found = FindBestWindows(first, second);
    EXPECT_EQ(found.of_first, expected.of_first) << InstructionSet();
    EXPECT_EQ(found.of_second, expected.of_second) << InstructionSet();
    ExpectLeast(first, second, expected);
  }
}

// Windows of which many are the same, on an image whose bounds say nearly all and on one so faint
// that they say nothing: of equal differences the smaller index counts, in whatever order pairs are
// looked at.
TEST(FastFeaturesTest, TheLeastDifferentOfManyTwins) {
  for (const double contrast : {25.0, 1.0}) {
    const GrayImage image = WaveTexture(5, 6.0, 30.0).Render(90, 70, 0.0, 0.0, contrast, 0.5, 0);
    const Features places = RandomFeatures(150, 90, 70, 8, 9);
    const auto some = [&](std::size_t count, std::size_t step) {
      Features features;
      for (std::size_t i = 0; i < count; ++i) features.push_back(places[i * step % places.size()]);
      return WindowsOf(image, features, 15);
    };
    const WindowSet first = some(600, 7);
    const WindowSet second = some(500, 11);
    for (const std::int64_t set : InstructionSets()) {
      const UseInstructionSet use(set);
      ExpectLeast(first, second, FindBestWindows(first, second));
    }
  }
}

void ExpectSameMatches(const GrayImage& first, const Features& first_features,
                       const GrayImage& second, const Features& second_features,
                       const FeatureMatcherParams& params, const PredictedFeatures& predicted) {
  const FeatureMatches expected =
      PlainMatches(first, first_features, second, second_features, params, predicted);
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    ASSERT_EQ(MatchFeatures(first, first_features, second, second_features, params, predicted),
              expected)
        << first_features.size() << " and " << second_features.size() << ", " << InstructionSet();
  }
}

PredictedFeatures PredictionsOf(const Features& features, std::uint32_t number) {
  core::RandomStream stream({2017, 0}, core::Purpose::kTest, number);
  PredictedFeatures predicted;
  for (const Feature& feature : features) {
    PredictedFeature place;
    // Some by whole pixels, so that features lie at the very edge of what is searched.
    const double fraction = predicted.size() % 3 == 0 ? 0.0 : core::SampleUniform(stream, 0.0, 1.0);
    place.pixel = {feature.column - 2.0 + fraction, feature.row + 1.0 - fraction};
    for (double& value : place.view.by_offset.reshaped()) {
      value += core::SampleUniform(stream, -0.1, 0.1);
    }
    predicted.push_back(place);
  }
  if (predicted.size() > 2) {
    predicted[0].pixel = {-1e6, -1e6};
    predicted[1].pixel = {1e300, std::numeric_limits<double>::quiet_NaN()};
  }
  return predicted;
}

TEST(FastFeaturesTest, MatchesOfEveryChoice) {
  const WaveTexture texture(3, 4.0, 20.0);
  const GrayImage first = texture.Render(110, 80, 0.0, 0.0, 25.0, 2.0, 0);
  const GrayImage second = texture.Render(110, 80, 2.2, -1.3, 25.0, 2.0, 1);
  const Features first_features = RandomFeatures(70, 110, 80, 8, 3);
  const Features second_features = RandomFeatures(61, 110, 80, 8, 4);
  const PredictedFeatures predicted = PredictionsOf(first_features, 0);
  for (const bool mutual : {true, false}) {
    for (const double ratio : {1.0, 0.8}) {
      for (const MatchSearch search : {MatchSearch::kAll, MatchSearch::kPredicted}) {
        for (const MatchWarp warp : {MatchWarp::kNone, MatchWarp::kPredicted}) {
          for (const int side : {3, 9, 15}) {
            const FeatureMatcherParams params{.window_px = side,
                                              .mutual = mutual,
                                              .ratio = ratio,
                                              .max_difference = side == 9 ? 12.0 : 200.0,
                                              .search = search,
                                              .search_columns_px = 9.0,
                                              .search_rows_px = 6.0,
                                              .warp = warp};
            ExpectSameMatches(first, first_features, second, second_features, params, predicted);
            ExpectSameMatches(first, first_features, second, second_features, params, {});
          }
        }
      }
    }
  }
}

// Two grey levels leave many differences equal.
TEST(FastFeaturesTest, MatchesOfEveryNumber) {
  const GrayImage first = RandomImage(60, 40, 2, 93U);
  const GrayImage second = RandomImage(60, 40, 2, 94U);
  FeatureMatcherParams params{.window_px = 3, .max_difference = 255.0};
  for (int count = 0; count <= 75; ++count) {
    params.mutual = count % 2 == 0;
    ExpectSameMatches(first, RandomFeatures(count, 60, 40, 8, 5), second,
                      RandomFeatures((count * 29) % 76, 60, 40, 8, 6), params, {});
  }
}

TEST(FastFeaturesTest, MatchesOfMoreFeaturesThanAreComparedAtOnce) {
  const GrayImage first = RandomImage(160, 120, 256, 95U);
  const FeatureMatcherParams params{.max_difference = 255.0};
  ExpectSameMatches(first, RandomFeatures(300, 160, 120, 8, 7), first,
                    RandomFeatures(290, 160, 120, 8, 8), params, {});
}

}  // namespace
}  // namespace rockyard::vision

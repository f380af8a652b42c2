// What features and matches do when the world moves, is dark, blank or hidden.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "textured_image.h"
#include "vision/each_pixel.h"
#include "vision/odometry/detect_features.h"
#include "vision/odometry/match_features.h"

namespace rockyard::vision {
namespace {

constexpr int kWidth = 256;
constexpr int kHeight = 192;

GrayImage Texture(double left, double top, double contrast, double noise,
                  std::uint32_t noise_number) {
  return WaveTexture(5, 5.0, 30.0)
      .Render(kWidth, kHeight, left, top, contrast, noise, noise_number);
}

Features Detect(const GrayImage& image, const FeatureDetectorParams& params,
                const Image<std::uint8_t>& free = {}) {
  return FeatureDetector(params, {image.width(), image.height()}, free).Detect(image);
}

// Every corner of the whole image.
FeatureDetectorParams AllCorners() {
  return {.regions_across = 1, .regions_down = 1, .min_features = 0, .max_features = 100000};
}

using Place = std::tuple<int, int, int>;

std::set<Place> PlacesOf(const Features& features, int right, int down) {
  std::set<Place> places;
  for (const Feature& feature : features) {
    const int x = feature.column + right;
    const int y = feature.row + down;
    if (x >= 30 && x < kWidth - 30 && y >= 30 && y < kHeight - 30) {
      places.insert({x, y, feature.strength});
    }
  }
  return places;
}

TEST(FeaturesTest, AMovedImageHasMovedFeatures) {
  const Features before = Detect(Texture(0, 0, 25.0, 0.0, 0), AllCorners());
  const Features after = Detect(Texture(7, -4, 25.0, 0.0, 0), AllCorners());
  const std::set<Place> expected = PlacesOf(before, -7, 4);
  EXPECT_GT(expected.size(), 100U);
  EXPECT_EQ(PlacesOf(after, 0, 0), expected);
  EXPECT_NE(PlacesOf(after, 1, 0), expected);
}

// x and y change places: the response does not know them apart. The sums are shifted within a
// column, so that a strength changes by what rounding leaves.
TEST(FeaturesTest, ATransposedImageHasTransposedFeatures) {
  const GrayImage image = Texture(0, 0, 25.0, 0.0, 0);
  const GrayImage transposed =
      ImageOf(kHeight, kWidth, [&](int x, int y) { return image.At(y, x); });
  std::set<std::pair<int, int>> expected;
  for (const Feature& f : Detect(image, AllCorners())) expected.insert({f.row, f.column});
  const Features found = Detect(transposed, AllCorners());
  const auto same = std::count_if(found.begin(), found.end(), [&](const Feature& f) {
    return expected.contains({f.column, f.row});
  });
  EXPECT_GE(static_cast<double>(same), 0.97 * static_cast<double>(expected.size()));
  EXPECT_EQ(found.size(), expected.size());
}

// Half the contrast is a sixteenth of the response, but for rounding of grey levels. Slopes stay
// below the 15 grey levels a pixel from which on they count the same.
TEST(FeaturesTest, HalfTheContrastIsASixteenthOfTheStrength) {
  const Features bright = Detect(Texture(0, 0, 8.0, 0.0, 0), AllCorners());
  const Features dark = Detect(Texture(0, 0, 4.0, 0.0, 0), AllCorners());
  int compared = 0;
  double bright_sum = 0.0, dark_sum = 0.0;
  for (const Feature& b : bright) {
    for (const Feature& d : dark) {
      if (b.column != d.column || b.row != d.row) continue;
      ++compared;
      bright_sum += b.strength;
      dark_sum += d.strength;
    }
  }
  EXPECT_GT(compared, 50);
  EXPECT_NEAR(bright_sum / dark_sum, 16.0, 1.0);
}

TEST(FeaturesTest, NothingInBlankImagesOrOnStraightEdges) {
  for (const Adapted adapted : {Adapted::kThreshold, Adapted::kWeight}) {
    const FeatureDetectorParams params{.adapted = adapted};
    EXPECT_TRUE(Detect(GrayImage(kWidth, kHeight, 0), params).empty());
    EXPECT_TRUE(Detect(GrayImage(kWidth, kHeight, 255), params).empty());
  }
  GrayImage edge(kWidth, kHeight, 40);
  for (int y = 0; y < kHeight; ++y) std::fill_n(edge.Row(y).begin(), 99, std::uint8_t{140});
  EXPECT_TRUE(Detect(edge, {}).empty());
  // The corner of a square is none of these.
  for (int y = 0; y < 90; ++y) std::fill_n(edge.Row(y).begin(), 99, std::uint8_t{40});
  const Features corner = Detect(edge, AllCorners());
  ASSERT_EQ(corner.size(), 1U);
  EXPECT_NEAR(corner[0].column, 98.5, 2.0);
  EXPECT_NEAR(corner[0].row, 89.5, 2.0);
}

struct Counted {
  std::vector<int> of_region;
  bool in_order = true;  // regions by rows, the strongest first
};

Counted CountIn(const Features& features, const FeatureDetectorParams& params) {
  Counted counted{std::vector<int>(static_cast<std::size_t>(params.regions()), 0), true};
  std::int64_t last = 0;
  std::int32_t strength = 0;
  for (const Feature& f : features) {
    const std::int64_t region = f.row * params.regions_down / kHeight * params.regions_across +
                                f.column * params.regions_across / kWidth;
    ++counted.of_region[static_cast<std::size_t>(region)];
    if (region < last || (region == last && strength != 0 && f.strength > strength)) {
      counted.in_order = false;
    }
    last = region;
    strength = f.strength;
  }
  return counted;
}

TEST(FeaturesTest, EveryRegionHasFromItsLeastToItsMost) {
  for (const double contrast : {3.0, 25.0}) {
    for (const Adapted adapted : {Adapted::kThreshold, Adapted::kWeight}) {
      const FeatureDetectorParams params{.min_features = 6, .max_features = 14, .adapted = adapted};
      const Counted counted = CountIn(Detect(Texture(0, 0, contrast, 0.5, 0), params), params);
      for (const int count : counted.of_region) {
        EXPECT_GE(count, 6) << contrast;
        EXPECT_LE(count, 14) << contrast;
      }
      EXPECT_TRUE(counted.in_order);
    }
  }
}

// The left half says nothing: its regions have none, however few are asked for.
TEST(FeaturesTest, ARegionWithoutTextureStaysEmpty) {
  GrayImage image = Texture(0, 0, 25.0, 0.0, 0);
  for (int y = 0; y < kHeight; ++y) std::fill_n(image.Row(y).begin(), 128, std::uint8_t{90});
  const FeatureDetectorParams params;
  const Counted counted = CountIn(Detect(image, params), params);
  for (std::size_t region = 0; region < 16; ++region) {
    if (region % 4 == 0) {
      EXPECT_EQ(counted.of_region[region], 0);
    }
    if (region % 4 >= 2) {
      EXPECT_GE(counted.of_region[region], 10);
    }
  }
}

TEST(FeaturesTest, CountsOfTheImageAreSharedByItsRegions) {
  const FeatureDetectorParams params{
      .min_features = 32, .max_features = 80, .counted_in = CountedIn::kImage};
  const Features features = Detect(Texture(0, 0, 25.0, 0.5, 0), params);
  EXPECT_EQ(features.size(), 80U);
  for (const int count : CountIn(features, params).of_region) EXPECT_EQ(count, 5);
}

TEST(FeaturesTest, NoTwoAreWithinTheReachOfSuppression) {
  for (const int reach : {1, 3, 9}) {
    FeatureDetectorParams params = AllCorners();
    params.suppression_px = reach;
    const Features features = Detect(RandomImage(kWidth, kHeight, 256, 1U), params);
    EXPECT_GT(features.size(), 50U);
    for (std::size_t i = 0; i < features.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GT(std::max(std::abs(features[i].column - features[j].column),
                           std::abs(features[i].row - features[j].row)),
                  reach);
      }
    }
  }
}

TEST(FeaturesTest, NoneNearWhatIsNotFreeOrTheEdges) {
  FeatureDetectorParams params = AllCorners();
  params.border_px = 9;
  Image<std::uint8_t> free(kWidth, kHeight, 1);
  free.At(100, 90) = 0;
  const GrayImage image = RandomImage(kWidth, kHeight, 256, 2U);
  const Features all = Detect(image, params);
  const Features features = Detect(image, params, free);
  Features expected;
  std::copy_if(all.begin(), all.end(), std::back_inserter(expected), [](const Feature& f) {
    return std::abs(f.column - 100) > 9 || std::abs(f.row - 90) > 9;
  });
  EXPECT_EQ(features, expected);
  EXPECT_LT(features.size(), all.size());
  for (const Feature& f : all) {
    EXPECT_TRUE(f.column >= 9 && f.column < kWidth - 9 && f.row >= 9 && f.row < kHeight - 9);
  }
}

TEST(FeaturesTest, TheSameWhateverWasDetectedBefore) {
  const FeatureDetector detector({}, {kWidth, kHeight});
  const GrayImage image = Texture(0, 0, 25.0, 1.0, 0);
  const Features first = detector.Detect(image);
  detector.Detect(RandomImage(kWidth, kHeight, 256, 3U));
  EXPECT_EQ(detector.Detect(image), first);
}

struct Seen {
  GrayImage first, second;
  Features first_features, second_features;
};

// The second camera sees what the first sees at 6 columns and -4 rows more.
Seen SeeTwice() {
  Seen seen{Texture(0, 0, 25.0, 1.5, 0), Texture(6, -4, 25.0, 1.5, 1), {}, {}};
  seen.first_features = Detect(seen.first, {});
  seen.second_features = Detect(seen.second, {});
  return seen;
}

FeatureMatches MatchOf(const Seen& seen, const FeatureMatcherParams& params,
                       const PredictedFeatures& predicted = {}) {
  return MatchFeatures(seen.first, seen.first_features, seen.second, seen.second_features, params,
                       predicted);
}

double ShareRight(const Seen& seen, const FeatureMatches& matches) {
  const auto right = std::count_if(matches.begin(), matches.end(), [&](const FeatureMatch& m) {
    const Feature& a = seen.first_features[static_cast<std::size_t>(m.first)];
    const Feature& b = seen.second_features[static_cast<std::size_t>(m.second)];
    return std::abs(b.column - (a.column - 6)) <= 1 && std::abs(b.row - (a.row + 4)) <= 1;
  });
  return static_cast<double>(right) / static_cast<double>(matches.size());
}

TEST(FeaturesTest, MatchesFollowTheMotion) {
  const Seen seen = SeeTwice();
  FeatureMatcherParams params;
  const FeatureMatches matches = MatchOf(seen, params);
  EXPECT_GT(matches.size(), 150U);
  EXPECT_GT(ShareRight(seen, matches), 0.95);
  // Without the other direction there are more, and more that are wrong.
  params.mutual = false;
  const FeatureMatches one_way = MatchOf(seen, params);
  EXPECT_GT(one_way.size(), matches.size());
  EXPECT_LT(ShareRight(seen, one_way), ShareRight(seen, matches));
  params.ratio = 0.6;
  const FeatureMatches clear = MatchOf(seen, params);
  EXPECT_LT(clear.size(), one_way.size());
  EXPECT_GT(ShareRight(seen, clear), ShareRight(seen, one_way));
}

TEST(FeaturesTest, MutualMatchesAreTheSameFromTheOtherSide) {
  const Seen seen = SeeTwice();
  const Seen other{seen.second, seen.first, seen.second_features, seen.first_features};
  std::set<Place> there;
  std::set<Place> back;
  for (const FeatureMatch& m : MatchOf(seen, {})) there.insert({m.first, m.second, m.difference});
  for (const FeatureMatch& m : MatchOf(other, {})) back.insert({m.second, m.first, m.difference});
  EXPECT_EQ(there, back);
}

// Where only what is near may be a match, it is a match of the full search that lies there.
TEST(FeaturesTest, APredictionKeepsWhatLiesNear) {
  const Seen seen = SeeTwice();
  PredictedFeatures predicted(seen.first_features.size());
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    predicted[i].pixel = {seen.first_features[i].column - 6.0, seen.first_features[i].row + 4.0};
  }
  const FeatureMatcherParams params{.search_columns_px = 5.0, .search_rows_px = 3.0};
  const FeatureMatches near = MatchOf(seen, params, predicted);
  EXPECT_GT(near.size(), 150U);
  std::set<Place> found;
  for (const FeatureMatch& m : near) found.insert({m.first, m.second, m.difference});
  for (const FeatureMatch& m : MatchOf(seen, {})) {
    const Feature& b = seen.second_features[static_cast<std::size_t>(m.second)];
    const Pixel& place = predicted[static_cast<std::size_t>(m.first)].pixel;
    const bool is_near =
        std::abs(b.column - place.x()) <= 5.0 && std::abs(b.row - place.y()) <= 3.0;
    EXPECT_EQ(found.contains({m.first, m.second, m.difference}), is_near);
  }
}

// The camera rolled by 25 degrees: windows that are turned by as much find what others do not.
TEST(FeaturesTest, TurnedWindowsFindWhatATurnedCameraSees) {
  const WaveTexture texture(6, 4.0, 12.0);
  const double roll = 25.0 * 3.14159265358979 / 180.0;
  Eigen::Matrix2d turn;
  turn << std::cos(roll), -std::sin(roll), std::sin(roll), std::cos(roll);
  const Pixel middle(128.0, 96.0);
  Seen seen{texture.Render(kWidth, kHeight, 0.0, 0.0, 25.0, 1.0, 0), {}, {}, {}};
  seen.second = ImageOf(kWidth, kHeight, [&](int x, int y) {
    const Pixel from = middle + turn * (Pixel(x, y) - middle);
    return std::lround(110.0 + 25.0 * texture.At(from.x(), from.y()));
  });
  seen.first_features = Detect(seen.first, {});
  seen.second_features = Detect(seen.second, {});
  PredictedFeatures predicted(seen.first_features.size());
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const Pixel first(seen.first_features[i].column, seen.first_features[i].row);
    predicted[i] = {middle + turn.transpose() * (first - middle), turn};
  }
  const auto right = [&](MatchWarp warp) {
    const FeatureMatcherParams params{.search = MatchSearch::kAll, .warp = warp};
    const FeatureMatches matches = MatchOf(seen, params, predicted);
    return std::count_if(matches.begin(), matches.end(), [&](const FeatureMatch& m) {
      const Feature& b = seen.second_features[static_cast<std::size_t>(m.second)];
      return (predicted[static_cast<std::size_t>(m.first)].pixel - Pixel(b.column, b.row)).norm() <
             1.6;
    });
  };
  EXPECT_GT(right(MatchWarp::kPredicted), 100);
  EXPECT_LT(2 * right(MatchWarp::kNone), right(MatchWarp::kPredicted));
}

TEST(FeaturesTest, NothingMatchesNothing) {
  const GrayImage image = Texture(0, 0, 25.0, 1.0, 0);
  const Features features = Detect(image, {});
  EXPECT_TRUE(MatchFeatures(image, {}, image, features, {}).empty());
  EXPECT_TRUE(MatchFeatures(image, features, image, {}, {}).empty());
}

// As different as the limit, and a little more.
TEST(FeaturesTest, TheLargestDifferenceIsInclusive) {
  const GrayImage dark(15, 15, 100);
  const GrayImage bright(15, 15, 130);
  const Features middle{{7, 7, 1}};
  FeatureMatcherParams params{.max_difference = 30.0};
  EXPECT_EQ(MatchFeatures(dark, middle, bright, middle, params).size(), 1U);
  params.max_difference = 29.99;
  EXPECT_TRUE(MatchFeatures(dark, middle, bright, middle, params).empty());
}

}  // namespace
}  // namespace rockyard::vision

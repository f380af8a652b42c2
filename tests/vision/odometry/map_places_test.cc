// Places of features from a dense disparity map: interpolation in closed form, edges of what the
// map knows, and the plane that images are of.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/check.h"
#include "vision/cameras/rectification.h"
#include "vision/each_pixel.h"
#include "vision/odometry/place_features.h"
#include "vision/odometry/synthetic_sequence.h"

namespace rockyard::vision {
namespace {

constexpr ImageSize kSize{256, 192};

// 10 px + 3/32 px a column + 2/32 px a row.
double Slanted_px(double x, double y) { return 10.0 + (3.0 * x + 2.0 * y) / 32.0; }

DisparityImage SlantedMap(int width = 8, int height = 6) {
  return ImageOf<std::int16_t>(width, height, [](int x, int y) { return 32 * Slanted_px(x, y); });
}

TEST(DisparityAtTest, InterpolatesASlantExactly) {
  const DisparityImage map = SlantedMap();
  for (const Pixel& place : {Pixel(2, 3), Pixel(2.25, 3), Pixel(2, 3.5), Pixel(4.7, 1.1),
                             Pixel(0, 0), Pixel(7, 5), Pixel(6.999, 4.999)}) {
    const auto disparity_px = DisparityAt(map, place, 1.0);
    ASSERT_TRUE(disparity_px) << place.transpose();
    EXPECT_NEAR(*disparity_px, Slanted_px(place.x(), place.y()), 1e-12) << place.transpose();
  }
}

TEST(DisparityAtTest, KnowsNothingBeyondTheMap) {
  const DisparityImage map = SlantedMap();
  for (const Pixel& place : {Pixel(-0.1, 3), Pixel(2, -0.1), Pixel(7.1, 3), Pixel(2, 5.1),
                             Pixel(-1, 3), Pixel(8, 3), Pixel(2, 6), Pixel(-3, -3)}) {
    EXPECT_FALSE(DisparityAt(map, place, 1.0)) << place.transpose();
  }
}

// A dropped pixel takes its part of the plane with it, and no more.
TEST(DisparityAtTest, NeedsEveryNeighbourThatCounts) {
  DisparityImage map = SlantedMap();
  map.At(3, 2) = Dropped(Drop::kPeak);
  for (const Pixel& place : {Pixel(3, 2), Pixel(2.5, 2), Pixel(3.5, 2), Pixel(3, 1.5),
                             Pixel(3, 2.5), Pixel(2.1, 1.1), Pixel(3.9, 2.9)}) {
    EXPECT_FALSE(DisparityAt(map, place, 1.0)) << place.transpose();
  }
  for (const Pixel& place :
       {Pixel(2, 2), Pixel(4, 2), Pixel(3, 1), Pixel(2, 1.5), Pixel(4.5, 2.5)}) {
    EXPECT_TRUE(DisparityAt(map, place, 1.0)) << place.transpose();
  }
}

// Between a near surface and a far one there is none.
TEST(DisparityAtTest, NeighboursHaveToBeOfOneSurface) {
  DisparityImage map(4, 4, 32 * 12);
  for (const auto& [step, holds] : {std::pair{32, true}, {33, false}, {-32, true}, {-33, false}}) {
    map.At(2, 1) = static_cast<std::int16_t>(32 * 12 + step);
    EXPECT_EQ(DisparityAt(map, {1.5, 1.5}, 1.0).has_value(), holds) << step;
    EXPECT_EQ(DisparityAt(map, {1.5, 1}, 1.0).has_value(), holds) << step;
    EXPECT_TRUE(DisparityAt(map, {2, 1}, 1.0)) << step;
    EXPECT_TRUE(DisparityAt(map, {0.5, 1.5}, 1.0)) << step;
  }
}

// 3/32 and 2/32 px a pixel, and none along a direction in which the surface ends or bends.
TEST(SlopeAtTest, IsThatOfTheSurface) {
  DisparityImage map = SlantedMap(40, 40);
  const auto expect = [&](const Pixel& place, double across, double down) {
    EXPECT_TRUE(SlopeAt(map, place, 1.0).isApprox(DisparitySlope(across, down) / 32.0, 1e-12))
        << place.transpose() << ": " << SlopeAt(map, place, 1.0).transpose();
  };
  expect({20.3, 19.6}, 3, 2);
  expect({6, 20}, 0, 2);
  expect({20, 33}, 3, 0);
  map.At(27, 20) = Dropped(Drop::kPeak);
  expect({20, 20}, 0, 2);
  expect({19.6, 20}, 0, 2);                                         // the nearest pixel's
  map.At(10, 17) = static_cast<std::int16_t>(map.At(10, 17) + 64);  // a bend of 1 px
  expect({10, 10}, 3, 2 + 64.0 / 14.0);
  map.At(10, 17) = static_cast<std::int16_t>(map.At(10, 17) + 2);
  expect({10, 10}, 3, 0);
  expect({10, 9.6}, 3, 0);
}

// What a pair measures is the closed form's, whichever part of the parameters it has from where.
TEST(PlaceInMapTest, HasTheCovarianceOfAStereoPoint) {
  const RectifiedPair pair = PlanePair(kSize);
  const DisparityImage map(kSize.columns, kSize.rows, 32 * 20);
  PlacementParams params;
  params.map.noise_px = 0.3;
  Eigen::Matrix2d covariance;
  covariance << 0.04, 0.01, 0.01, 0.09;
  const auto place = PlaceInMap(pair, params, map, {100.25, 80.5}, covariance);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->left, Pixel(100.25, 80.5));
  EXPECT_DOUBLE_EQ(place->disparity_px, 20.0);
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected.topLeftCorner<2, 2>() = covariance;
  expected(2, 2) = 0.3 * 0.3;
  EXPECT_TRUE(place->covariance_px2.isApprox(expected, 1e-12));
  EXPECT_TRUE(place->slope.isZero());
  EXPECT_EQ(place->residual, 0.0);
  // Along the view: f B / d, and depth^2 / (f B) times the disparity's deviation (Matthies and
  // Shafer 1987).
  const double depth_m = pair.left.A.dot(place->p_A - pair.left.C);
  EXPECT_NEAR(depth_m, pair.focal_px * pair.baseline_m / 20.0, 1e-9);
  EXPECT_NEAR(std::sqrt(pair.left.A.dot(place->covariance_m2 * pair.left.A)),
              depth_m * depth_m / (pair.focal_px * pair.baseline_m) * 0.3, 1e-9);
}

TEST(PlaceInMapTest, HasTheSlopeOfTheMap) {
  const auto place = PlaceInMap(PlanePair(kSize), {}, SlantedMap(40, 40), {20.5, 20.5},
                                Eigen::Matrix2d::Identity());
  ASSERT_TRUE(place);
  EXPECT_TRUE(place->slope.isApprox(DisparitySlope(3, 2) / 32.0, 1e-12));
}

// Right images are the left one moved by 8 px: disparities at either end of the range are found,
// those beyond it are not.
TEST(PlaceInMapTest, RangesAreThoseOfTheParameters) {
  const RectifiedPair pair = PlanePair(kSize);
  const GrayImage left = SeePlane(pair, math::Transform::Identity(), {}, 0).left;
  GrayImage right(kSize.columns, kSize.rows, 90);
  ForEachPixel(kSize.columns - 8, kSize.rows,
               [&](int x, int y) { right.At(x, y) = left.At(x + 8, y); });
  const auto placed = [&](double min_px, double max_px) {
    const PlacementParams params{.min_disparity_px = min_px, .max_disparity_px = max_px};
    const DisparityImage map = MakePlacementMap(left, right, params);
    int places = 0;
    for (int y = 60; y < 180; y += 10) {
      for (int x = 60; x < 240; x += 10) {
        const auto place = PlaceInMap(pair, params, map, Pixel(x, y), Eigen::Matrix2d::Identity());
        if (!place) continue;
        EXPECT_NEAR(place->disparity_px, 8.0, 0.5);
        EXPECT_GE(place->disparity_px, min_px);
        EXPECT_LE(place->disparity_px, max_px);
        ++places;
      }
    }
    return places;
  };
  EXPECT_GT(placed(1.0, 96.0), 200);  // of 216
  // Where the fraction of a pixel that is found lies within, half of them.
  EXPECT_GT(placed(8.0, 12.0), 70);
  EXPECT_GT(placed(4.0, 8.0), 70);
  EXPECT_EQ(placed(8.5, 12.5), 0);
  EXPECT_EQ(placed(3.0, 7.5), 0);
}

// Root mean square error of the disparities of a plane's features in units of what they state, and
// the share of features that have a place.
struct PlaneErrors {
  double normalized = 0.0;
  double mean_px = 0.0;
  double share = 0.0;
};

PlaneErrors ErrorsOnPlane(const RectifiedPair& cameras, const AlignedImages& images) {
  const Features features = FeatureDetector({}, kSize).Detect(images.left);
  const PlacementParams params;
  const DisparityImage map = MakePlacementMap(images.left, images.right, params);
  PlaneErrors errors;
  double count = 0.0;
  for (const Feature& feature : features) {
    const Pixel pixel(feature.column, feature.row);
    const auto place = PlaceInMap(cameras, params, map, pixel, Eigen::Matrix2d::Identity());
    if (!place) continue;
    const double off_px = place->disparity_px - PlaneDisparity_px(cameras, pixel);
    errors.normalized += off_px * off_px / place->covariance_px2(2, 2);
    errors.mean_px += off_px;
    count += 1.0;
  }
  errors.normalized = std::sqrt(errors.normalized / count);
  errors.mean_px /= count;
  errors.share = count / static_cast<double>(features.size());
  return errors;
}

// The stated deviation is that of rendered rocks; a plane's disparities are no worse. The negative
// control holds them against a plane that is seen by cameras half a pixel turned to each other.
TEST(PlaceInMapTest, FeaturesOfAPlaneLieOnIt) {
  const RectifiedPair pair = PlanePair(kSize);
  const AlignedImages images = SeePlane(pair, math::Transform::Identity(), {}, 0);
  const PlaneErrors errors = ErrorsOnPlane(pair, images);
  EXPECT_GT(errors.share, 0.7);
  EXPECT_LT(errors.normalized, 1.3);
  EXPECT_GT(errors.normalized, 0.3);
  EXPECT_LT(std::abs(errors.mean_px), 0.03);
  RectifiedPair turned = pair;
  turned.right.H += 0.5 * turned.right.A;
  EXPECT_GT(ErrorsOnPlane(turned, SeePlane(turned, math::Transform::Identity(), {}, 0)).normalized,
            2.0);
}

TEST(MakePlacementMapTest, ItsParametersCount) {
  const AlignedImages images =
      SeePlane(PlanePair(kSize), math::Transform::Identity(), {.noise = 3.0}, 0);
  const auto disparities = [&](const PlacementParams& params) {
    return CountDrops(MakePlacementMap(images.left, images.right, params))[0];
  };
  const std::int64_t all = disparities({});
  PlacementParams changed;
  changed.map.filters.blob_min_px = 1000000;
  EXPECT_EQ(disparities(changed), 0);
  changed = {};
  changed.map.window_side_px = 11;  // averages more noise
  EXPECT_GT(disparities(changed), all);
  changed = {};
  changed.map.dog.limit = 1;  // leaves signs alone
  EXPECT_LT(disparities(changed), all);
}

TEST(MakePlacementMapTest, BlankImagesHaveNoDisparity) {
  const GrayImage blank(kSize.columns, kSize.rows, 90);
  const DisparityImage map = MakePlacementMap(blank, blank, {});
  EXPECT_EQ(CountDrops(map)[static_cast<std::size_t>(Drop::kNone)], 0);
  EXPECT_THROW(MakePlacementMap(blank, GrayImage(kSize.columns, 10), {}), core::ContractViolation);
}

}  // namespace
}  // namespace rockyard::vision

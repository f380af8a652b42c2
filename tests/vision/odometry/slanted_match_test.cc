#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "vision/cameras/rectification.h"
#include "vision/each_pixel.h"
#include "vision/odometry/detect_features.h"
#include "vision/odometry/place_features.h"
#include "vision/odometry/plane_view.h"
#include "vision/odometry/refine_match.h"
#include "vision/odometry/stereo_measurement.h"
#include "vision/odometry/synthetic_sequence.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;

// Disparities and slopes of windows on level ground, which does not face the cameras.

constexpr ImageSize kSize{256, 192};

struct Errors {
  double disparity_px = 0.0;  // root mean square
  double slope = 0.0;         // mean, down the rows
  double residual = 0.0;      // mean
  int count = 0;
};

Errors ErrorsOf(bool slanted) {
  const RectifiedPair pair = PlanePair(kSize);
  const PlacementParams params{.slanted = slanted};
  Errors errors;
  double squares_px2 = 0.0;
  for (std::uint32_t number = 0; number < 3; ++number) {
    const AlignedImages images = SeePlane(pair, math::Transform::Identity(), {.number = number}, 0);
    const FeaturePlacer placer(pair, params, images.left, images.right);
    for (const Feature& feature : FeatureDetector({}, kSize).Detect(images.left)) {
      const Pixel pixel(feature.column, feature.row);
      const auto place = placer.Place(pixel, 1e-4 * Eigen::Matrix2d::Identity());
      const double truth_px = PlaneDisparity_px(pair, pixel);
      if (!place || std::abs(place->disparity_px - truth_px) > 0.5) continue;
      const double slope = PlaneDisparity_px(pair, pixel + Pixel(0.0, 1.0)) - truth_px;
      squares_px2 += std::pow(place->disparity_px - truth_px, 2);
      errors.slope += place->slope.y() - slope;
      errors.residual += place->residual;
      ++errors.count;
    }
  }
  errors.disparity_px = std::sqrt(squares_px2 / errors.count);
  errors.slope /= errors.count;
  errors.residual /= errors.count;
  return errors;
}

// The ground's disparity grows by 0.14 px a row. Windows that are taken to face the cameras are the
// control: their slope is 0, and three times the noise is left of them.
TEST(SlantedMatchTest, LevelGroundHasItsSlopeAndItsDisparity) {
  const Errors slanted = ErrorsOf(true);
  const Errors facing = ErrorsOf(false);
  ASSERT_GT(slanted.count, 300);
  EXPECT_LT(std::abs(slanted.slope), 0.004);
  EXPECT_LT(slanted.disparity_px, 0.04);
  EXPECT_LT(slanted.residual, 1.8);  // both images have noise of 1
  EXPECT_NEAR(facing.slope, -0.14, 0.02);
  EXPECT_GT(facing.disparity_px, 2.0 * slanted.disparity_px);
  EXPECT_GT(facing.residual, 2.0 * slanted.residual);
}

TEST(SlantedMatchTest, FindsNothingOutsideOrWithoutTexture) {
  const RectifiedPair pair = PlanePair(kSize);
  const AlignedImages images = SeePlane(pair, math::Transform::Identity(), {}, 0);
  const RefineLimits limits{.along_row = true};
  const Pixel pixel(150.0, 110.0);
  const double column = 150.0 - PlaneDisparity_px(pair, pixel);
  ASSERT_TRUE(FindSlanted(images.left, images.right, pixel, column, limits));
  EXPECT_FALSE(FindSlanted(images.left, images.right, pixel, 5.0, limits));
  EXPECT_FALSE(FindSlanted(images.left, images.right, pixel, 249.0, limits));
  // Windows of which a row is missing, above or below, where fractions need one more.
  EXPECT_FALSE(FindSlanted(images.left, images.left, {100.0, 6.5}, 100.0, limits));
  EXPECT_TRUE(FindSlanted(images.left, images.left, {100.0, 183.0}, 100.0, limits));
  EXPECT_FALSE(FindSlanted(images.left, images.left, {100.0, 184.0}, 100.0, limits));
  // Too far off, and another texture.
  EXPECT_FALSE(FindSlanted(images.left, images.right, pixel, column - 20.0, limits));
  const GrayImage flat(kSize.columns, kSize.rows, 90);
  EXPECT_FALSE(FindSlanted(flat, flat, pixel, column, limits));
}

// A pattern about the middle of an image of 60 x 60 pixels, by offset.
template <typename Pattern>
GrayImage PatternImage(const Pattern& grey) {
  return ImageOf(60, 60, [&](int column, int row) {
    return std::lround(std::clamp(grey(column - 30.0, row - 30), 0.0, 255.0));
  });
}

const Pixel kMiddle(30.0, 30.0);

// Ripples on a bright slope whose gradient does not cancel over the window, 0.4 px off. Without the
// mean of the gradients in the equations each step goes a sixth of its way.
TEST(SlantedMatchTest, FindsRipplesOnABrightSlope) {
  for (const double off_px : {-0.4, 0.0, 0.4}) {
    const auto image = [](double shift_px) {
      return PatternImage([shift_px](double x, int /*row*/) {
        return 128.0 + 10.0 * (x - shift_px) + 12.0 * std::sin(0.5 * (x - shift_px) + 0.7);
      });
    };
    const auto place = FindSlanted(image(0.0), image(off_px), kMiddle, 30.0, {.along_row = true});
    ASSERT_TRUE(place) << off_px;
    EXPECT_NEAR(place->column, 30.0 + off_px, 0.03);
    EXPECT_NEAR(place->slope.norm(), 0.0, 0.02) << off_px;
  }
}

// Ripples on a plane: the right eye sees at (o_x, o_y) from its middle what the left one sees at
// ((o_x + b o_y) / (1 - a), o_y), 0.3 px to the right.
TEST(SlantedMatchTest, WindowsOfEverySideHaveTheSlope) {
  const Eigen::Vector2d slope(0.15, -0.1);
  const auto image = [](double shift_px, const Eigen::Vector2d& by) {
    return PatternImage([=](double x, int row) {
      const double seen = (x - shift_px + by.y() * row) / (1.0 - by.x());
      return 128.0 + 40.0 * std::sin(0.8 * seen + 0.3 * row) +
             30.0 * std::cos(0.7 * row - 0.6 * seen);
    });
  };
  for (const std::size_t side : {9U, 11U, 15U}) {
    const auto place = FindSlanted(image(0.0, {0.0, 0.0}), image(0.3, slope), kMiddle, 30.0,
                                   {.along_row = true}, side);
    ASSERT_TRUE(place) << side;
    EXPECT_NEAR(place->column, 30.3, 0.03) << side;
    EXPECT_NEAR((place->slope - slope).norm(), 0.0, 0.02) << side;
  }
}

// Every window shows its own side: stripes behind that of 9 pixels, which lie elsewhere in the
// right image, draw that of 15 away.
TEST(SlantedMatchTest, SmallWindowsDoNotSeeWhatLiesBesideThem) {
  const auto image = [](double shift_px, double beside_px) {
    return PatternImage([=](double x, int row) {
      const double moved = std::abs(row) <= 4 && std::abs(x) <= 5.5 ? shift_px : beside_px;
      return 128.0 + 40.0 * std::sin(0.6 * (x - moved)) + 20.0 * std::cos(0.9 * row);
    });
  };
  const GrayImage left = image(0.0, 0.0);
  const GrayImage right = image(0.3, 1.5);
  const RefineLimits limits{.along_row = true, .max_residual = 60.0};
  const auto small = FindSlanted(left, right, kMiddle, 30.0, limits, 9);
  const auto large = FindSlanted(left, right, kMiddle, 30.0, limits, 15);
  ASSERT_TRUE(small && large);
  EXPECT_NEAR(small->column, 30.3, 0.05);
  EXPECT_GT(large->column, 30.6);
}

// Waves of 12 px in the rows 5 above and below the middle, which lie a pixel to either side in the
// right image: a slope of 0.2. The other rows of the right image are brighter and darker by
// `stripes`, which says nothing of where waves lie and much of what the images are worth.
double SlopeAmong(double stripes, RefineLimits limits = {}) {
  const auto image = [](double slope, double brighter) {
    return PatternImage([=](double x, int row) {
      const double wave = 6.0 * std::cos(std::numbers::pi / 6.0 * (x + slope * row));
      if (std::abs(row) == 5) return 100.0 + wave;
      return 100.0 + (row % 2 == 0 ? brighter : -brighter);
    });
  };
  limits.along_row = true;
  const auto place = FindSlanted(image(0.0, 0.0), image(0.2, stripes), kMiddle, 30.0, limits);
  if (!place) return std::nan("");
  EXPECT_NEAR(place->column, 30.0, 0.05);
  EXPECT_NEAR(place->slope.x(), 0.0, 0.02);
  return place->slope.y();
}

// The slope s of the least N (s - 0.2)^2 / variance + s^2 / 0.3^2, N = sum (g o_y)^2 = 2 x 25 x 15
// x 3.14^2 / 2 and the variance 195 x 18^2 / 220: N = 3700 against 3190.
TEST(SlantedMatchTest, SlopesAreExpectedToBeSmallWhereImagesSayLittle) {
  EXPECT_NEAR(SlopeAmong(0.0), 0.2, 0.01);
  EXPECT_NEAR(SlopeAmong(18.0), 0.2 * 3700.0 / (3700.0 + 3190.0), 0.02);
  // Of nine times the weight.
  EXPECT_NEAR(SlopeAmong(18.0, {.slope_sd = 0.1}), 0.2 * 3700.0 / (3700.0 + 9.0 * 3190.0), 0.02);
  EXPECT_NEAR(SlopeAmong(0.0, {.max_slope = 0.1}), 0.1, 1e-9);
}

PointsSeenTwice PointsWith(const std::vector<double>& first, const std::vector<double>& second) {
  PointsSeenTwice points(first.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].first.residual = first[i];
    points[i].second.residual = second[i];
    points[i].first.disparity_px = static_cast<double>(i);  // to know them by
  }
  return points;
}

std::vector<int> Kept(const PointsSeenTwice& points, const std::vector<double>& in_time,
                      const PlacementParams& params) {
  std::vector<int> kept;
  for (const PointSeenTwice& point : KeepClean(points, in_time, params)) {
    kept.push_back(static_cast<int>(point.first.disparity_px));
  }
  return kept;
}

using Numbers = std::vector<int>;

// Lower quartiles are 1.5, 1 and 2.
TEST(KeepCleanTest, LeavesOutWhatIsWorseThanTwiceTheLowerQuartile) {
  PlacementParams params{.max_residual_ratio = 2.0, .min_kept = 0};
  const PointsSeenTwice points = PointsWith({3.1, 1.0, 2.0, 1.5, 3.0}, {1.0, 1.0, 2.1, 1.0, 1.0});
  const std::vector<double> in_time{2.0, 2.0, 2.0, 2.0, 4.1};
  EXPECT_EQ(Kept(points, in_time, params), (Numbers{1, 3}));
  EXPECT_EQ(Kept(points, {}, params), (Numbers{1, 3, 4}));
  params.max_residual_ratio = 2.2;
  EXPECT_EQ(Kept(points, in_time, params), (Numbers{0, 1, 2, 3, 4}));
}

TEST(KeepCleanTest, KeepsTheBestOfFew) {
  PlacementParams params{.max_residual_ratio = 2.0};
  const PointsSeenTwice points = PointsWith({9.0, 1.0, 4.0, 1.0, 1.0}, {1.0, 1.0, 1.0, 8.0, 1.0});
  params.min_kept = 2;
  EXPECT_EQ(Kept(points, {}, params), (Numbers{1, 4}));
  params.min_kept = 3;
  EXPECT_EQ(Kept(points, {}, params), (Numbers{1, 2, 4}));
  params.min_kept = 4;
  EXPECT_EQ(Kept(points, {}, params), (Numbers{1, 2, 3, 4}));
  params.min_kept = 5;
  EXPECT_EQ(Kept(points, {}, params), (Numbers{0, 1, 2, 3, 4}));
  EXPECT_TRUE(KeepClean({}, {}, params).empty());
}

// Rounded pixels differ by a quarter of a grey level whatever they show.
TEST(KeepCleanTest, DoesNotJudgeLessThanRounding) {
  const PlacementParams params{.max_residual_ratio = 2.0, .min_kept = 0};
  const PointsSeenTwice points = PointsWith({0.0, 0.0, 0.9, 1.1}, {0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(Kept(points, {}, params), (Numbers{0, 1, 2}));
}

// Views of a plane after a motion, beside rays that meet it.

const RectifiedPair& Cameras() {
  static const RectifiedPair cameras = PlanePair({256, 192});
  return cameras;
}

// What the pair measures where the left eye's ray meets the plane normal . p = height.
StereoMeasurement SeeAt(const Pixel& pixel, const Vector3& normal, double height) {
  const Vector3 C = Cameras().left.C;
  const Vector3 ray = Triangulate(Cameras().left, Cameras().right, pixel, 1.0)->p_A - C;
  StereoMeasurement seen{.left = pixel,
                         .p_A = C + (height - normal.dot(C)) / normal.dot(ray) * ray};
  seen.disparity_px = PairProjection(Cameras())(seen.p_A)->z();
  return seen;
}

// With the slope of the disparities of neighbours: they are linear, so that any neighbour will do.
StereoMeasurement SeeSurface(const Pixel& pixel, const Vector3& normal, double height) {
  StereoMeasurement seen = SeeAt(pixel, normal, height);
  seen.slope << SeeAt(pixel + Pixel(9.0, 0.0), normal, height).disparity_px - seen.disparity_px,
      SeeAt(pixel + Pixel(0.0, 9.0), normal, height).disparity_px - seen.disparity_px;
  seen.slope /= 9.0;
  return seen;
}

void ExpectSeenAsRaysHaveIt(const Transform& X_FS, const Vector3& normal, double height) {
  const PlaneView see_again(Cameras(), X_FS.inverse());
  const PairProjection project(Cameras());
  for (const Pixel& pixel : {Pixel(128.0, 100.0), Pixel(60.5, 150.2), Pixel(200.0, 80.0)}) {
    const auto seen = see_again(SeeSurface(pixel, normal, height));
    ASSERT_TRUE(seen);
    for (const Pixel& by : {Pixel(0.0, 0.0), Pixel(-7.0, 5.0), Pixel(8.0, 8.0)}) {
      const StereoMeasurement first = SeeAt(pixel + by, normal, height);
      const auto second = project(X_FS.inverse() * first.p_A);
      ASSERT_TRUE(second);
      const Pixel offset = second->head<2>() - seen->pixel;
      const Pixel back = seen->view.by_offset * offset / (1.0 + seen->view.by_distance.dot(offset));
      EXPECT_LT((back - by).norm(), 1e-9);
      const auto middle = project(X_FS.inverse() * SeeAt(pixel, normal, height).p_A);
      EXPECT_NEAR(second->z(), middle->z() + seen->slope.dot(offset), 1e-9);
    }
  }
}

TEST(PlaneViewTest, GroundAndWallsAreSeenAsRaysHaveThem) {
  const Transform X_FS = math::MakePose({0.6, -0.1, 0.04}, 0.08, -0.03, 0.05);
  ExpectSeenAsRaysHaveIt(X_FS, Vector3(0.0, 0.0, 1.0), 0.0);
  ExpectSeenAsRaysHaveIt(X_FS, Vector3(-1.0, 0.2, 0.1), -2.5);
  // One that faces the cameras has no slope.
  const Vector3 ahead = Cameras().left.A;
  EXPECT_LT(SeeSurface({100.0, 90.0}, ahead, ahead.dot(Cameras().left.C) + 2.0).slope.norm(), 1e-9);
  ExpectSeenAsRaysHaveIt(X_FS, ahead, ahead.dot(Cameras().left.C) + 2.0);
}

TEST(PlaneViewTest, SeesNothingBehindOrFromTheEdge) {
  const StereoMeasurement ground = SeeSurface({128.0, 150.0}, Vector3(0.0, 0.0, 1.0), 0.0);
  const auto seen = [&](const Transform& X_FS) {
    return PlaneView(Cameras(), X_FS.inverse())(ground).has_value();
  };
  EXPECT_TRUE(seen(Transform::Identity()));
  // Driven past it.
  EXPECT_FALSE(seen(math::MakePose({6.0, 0.0, 0.0}, 0.0, 0.0, 0.0)));
  // Down on the ground, where a row has more disparity than the one above by over 0.75 px.
  EXPECT_FALSE(seen(math::MakePose({0.0, 0.0, -1.1}, 0.0, 0.0, 0.0)));
  // From so far that it is ten times smaller.
  EXPECT_FALSE(seen(math::MakePose({-30.0, 0.0, 0.0}, 0.0, math::DegToRad(-20.0), 0.0)));
}

}  // namespace
}  // namespace rockyard::vision

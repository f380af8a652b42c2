// From images of a plane with a known texture to points: each camera's image is painted by casting
// the rays of its pixels onto the plane, without any of the stages that are under test.
#include "perception/stereo_points.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/error.h"

namespace rockyard::perception {
namespace {

using math::Vector3;
using vision::CameraModel;
using vision::GrayImage;
using vision::Image;

constexpr vision::ImageSize kSize{96, 80};

// A sum of waves in many directions, 2 to 8 pixels long at the plane's distance.
class Texture {
 public:
  explicit Texture(double pixel_m) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (Wave& wave : waves_) {
      const double angle = 6.283185307179586 * share(random);
      const double number = 6.283185307179586 / (pixel_m * (3.0 + 6.0 * share(random)));
      wave = {number * std::cos(angle), number * std::sin(angle), 6.3 * share(random)};
    }
  }

  double At(double y_m, double z_m) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::sin(wave.y * y_m + wave.z * z_m + wave.phase);
    return 128.0 + 25.0 * sum / std::sqrt(static_cast<double>(waves_.size()) / 2.0);
  }

 private:
  struct Wave {
    double y, z, phase;
  };
  std::array<Wave, 40> waves_{};
};

// Looks along x of R, at height 0.5 m; `focal_px` along rows, 1.2 times as much along columns.
vision::Cahv LinearAt(double y_m, const vision::ImageSize& size, double focal_px) {
  const Vector3 axis(1.0, 0.0, 0.0);
  return {{0.1, y_m, 0.5},
          axis,
          Vector3(0.0, -focal_px, 0.0) + 0.5 * (size.columns - 1) * axis,
          Vector3(0.0, 0.0, -1.2 * focal_px) + 0.5 * (size.rows - 1) * axis};
}

Image<std::uint8_t> AllFree(const vision::ImageSize& size) { return {size.columns, size.rows, 1}; }

vision::StereoRig LinearRig(const vision::ImageSize& size = kSize, double focal_px = 60.0) {
  return {{LinearAt(0.06, size, focal_px), size},
          {LinearAt(-0.06, size, focal_px), size},
          AllFree(size),
          AllFree(size)};
}

// The wall x = wall_m as a camera sees it, each pixel the mean of 3 x 3 rays.
GrayImage Seen(const CameraModel& camera, double wall_m, const Texture& texture) {
  GrayImage image(camera.size.columns, camera.size.rows);
  for (int row = 0; row < image.height(); ++row) {
    for (int column = 0; column < image.width(); ++column) {
      double sum = 0.0;
      for (int i = 0; i < 9; ++i) {
        const vision::Pixel part(column + (i % 3 - 1) / 3.0, row + (i / 3 - 1) / 3.0);
        const vision::Ray ray = *vision::BackProject(camera, part);
        const double way = (wall_m - ray.origin.x()) / ray.direction.x();
        const Vector3 p = ray.origin + way * ray.direction;
        sum += texture.At(p.y(), p.z());
      }
      image.At(column, row) = static_cast<std::uint8_t>(std::clamp(sum / 9.0, 0.0, 255.0));
    }
  }
  return image;
}

StereoSearch Search(int level = 0) {
  return {.pyramid_level = level,
          .min_disparity_px = 1.0,
          .max_disparity_px = 16.0,
          .max_range_m = 5.0};
}

// Of the wall of disparity 60 px * 0.12 m / (wall - 0.1 m).
constexpr double kWall_m = 1.0;
constexpr double kPixel_m = 0.9 / 60.0;

StereoSight See(const vision::StereoRig& rig, const StereoSearch& search,
                const StereoMatchingParams& params = {}) {
  const Texture texture(kPixel_m);
  return StereoPoints(params, search, rig)
      .See(Seen(rig.left, kWall_m, texture), Seen(rig.right, kWall_m, texture));
}

// All but one point of a hundred. sigma_x = Z^2 sigma_d / (f b): a tenth of a pixel is 11 mm here.
void ExpectTheWall(const std::vector<Vector3>& points_R, double most_off_m) {
  double sum_m = 0.0;
  std::size_t off = 0;
  for (const Vector3& p : points_R) {
    off += std::abs(p.x() - kWall_m) > most_off_m ? 1 : 0;
    sum_m += p.x();
  }
  EXPECT_LT(off, points_R.size() / 100);
  EXPECT_NEAR(sum_m / static_cast<double>(points_R.size()), kWall_m, 0.2 * most_off_m);
}

TEST(StereoPointsTest, ALinearPairWithLongPixelsSeesTheWallWhereItIs) {
  const StereoSight sight = See(LinearRig(), Search());
  EXPECT_GT(sight.points_R.size(), 3500U);
  ExpectTheWall(sight.points_R, 0.06);
  EXPECT_EQ(sight.left.width(), kSize.columns);
  // Every point lies on the ray of its pixel: the rays of an image of 96 x 80 reach 0.7 m aside.
  for (const Vector3& p : sight.points_R) {
    const auto pixel = vision::Project(LinearRig().left, p);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), std::round(pixel->x()), 1e-9);
    EXPECT_NEAR(pixel->y(), std::round(pixel->y()), 1e-9);
  }
}

TEST(StereoPointsTest, ImagesAreReducedBeforeTheyAreMatched) {
  const vision::ImageSize large{192, 160};
  const StereoSight sight = See(LinearRig(large, 120.0), Search(1));
  EXPECT_EQ(sight.left.width(), 96);
  EXPECT_EQ(sight.disparities.height(), 80);
  EXPECT_GT(sight.points_R.size(), 3500U);
  ExpectTheWall(sight.points_R, 0.06);
}

// Distorted, and turned against each other: without resampling nothing would match.
TEST(StereoPointsTest, CamerasThatAreNotAlignedAreResampled) {
  const auto camera = [](double y_m, double yaw_rad, double roll_rad) {
    vision::BrownPinhole lens;
    lens.X_AC.linear().col(0) = Vector3(0.0, -1.0, 0.0);
    lens.X_AC.linear().col(1) = Vector3(0.0, 0.0, -1.0);
    lens.X_AC.linear().col(2) = Vector3(1.0, 0.0, 0.0);
    lens.X_AC.linear() = (Eigen::AngleAxisd(yaw_rad, Vector3::UnitZ()) *
                          Eigen::AngleAxisd(roll_rad, Vector3::UnitX()))
                             .toRotationMatrix() *
                         lens.X_AC.linear();
    lens.X_AC.translation() = Vector3(0.1, y_m, 0.5);
    lens.fx_px = lens.fy_px = 60.0;
    lens.cx_px = 47.5;
    lens.cy_px = 39.5;
    lens.k1 = -0.1;
    return CameraModel{lens, kSize};
  };
  const vision::StereoRig rig{camera(0.06, 0.03, 0.04), camera(-0.06, -0.02, -0.04), AllFree(kSize),
                              AllFree(kSize)};
  const StereoSight sight = See(rig, Search());
  EXPECT_GT(sight.points_R.size(), 2500U);
  ExpectTheWall(sight.points_R, 0.08);
}

TEST(StereoPointsTest, WhatIsOutOfRangeIsDropped) {
  // The wall's disparity is 8 px.
  StereoSearch search = Search();
  search.min_disparity_px = 8.5;
  EXPECT_LT(See(LinearRig(), search).points_R.size(), 100U);
  search.min_disparity_px = 1.0;
  search.max_disparity_px = 7.5;
  EXPECT_LT(See(LinearRig(), search).points_R.size(), 100U);
  // Whole disparities are searched beyond the ends, points beyond them are not handed on.
  search.max_disparity_px = 8.0;
  const StereoSight half = See(LinearRig(), search);
  EXPECT_GT(half.points_R.size(), 300U);
  for (const Vector3& p : half.points_R) EXPECT_GE(p.x(), kWall_m - 1e-9);
  // From the left eye the middle of the wall is 0.9 m away, its corners more.
  search = Search();
  search.max_range_m = 0.95;
  const StereoSight near = See(LinearRig(), search);
  EXPECT_GT(near.points_R.size(), 300U);
  for (const Vector3& p : near.points_R) EXPECT_LE((p - Vector3(0.1, 0.06, 0.5)).norm(), 0.95);
}

// A window of 7 reaches 3 pixels to either side.
TEST(StereoPointsTest, NoPointComesFromAWindowThatSharesAPixelWithTheRover) {
  vision::StereoRig rig = LinearRig();
  for (int row = 60; row < kSize.rows; ++row) {
    for (int column = 40; column < 50; ++column) rig.left_free.At(column, row) = 0;
  }
  const StereoSight masked = See(rig, Search());
  const StereoSight whole = See(LinearRig(), Search());
  int lost = 0;
  for (int row = 0; row < kSize.rows; ++row) {
    for (int column = 0; column < kSize.columns; ++column) {
      const bool touches = row >= 57 && column >= 37 && column < 53;
      const bool before = vision::IsValid(whole.disparities.At(column, row));
      const bool after = vision::IsValid(masked.disparities.At(column, row));
      EXPECT_EQ(after, before && !touches) << column << ", " << row;
      lost += before && touches ? 1 : 0;
    }
  }
  EXPECT_GT(lost, 100);
}

TEST(StereoPointsTest, AReducedPixelIsTheRoversWhereAnyOfItsPixelsIs) {
  vision::StereoRig rig = LinearRig({192, 160}, 120.0);
  rig.left_free.At(101, 81) = 0;  // of pixel (50, 40)
  const StereoSight masked = See(rig, Search(1));
  for (int row = 37; row <= 43; ++row) {
    for (int column = 47; column <= 53; ++column) {
      EXPECT_FALSE(vision::IsValid(masked.disparities.At(column, row)));
    }
  }
  EXPECT_TRUE(vision::IsValid(masked.disparities.At(54, 40)));
}

TEST(StereoPointsTest, CamerasThatCannotBeAlignedAreRefused) {
  vision::StereoRig rig = LinearRig();
  rig.right = rig.left;
  EXPECT_THROW(StereoPoints({}, Search(), rig), core::UserError);
}

}  // namespace
}  // namespace rockyard::perception

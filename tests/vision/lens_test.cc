#include "vision/lens.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace rockyard::vision {
namespace {

using math::Vector3;
using messages::Lens;

constexpr std::array kLenses{Lens::kEquidistantRows, Lens::kEquidistant, Lens::kPinhole};

messages::Camera Camera(Lens lens) {
  return {.lens = lens, .column_pitch_rad = 0.0029, .row_pitch_rad = 0.0034};
}

TEST(Lens, AxisIsPixelZeroAndRightAndDownArePositive) {
  for (const Lens lens : kLenses) {
    EXPECT_NEAR((PixelRay(Camera(lens), {}) - Vector3::UnitX()).norm(), 0.0, 1e-15);
    EXPECT_LT(PixelRay(Camera(lens), {10.0, 0.0}).y(), 0.0);
    EXPECT_LT(PixelRay(Camera(lens), {0.0, 10.0}).z(), 0.0);
  }
}

TEST(Lens, ProjectInvertsPixelRayOverTheWholeImage) {
  for (const Lens lens : kLenses) {
    for (double column = -384.0; column <= 384.0; column += 48.0) {
      for (double row = -242.0; row <= 242.0; row += 22.0) {
        const Vector3 ray = PixelRay(Camera(lens), {column, row});
        EXPECT_NEAR(ray.norm(), 1.0, 1e-14);
        const auto pixel = Project(Camera(lens), 0.37 * ray);
        ASSERT_TRUE(pixel.has_value());
        EXPECT_NEAR(pixel->column_px, column, 1e-9);
        EXPECT_NEAR(pixel->row_px, row, 1e-9);
      }
    }
  }
}

// r = f theta: an image position 300 columns and 200 rows from the axis lies
// hypot(300 * 2.9, 200 * 3.4) mrad from it.
TEST(Lens, EquidistantAngleFromTheAxisIsProportionalToTheImageRadius) {
  const Vector3 ray = PixelRay(Camera(Lens::kEquidistant), {300.0, 200.0});
  EXPECT_NEAR(std::acos(ray.x()), std::hypot(0.87, 0.68), 1e-12);
}

TEST(Lens, RowsOfTheSeparableLensArePlanesThroughTheLateralAxis) {
  const messages::Camera camera = Camera(Lens::kEquidistantRows);
  const double depression = 150.0 * camera.row_pitch_rad;
  const Vector3 normal(std::sin(depression), 0.0, std::cos(depression));
  for (double column = -380.0; column <= 380.0; column += 20.0) {
    EXPECT_NEAR(normal.dot(PixelRay(camera, {column, 150.0})), 0.0, 1e-15);
  }
  // The radially symmetric lens bends the same row.
  EXPECT_GT(std::abs(normal.dot(PixelRay(Camera(Lens::kEquidistant), {380.0, 150.0}))), 0.01);
}

TEST(Lens, PinholeKeepsStraightLinesStraight) {
  const messages::Camera camera = Camera(Lens::kPinhole);
  const Vector3 a = PixelRay(camera, {-200.0, 40.0});
  const Vector3 b = PixelRay(camera, {100.0, 90.0});
  const auto between = Project(camera, 0.5 * a / a.x() + 0.5 * b / b.x());
  ASSERT_TRUE(between.has_value());
  EXPECT_NEAR(between->column_px, -50.0, 1e-9);
  EXPECT_NEAR(between->row_px, 65.0, 1e-9);
}

// Straight down the middle of the image the lens makes one number of an angle.
TEST(Lens, ImageOfAnAngleIsWhereItsDirectionIsProjected) {
  for (const Lens lens : kLenses) {
    for (const double angle_rad : {-1.2, -0.3, 0.0, 0.7, 1.5}) {
      const Vector3 down(std::cos(angle_rad), 0.0, -std::sin(angle_rad));
      const auto pixel = Project(Camera(lens), down);
      ASSERT_TRUE(pixel.has_value());
      EXPECT_NEAR(ImageOfAngle(lens, angle_rad), pixel->row_px * 0.0034, 1e-12);
    }
  }
  EXPECT_NEAR(ImageOfAngle(Lens::kPinhole, 0.7), std::tan(0.7), 1e-15);
  EXPECT_EQ(ImageOfAngle(Lens::kEquidistant, 0.7), 0.7);
}

// Where an image is larger than that, two of its positions have the same direction.
TEST(Lens, ImagesEndWithTheDirectionsOfTheLens) {
  constexpr double kHalfTurn = std::numbers::pi;
  EXPECT_TRUE(HasDirections(Lens::kEquidistantRows, 0.5 * kHalfTurn, 0.5 * kHalfTurn));
  EXPECT_FALSE(HasDirections(Lens::kEquidistantRows, 0.51 * kHalfTurn, 0.1));
  EXPECT_FALSE(HasDirections(Lens::kEquidistantRows, 0.1, 0.51 * kHalfTurn));
  EXPECT_TRUE(HasDirections(Lens::kEquidistant, 0.6 * kHalfTurn, 0.79 * kHalfTurn));
  EXPECT_FALSE(HasDirections(Lens::kEquidistant, 0.6 * kHalfTurn, 0.81 * kHalfTurn));
  EXPECT_TRUE(HasDirections(Lens::kPinhole, 100.0, 100.0));
}

TEST(Lens, WhatNoLensSeesHasNoPixel) {
  EXPECT_FALSE(Project(Camera(Lens::kPinhole), Vector3(-1.0, 0.1, 0.0)).has_value());
  EXPECT_FALSE(Project(Camera(Lens::kPinhole), Vector3(0.0, 1.0, 0.0)).has_value());
  EXPECT_FALSE(Project(Camera(Lens::kEquidistant), -Vector3::UnitX()).has_value());
  EXPECT_FALSE(Project(Camera(Lens::kEquidistantRows), Vector3::UnitY()).has_value());
  for (const Lens lens : kLenses) {
    EXPECT_FALSE(Project(Camera(lens), Vector3::Zero()).has_value());
  }
}

}  // namespace
}  // namespace rockyard::vision

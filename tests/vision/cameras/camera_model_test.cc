// Every model of a camera against what can be worked out by hand; levels of a pyramid, moves.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "vision/cameras/test_cameras.h"
#include "vision/each_pixel.h"
#include "vision/lens.h"

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
  for (const Lens lens : kLenses) EXPECT_FALSE(Project(Camera(lens), Vector3::Zero()).has_value());
}

// Every model against what can be worked out by hand.

// f = 200 px, axis z, middle at (100, 80).
Cahv PlainCahv() { return {Vector3::Zero(), Vector3::UnitZ(), {200, 0, 100}, {0, 200, 80}}; }

Cahvore PlainCahvore(double linearity) {
  return {PlainCahv(),     Vector3::UnitZ(),      Vector3::Zero(),
          Vector3::Zero(), CahvoreType::kGeneral, linearity};
}

// A direction in the plane of rows, theta to the right of z.
Vector3 RightBy(double theta_rad) { return {std::sin(theta_rad), 0.0, std::cos(theta_rad)}; }

TEST(CahvTest, IsTheQuotientOfDotProducts) {
  const Cahv camera{{1, 2, 3}, {0, 0, 1}, {200, 0, 100}, {10, 210, 80}};
  // (p - C) = (0.5, -1, 2): H gives 300, V -45, A 2.
  const auto pixel = Project(camera, {1.5, 1.0, 5.0});
  ASSERT_TRUE(pixel);
  EXPECT_DOUBLE_EQ(pixel->x(), 150.0);
  EXPECT_DOUBLE_EQ(pixel->y(), -22.5);
}

TEST(CahvTest, AMirroredCameraLooksForwardsToo) {
  const Cahv camera{Vector3::Zero(), Vector3::UnitZ(), {-200, 0, 100}, {0, 200, 80}};
  const auto ray = BackProject(camera, {0.0, 80.0});
  ASSERT_TRUE(ray);
  EXPECT_LT((ray->direction - Vector3(100, 0, 200).normalized()).norm(), 1e-15);
}

TEST(CahvorTest, StretchesTheSlopeByItsPolynomial) {
  const Cahvor camera{PlainCahv(), Vector3::UnitZ(), {0.01, -0.1, 0.02}};
  // tau = 0.3^2 + 0.4^2 = 0.25: 1.01 - 0.025 + 0.00125.
  const auto pixel = Project(camera, {0.6, -0.8, 2.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 100.0 + 200.0 * 0.3 * 0.98625, 1e-12);
  EXPECT_NEAR(pixel->y(), 80.0 - 200.0 * 0.4 * 0.98625, 1e-12);
}

TEST(CahvorTest, TheLengthOfItsAxisDoesNotMatter) {
  const Vector3 O = Vector3(0.02, -0.01, 1.0).normalized();
  const Cahvor unit{PlainCahv(), O, {0.01, -0.1, 0.02}};
  const Cahvor printed{PlainCahv(), 1.0005 * O, {0.01, -0.1, 0.02}};
  const Vector3 p(0.3, 0.5, 1.0);
  EXPECT_LT((*Project(unit, p) - *Project(printed, p)).norm(), 1e-10);
}

TEST(CahvoreTest, WithoutPupilShiftAndWithLinearityOneItIsCahvor) {
  const Vector3 O = Vector3(0.02, -0.01, 1.0).normalized();
  const Vector3 R(0.003, -0.05, 0.012);
  const Cahvor cahvor{TestCahv(), O, R};
  const Cahvore perspective{TestCahv(), O, R, Vector3::Zero(), CahvoreType::kPerspective, 0.3};
  const Cahvore general{TestCahv(), O, R, Vector3::Zero(), CahvoreType::kGeneral, 1.0};
  for (double x = -0.9; x < 1.0; x += 0.1) {
    for (double y = -0.9; y < 1.0; y += 0.1) {
      const Vector3 p(x, y, 0.8);
      const auto expected = Project(cahvor, p);
      ASSERT_TRUE(expected);
      EXPECT_LT((*Project(perspective, p) - *expected).norm(), 1e-9);
      EXPECT_LT((*Project(general, p) - *expected).norm(), 1e-9);
      const auto ray = BackProject(perspective, *expected);
      ASSERT_TRUE(ray);
      EXPECT_LT((ray->direction - p.normalized()).norm(), 1e-12);
    }
  }
}

TEST(CahvoreTest, TheLinearityIsTheLawOfTheLens) {
  using std::numbers::pi;
  for (const double theta : {0.1, 0.7, 1.2}) {
    const auto radius = [&](const Cahvore& camera) {
      const auto pixel = Project(camera, 3.0 * RightBy(theta));
      EXPECT_TRUE(pixel);
      EXPECT_NEAR(pixel->y(), 80.0, 1e-10);
      return (pixel->x() - 100.0) / 200.0;
    };
    Cahvore fisheye = PlainCahvore(0.9);
    fisheye.type = CahvoreType::kFisheye;
    EXPECT_NEAR(radius(fisheye), theta, 1e-12);  // equidistant
    EXPECT_NEAR(radius(PlainCahvore(0.0)), theta, 1e-12);
    EXPECT_NEAR(radius(PlainCahvore(1.0)), std::tan(theta), 1e-12);               // perspective
    EXPECT_NEAR(radius(PlainCahvore(0.5)), 2.0 * std::tan(0.5 * theta), 1e-12);   // stereographic
    EXPECT_NEAR(radius(PlainCahvore(-0.5)), 2.0 * std::sin(0.5 * theta), 1e-12);  // equisolid
    EXPECT_NEAR(radius(PlainCahvore(-1.0)), std::sin(theta), 1e-12);              // orthographic
  }
  EXPECT_DOUBLE_EQ(LargestAngle(1.0), 0.5 * pi);
  EXPECT_DOUBLE_EQ(LargestAngle(-0.8), 0.625 * pi);
  EXPECT_DOUBLE_EQ(LargestAngle(0.0), pi);
}

TEST(CahvoreTest, TheEntrancePupilMovesAlongTheAxis) {
  Cahvore camera = PlainCahvore(0.37);
  camera.E = Vector3(0.01, 0.02, -0.005);
  for (const double theta : {1e-5, 1e-3, 0.2, 0.8, 1.4, 2.1}) {
    // A point on the line of sight under theta, from where Gennery has it leave the axis.
    const double pupil_m = 0.01 + 0.02 * std::pow(theta, 2) - 0.005 * std::pow(theta, 4);
    const double s_m = (theta / std::sin(theta) - 1.0) * pupil_m;
    const Vector3 p = Vector3(0, 0, s_m) + 0.6 * RightBy(theta);
    const auto pixel = Project(camera, p);
    ASSERT_TRUE(pixel) << theta;
    EXPECT_NEAR(pixel->x(), 100.0 + 200.0 * std::tan(0.37 * theta) / 0.37, 1e-9) << theta;
    const auto ray = BackProject(camera, *pixel);
    ASSERT_TRUE(ray);
    EXPECT_LT((ray->origin - Vector3(0, 0, s_m)).norm(), 1e-12) << theta;
    EXPECT_LT((ray->direction - RightBy(theta)).norm(), 1e-12) << theta;
  }
}

TEST(BrownPinholeTest, IsTheFormulaInThirtyDigits) {
  BrownPinhole camera{math::Transform::Identity(), 310, 300, 322, 236};
  camera.k1 = -0.11;
  camera.k2 = 0.03;
  camera.k3 = -0.002;
  camera.p1 = 0.0012;
  camera.p2 = -0.0008;
  struct Case {
    Vector3 p;
    Pixel pixel;
  };
  // By mpmath with 30 digits.
  const Case cases[] = {{{0.3, -0.2, 1.5}, {383.55813193499, 196.296631726529}},
                        {{-1.1, 0.7, 1.0}, {16.958326, 424.20794}},
                        {{0.9, 0.8, 0.9}, {596.92376736458, 473.51990077293}},
                        {{-0.4, -1.2, 2.0}, {262.408576, 63.42464}}};
  for (const Case& test : cases) {
    const auto pixel = Project(camera, test.p);
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - test.pixel).norm(), 1e-11);
  }
}

// Levels of a pyramid, moves.

// The mean over factor x factor pixels.
Image<double> BoxReduced(const Image<double>& image, int factor) {
  Image<double> reduced(image.width() / factor, image.height() / factor);
  ForEachPixel(reduced.width(), reduced.height(), [&](int x, int y) {
    ForEachPixel(factor, factor, [&](int dx, int dy) {
      reduced.At(x, y) += image.At(factor * x + dx, factor * y + dy) / (factor * factor);
    });
  });
  return reduced;
}

// An image that shows its own column numbers has, after box filters, at each pixel the place from
// where it comes. The ray of that pixel by the reduced camera must be the ray of that place.
TEST(CameraModelTest, AReducedCameraSeesWhereTheBoxFiltersPixelsComeFrom) {
  for (const NamedCamera& named : ModelCameras()) {
    const ImageSize& size = named.camera.size;
    const auto columns = ImageOf<double>(size.columns, size.rows, [](int x, int) { return x; });
    const auto rows = ImageOf<double>(size.columns, size.rows, [](int, int y) { return y; });
    for (const int factor : {2, 3, 4}) {
      const Image<double> from_columns = BoxReduced(columns, factor);
      const Image<double> from_rows = BoxReduced(rows, factor);
      const CameraModel reduced = Reduced(named.camera, factor);
      ASSERT_EQ(reduced.size, (ImageSize{from_columns.width(), from_columns.height()}));
      for (int y = 0; y < reduced.size.rows; y += 37) {
        for (int x = 0; x < reduced.size.columns; x += 41) {
          const auto ray = BackProject(reduced, Pixel(x, y));
          const auto from =
              BackProject(named.camera, Pixel(from_columns.At(x, y), from_rows.At(x, y)));
          ASSERT_TRUE(ray && from);
          ASSERT_LT((ray->direction - from->direction).norm(), 1e-11) << named.name << factor;
        }
      }
    }
  }
}

TEST(CameraModelTest, HalfAPixelShiftsInAReducedImage) {
  const CameraModel camera{TestCahv(), {641, 481}};
  const CameraModel half = Reduced(camera, 2);
  EXPECT_EQ(half.size, (ImageSize{320, 240}));
  const Vector3 p(0.2, 0.1, 1.0);
  // (column + 1/2) / 2 - 1/2.
  EXPECT_LT((*Project(half, p) - (0.5 * *Project(camera, p) - Pixel(0.25, 0.25))).norm(), 1e-12);
  // Twice by two is once by four.
  EXPECT_LT((*Project(Reduced(half, 2), p) - *Project(Reduced(camera, 4), p)).norm(), 1e-12);
  EXPECT_EQ(*Project(Reduced(camera, 1), p), *Project(camera, p));
}

TEST(CameraModelTest, AMovedCameraSeesAMovedWorld) {
  const math::Transform X_BA = math::MakePose({-3.0, 5.0, 0.5}, -2.0, 0.7, 1.1);
  for (const NamedCamera& named : ModelCameras()) {
    const CameraModel moved = Moved(X_BA, named.camera);
    EXPECT_LT((CentreOf(moved) - X_BA * CentreOf(named.camera)).norm(), 1e-12);
    for (const Pixel& pixel : {Pixel(3, 4), Pixel(600, 100), Pixel(320, 470)}) {
      const auto ray = BackProject(named.camera, pixel);
      ASSERT_TRUE(ray);
      const auto back = Project(moved, X_BA * (ray->origin + 0.8 * ray->direction));
      ASSERT_TRUE(back);
      EXPECT_LT((*back - pixel).norm(), 1e-9) << named.name;
    }
  }
}

TEST(CameraModelTest, DirectionsAreThoseOfPointsFarAway) {
  for (const NamedCamera& named : ModelCameras()) {
    const Pixel pixel(200.0, 150.0);
    const auto ray = BackProject(named.camera, pixel);
    ASSERT_TRUE(ray);
    const auto back = ProjectDirection(named.camera, 0.02 * ray->direction);
    ASSERT_TRUE(back);
    EXPECT_LT((*back - pixel).norm(), 1e-6) << named.name;
  }
}

TEST(CameraModelTest, PixelsEndHalfAPixelBeyondTheirCentres) {
  const ImageSize size{10, 6};
  EXPECT_TRUE(IsInside(size, {-0.5, -0.5}));
  EXPECT_FALSE(IsInside(size, {-0.51, 0.0}));
  EXPECT_FALSE(IsInside(size, {0.0, -0.51}));
  EXPECT_TRUE(IsInside(size, {9.49, 5.49}));
  EXPECT_FALSE(IsInside(size, {9.5, 0.0}));
  EXPECT_FALSE(IsInside(size, {0.0, 5.5}));
  EXPECT_EQ(MiddleOf(size), Pixel(4.5, 2.5));
}

TEST(CameraModelTest, MoreThanTheImageCannotBeOnePixel) {
  const CameraModel camera{TestCahv(), {64, 4}};
  EXPECT_THROW(Reduced(camera, 5), core::ContractViolation);
  EXPECT_THROW(Reduced(camera, 0), core::ContractViolation);
}

}  // namespace
}  // namespace rockyard::vision

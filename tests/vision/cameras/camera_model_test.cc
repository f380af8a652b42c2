// Levels of a pyramid, moves.
#include <gtest/gtest.h>

#include "core/check.h"
#include "vision/cameras/test_cameras.h"
#include "vision/each_pixel.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

// The mean over factor x factor pixels.
Image<double> BoxReduced(const Image<double>& image, int factor) {
  Image<double> reduced(image.width() / factor, image.height() / factor);
  ForEachPixel(reduced.width(), reduced.height(), [&](int x, int y) {
    for (int dy = 0; dy < factor; ++dy) {
      for (int dx = 0; dx < factor; ++dx) {
        reduced.At(x, y) += image.At(factor * x + dx, factor * y + dy) / (factor * factor);
      }
    }
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

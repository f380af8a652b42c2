// Pixel to ray and back, over dense grids of every model and every flight camera.
#include <gtest/gtest.h>

#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

constexpr int kSteps = 40;

// From corner to corner, over the edges by a tenth.
Pixel GridPixel(const ImageSize& size, int i, int j) {
  const auto place = [](int step, int pixels) {
    return (-0.1 + 1.2 * step / kSteps) * (pixels - 1);
  };
  return {place(i, size.columns), place(j, size.rows)};
}

void ExpectRoundTrips(const NamedCamera& named) {
  const CameraModel& camera = named.camera;
  double worst_px = 0.0;
  int missing = 0;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Pixel pixel = GridPixel(camera.size, i, j);
      const auto ray = BackProject(camera, pixel);
      if (!ray) {
        missing += IsInside(camera.size, pixel) ? 1 : 0;
        continue;
      }
      EXPECT_NEAR(ray->direction.norm(), 1.0, 1e-12) << named.name;
      for (const double range_m : {0.3, 2.0, 50.0, 1e4}) {
        const auto back = Project(camera, ray->origin + range_m * ray->direction);
        ASSERT_TRUE(back) << named.name << " " << pixel.transpose() << " at " << range_m;
        worst_px = std::max(worst_px, (*back - pixel).norm());
      }
    }
  }
  EXPECT_LT(worst_px, 1e-7) << named.name;
  EXPECT_EQ(missing, 0) << named.name;
}

TEST(CameraRoundTripTest, EveryModelAndType) {
  for (const NamedCamera& named : ModelCameras()) ExpectRoundTrips(named);
}

TEST(CameraRoundTripTest, EveryFlightCamera) {
  for (const NamedCamera& named : FlightCameras()) ExpectRoundTrips(named);
}

TEST(CameraRoundTripTest, AFullFisheyeBeyondARightAngle) {
  // 1.9 rad off the axis at the corners.
  const Cahv linear{Vector3::Zero(), Vector3::UnitZ(), {250, 0, 319.5}, {0, 250, 239.5}};
  const Vector3 E(0.002, 0.001, 0.0005);
  for (const double linearity : {0.0, -0.2, -0.5, 0.2}) {
    const Cahvore lens{linear, Vector3::UnitZ(),      {0.0, 0.01, -0.001},
                       E,      CahvoreType::kGeneral, linearity};
    const CameraModel camera{lens, {640, 480}};
    double largest_rad = 0.0;
    for (int column = 0; column < 640; column += 9) {
      const Pixel pixel(column, 100 + column / 10);
      const auto ray = BackProject(camera, pixel);
      ASSERT_TRUE(ray);
      largest_rad = std::max(largest_rad, std::acos(ray->direction.z()));
      const auto back = Project(camera, ray->origin + 1.7 * ray->direction);
      ASSERT_TRUE(back) << pixel.transpose() << " " << linearity;
      EXPECT_LT((*back - pixel).norm(), 1e-8);
    }
    EXPECT_GT(largest_rad, 1.1);
  }
}

TEST(CameraRoundTripTest, ThePixelOnTheAxisAndItsNeighbours) {
  for (const NamedCamera& named : ModelCameras()) {
    const auto* cahvore = std::get_if<Cahvore>(&named.camera.lens);
    if (cahvore == nullptr) continue;
    const auto axis = Project(named.camera, cahvore->linear.C + 2.0 * cahvore->O);
    ASSERT_TRUE(axis);
    for (const double aside_px : {0.0, 1e-12, 1e-8, 1e-6, 1e-3, 0.03, 0.05}) {
      const Pixel pixel = *axis + Pixel(aside_px, -0.3 * aside_px);
      const auto ray = BackProject(named.camera, pixel);
      ASSERT_TRUE(ray);
      EXPECT_LT((ray->origin - cahvore->linear.C).norm(), 1e-8);
      const auto back = Project(named.camera, ray->origin + 3.0 * ray->direction);
      ASSERT_TRUE(back);
      EXPECT_LT((*back - pixel).norm(), 1e-9) << named.name << " " << aside_px;
    }
  }
}

}  // namespace
}  // namespace rockyard::vision

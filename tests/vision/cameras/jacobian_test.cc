// Derivatives against central differences.
#include <gtest/gtest.h>

#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

void ExpectPixelJacobian(const NamedCamera& named, const Vector3& p_A) {
  PixelJacobian jacobian;
  ASSERT_TRUE(Project(named.camera, p_A, &jacobian)) << named.name;
  const double step_m = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 step = step_m * Vector3::Unit(axis);
    const auto ahead = Project(named.camera, p_A + step);
    const auto behind = Project(named.camera, p_A - step);
    ASSERT_TRUE(ahead && behind) << named.name;
    const Eigen::Vector2d slope = (*ahead - *behind) / (2.0 * step_m);
    EXPECT_LT((jacobian.col(axis) - slope).norm(), 1e-5 * jacobian.norm())
        << named.name << " " << p_A.transpose() << "\n"
        << jacobian << "\n"
        << slope.transpose();
  }
}

void ExpectRayJacobian(const NamedCamera& named, const Pixel& pixel) {
  RayJacobian jacobian;
  ASSERT_TRUE(BackProject(named.camera, pixel, &jacobian)) << named.name;
  const double step_px = 0.01;
  for (int axis = 0; axis < 2; ++axis) {
    const Pixel step = step_px * Pixel::Unit(axis);
    const auto ahead = BackProject(named.camera, pixel + step);
    const auto behind = BackProject(named.camera, pixel - step);
    ASSERT_TRUE(ahead && behind) << named.name;
    const Vector3 turn = (ahead->direction - behind->direction) / (2.0 * step_px);
    const Vector3 shift_m = (ahead->origin - behind->origin) / (2.0 * step_px);
    EXPECT_LT((jacobian.direction.col(axis) - turn).norm(), 1e-5 * jacobian.direction.norm())
        << named.name << " " << pixel.transpose();
    EXPECT_LT((jacobian.origin.col(axis) - shift_m).norm(), 1e-5 * jacobian.origin.norm() + 1e-12)
        << named.name << " " << pixel.transpose();
  }
}

void ExpectJacobians(const NamedCamera& named) {
  const ImageSize& size = named.camera.size;
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; j <= 8; ++j) {
      const Pixel pixel(i * (size.columns - 1) / 8.0, j * (size.rows - 1) / 8.0);
      ExpectRayJacobian(named, pixel);
      const auto ray = BackProject(named.camera, pixel);
      for (const double range_m : {0.5, 4.0}) {
        ExpectPixelJacobian(named, ray->origin + range_m * ray->direction);
      }
    }
  }
}

TEST(CameraJacobianTest, EveryModelAndType) {
  for (const NamedCamera& named : ModelCameras()) ExpectJacobians(named);
}

TEST(CameraJacobianTest, EveryFlightCamera) {
  for (const NamedCamera& named : FlightCameras()) ExpectJacobians(named);
}

TEST(CameraJacobianTest, OnTheOpticalAxis) {
  for (const NamedCamera& named : ModelCameras()) {
    Vector3 ahead = TestPose().linear().col(2);
    if (const auto* cahvor = std::get_if<Cahvor>(&named.camera.lens)) ahead = cahvor->O;
    if (const auto* cahvore = std::get_if<Cahvore>(&named.camera.lens)) ahead = cahvore->O;
    for (const double aside : {0.0, 3e-10, 3e-6}) {
      const Vector3 across = ahead.unitOrthogonal();
      const Vector3 p_A = CentreOf(named.camera) + 1.5 * (ahead + aside * across);
      ExpectPixelJacobian(named, p_A);
      const auto pixel = Project(named.camera, p_A);
      ASSERT_TRUE(pixel);
      ExpectRayJacobian(named, *pixel);
    }
  }
}

TEST(CameraJacobianTest, AreLeftAloneWhereNothingIsSeen) {
  for (const NamedCamera& named : ModelCameras()) {
    PixelJacobian jacobian = PixelJacobian::Constant(7.0);
    EXPECT_FALSE(Project(named.camera, CentreOf(named.camera), &jacobian)) << named.name;
    EXPECT_EQ(jacobian, PixelJacobian::Constant(7.0)) << named.name;
  }
}

}  // namespace
}  // namespace rockyard::vision

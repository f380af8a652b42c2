#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/angles.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using core::JsonValue;
using math::Vector3;

// Real flight cameras against the values that other implementations compute of them.

Vector3 VectorIn(const JsonValue& list) {
  return {list.list()[0].number(), list.list()[1].number(), list.list()[2].number()};
}

Pixel PixelIn(const JsonValue& list) { return {list.list()[0].number(), list.list()[1].number()}; }

TEST(FlightModelsTest, PointsOnRaysOfTheFlightCodeAreImagedWhereTheyBelong) {
  const JsonValue data = LoadCameraData("flight_models.json");
  const double tolerance_px = data.Find("tolerance_px")->number();
  int points = 0;
  for (const JsonValue& model : data.Find("models")->list()) {
    const CameraModel camera = CameraOf(*model.Find("camera"));
    for (const JsonValue& ray : model.Find("rays")->list()) {
      const Vector3 origin = VectorIn(*ray.Find("origin"));
      const Vector3 direction = VectorIn(*ray.Find("direction"));
      const JsonValue::List& expected = ray.Find("px_at_0.7_3_30_m")->list();
      const double ranges_m[] = {0.7, 3.0, 30.0};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto pixel = Project(camera, origin + ranges_m[i] * direction);
        ASSERT_TRUE(pixel) << model.Find("name")->text();
        EXPECT_LT((*pixel - PixelIn(*ray.Find("px"))).norm(), tolerance_px);
        EXPECT_LT((*pixel - PixelIn(expected[i])).norm(), tolerance_px);
        ++points;
      }
    }
  }
  EXPECT_EQ(points, 11 * 9 * 3);
}

TEST(FlightModelsTest, PixelsHaveTheRaysOfTheFlightCode) {
  const JsonValue data = LoadCameraData("flight_models.json");
  for (const JsonValue& model : data.Find("models")->list()) {
    const CameraModel camera = CameraOf(*model.Find("camera"));
    for (const JsonValue& expected : model.Find("rays")->list()) {
      const auto ray = BackProject(camera, PixelIn(*expected.Find("px")));
      ASSERT_TRUE(ray) << model.Find("name")->text();
      // 1e-6 of an angle is 0.005 px of none of these; O is of length 1 to 1e-6.
      EXPECT_LT((ray->direction - VectorIn(*expected.Find("direction"))).norm(), 2e-6);
      EXPECT_LT((ray->origin - VectorIn(*expected.Find("origin"))).norm(), 1e-7);
    }
  }
}

TEST(FlightModelsTest, ProjectionsAreThoseThatMrcalPublishes) {
  const JsonValue data = LoadCameraData("mrcal_projections.json");
  const JsonValue::List& f = data.Find("fx_fy_cx_cy_px")->list();
  const double alpha = data.Find("alpha_beta_rad")->list()[0].number();
  const double beta = data.Find("alpha_beta_rad")->list()[1].number();
  const Cahv linear{Vector3::Zero(),
                    Vector3::UnitZ(),
                    {f[0].number(), 0, f[2].number()},
                    {0, f[1].number(), f[3].number()}};
  const Vector3 O(std::sin(alpha) * std::cos(beta), std::sin(beta),
                  std::cos(alpha) * std::cos(beta));
  const Vector3 R = VectorIn(*data.Find("R"));
  int compared = 0;
  for (const JsonValue& expected : data.Find("expected")->list()) {
    CameraModel camera{Cahvor{linear, O, R}, {4000, 2200}};
    if (expected.Find("model")->text() == "cahvore") {
      camera.lens = Cahvore{linear,
                            O,
                            R,
                            VectorIn(*expected.Find("E")),
                            CahvoreType::kGeneral,
                            expected.Find("linearity")->number()};
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto pixel = Project(camera, VectorIn(data.Find("points_m")->list()[i]));
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - PixelIn(expected.Find("px")->list()[i])).norm(), 5e-5);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 12);
}

TEST(FlightModelsTest, TheMiddlePixelPointsWhereTheLabelSays) {
  const JsonValue data = LoadCameraData("published_geometry.json");
  const JsonValue& pointing = *data.Find("pointing");
  const CameraModel camera = FlightCamera(pointing.Find("model")->text());
  const auto ray = BackProject(camera, MiddleOf(camera.size));
  ASSERT_TRUE(ray);
  const auto expect_pointing = [&](const Vector3& d, const char* azimuth, const char* elevation) {
    const double tolerance_deg = pointing.Find("tolerance_deg")->number();
    const double found_deg = math::RadToDeg(std::atan2(d.y(), d.x()));
    EXPECT_NEAR(std::remainder(found_deg - pointing.Find(azimuth)->number(), 360.0), 0.0,
                tolerance_deg);
    // z points down.
    EXPECT_NEAR(-math::RadToDeg(std::asin(d.z())), pointing.Find(elevation)->number(),
                tolerance_deg);
  };
  expect_pointing(ray->direction, "rover_azimuth_deg", "rover_elevation_deg");
  const JsonValue::List& q = pointing.Find("q_site_rover_wxyz")->list();
  math::Transform X_SR = math::Transform::Identity();
  X_SR.linear() = Eigen::Quaterniond(q[0].number(), q[1].number(), q[2].number(), q[3].number())
                      .normalized()
                      .toRotationMatrix();
  const auto site_ray = BackProject(Moved(X_SR, camera), MiddleOf(camera.size));
  ASSERT_TRUE(site_ray);
  expect_pointing(site_ray->direction, "site_azimuth_deg", "site_elevation_deg");
}

// Derivatives against central differences.

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
      const Vector3 p_A = CentreOf(named.camera) + 1.5 * (ahead + aside * ahead.unitOrthogonal());
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

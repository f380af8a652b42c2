// Real flight cameras against the values that other implementations compute of them.
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

}  // namespace
}  // namespace rockyard::vision

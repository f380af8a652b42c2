// Rays and bodies against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rendering/cylinder/cylinder_scene.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

BodyCaster Body(BodyShape shape, const Vector3& half, double heading_rad = 0.0) {
  return BodyCaster({shape, {5.0, 0.0, 0.0}, half, heading_rad, {}});
}

TEST(ColouredBody, SphereIsMetAtItsNearSide) {
  const BodyCaster sphere = Body(BodyShape::kEllipsoid, {1.0, 1.0, 1.0});
  const auto hit = sphere.Cast({Vector3::Zero(), {2.0, 0.0, 0.0}});
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->along, 2.0, 1e-12);
  EXPECT_NEAR((hit->normal + Vector3::UnitX()).norm(), 0.0, 1e-12);
  EXPECT_FALSE(sphere.Cast({Vector3::Zero(), -Vector3::UnitX()}).has_value());
  EXPECT_FALSE(sphere.Cast({{0.0, 1.001, 0.0}, Vector3::UnitX()}).has_value());
  EXPECT_TRUE(sphere.Cast({{0.0, 0.999, 0.0}, Vector3::UnitX()}).has_value());
}

TEST(ColouredBody, EllipsoidTurnsWithItsHeading) {
  const BodyCaster body = Body(BodyShape::kEllipsoid, {2.0, 1.0, 0.5}, 0.5 * std::numbers::pi);
  EXPECT_NEAR(body.Cast({Vector3::Zero(), Vector3::UnitX()})->along, 4.0, 1e-9);
  EXPECT_NEAR(body.Cast({{5.0, 9.0, 0.0}, -Vector3::UnitY()})->along, 7.0, 1e-9);
}

TEST(ColouredBody, BoxShowsTheFaceThatTheRayEntersBy) {
  const BodyCaster box = Body(BodyShape::kBox, {1.0, 2.0, 0.5});
  const auto front = box.Cast({Vector3::Zero(), Vector3::UnitX()});
  ASSERT_TRUE(front.has_value());
  EXPECT_EQ(front->part, 0);
  EXPECT_NEAR(front->along, 4.0, 1e-12);
  EXPECT_NEAR((front->normal + Vector3::UnitX()).norm(), 0.0, 1e-12);
  const auto top = box.Cast({{5.0, 0.0, 3.0}, -Vector3::UnitZ()});
  ASSERT_TRUE(top.has_value());
  EXPECT_EQ(top->part, 5);
  EXPECT_NEAR(top->along, 2.5, 1e-12);
  EXPECT_FALSE(box.Cast({{0.0, 2.01, 0.0}, Vector3::UnitX()}).has_value());
  EXPECT_FALSE(box.Cast({Vector3::Zero(), {1.0, 1.0, 0.0}}).has_value());
}

TEST(ColouredBody, QuadrantsOfTheCylinderGoCounterClockwise) {
  const BodyCaster cylinder = Body(BodyShape::kCylinder, {0.5, 0.5, 1.0}, 0.3);
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    for (const double within_deg : {5.0, 45.0, 85.0}) {
      const double azimuth = 0.3 + math::DegToRad(90.0 * quadrant + within_deg);
      const Vector3 outward(std::cos(azimuth), std::sin(azimuth), 0.0);
      const auto hit = cylinder.Cast({Vector3(5.0, 0.0, 0.2) + 3.0 * outward, -outward});
      ASSERT_TRUE(hit.has_value());
      EXPECT_EQ(hit->part, quadrant);
      EXPECT_NEAR(hit->along, 2.5, 1e-9);
      EXPECT_NEAR((hit->normal - outward).norm(), 0.0, 1e-9);
    }
  }
}

TEST(ColouredBody, TopOfTheCylinderIsSeenFromAboveAlone) {
  const BodyCaster cylinder = Body(BodyShape::kCylinder, {0.5, 0.5, 1.0});
  const auto top = cylinder.Cast({{0.0, 0.0, 3.0}, {5.0, 0.0, -2.0}});
  ASSERT_TRUE(top.has_value());
  EXPECT_EQ(top->part, 4);
  EXPECT_NEAR(top->along, 1.0, 1e-12);
  EXPECT_FALSE(cylinder.Cast({{0.0, 0.0, -3.0}, {5.0, 0.0, 2.0}}).has_value());
  EXPECT_FALSE(cylinder.Cast({{0.0, 0.0, 1.01}, Vector3::UnitX()}).has_value());
  EXPECT_TRUE(cylinder.Cast({{0.0, 0.0, 0.99}, Vector3::UnitX()}).has_value());
}

}  // namespace
}  // namespace rockyard::rendering

// Every model against what can be worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

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

}  // namespace
}  // namespace rockyard::vision

// Where a camera sees nothing: no value, and never NaN.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/numbers.h"
#include "core/random.h"
#include "vision/cameras/radial_polynomial.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using core::kInfinity;
using core::kNaN;
using math::Vector3;

Cahv PlainLinear() { return {Vector3::Zero(), Vector3::UnitZ(), {200, 0, 100}, {0, 200, 80}}; }

TEST(CameraDomainTest, NothingIsSeenBehindTheCamera) {
  for (const NamedCamera& named : ModelCameras()) {
    const auto middle = BackProject(named.camera, MiddleOf(named.camera.size));
    ASSERT_TRUE(middle);
    const Vector3 behind = CentreOf(named.camera) - 2.0 * middle->direction;
    const auto pixel = Project(named.camera, behind);
    EXPECT_FALSE(pixel && IsInside(named.camera.size, *pixel)) << named.name;
    EXPECT_FALSE(Project(named.camera, CentreOf(named.camera))) << named.name;
  }
}

TEST(CameraDomainTest, ALinearCameraEndsAtItsPlane) {
  EXPECT_TRUE(Project(PlainLinear(), {1, 0, 1e-6}));
  EXPECT_FALSE(Project(PlainLinear(), {1, 0, 0}));
  EXPECT_FALSE(Project(PlainLinear(), {1, 0, -1e-6}));
}

TEST(CameraDomainTest, NumbersThatAreNotFiniteAreSeenNowhere) {
  for (const NamedCamera& named : ModelCameras()) {
    for (const double bad : {kNaN, kInfinity, -kInfinity}) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_FALSE(Project(named.camera, CentreOf(named.camera) + bad * Vector3::Unit(axis)))
            << named.name << bad;
        Vector3 p = CentreOf(named.camera) + TestPose().linear() * Vector3(0.1, 0.1, 2.0);
        p[axis] = bad;
        const auto pixel = Project(named.camera, p);
        EXPECT_TRUE(!pixel || pixel->allFinite()) << named.name << bad;
      }
      EXPECT_FALSE(BackProject(named.camera, {bad, 1.0})) << named.name << bad;
      EXPECT_FALSE(BackProject(named.camera, {1.0, bad})) << named.name << bad;
    }
    EXPECT_FALSE(ProjectDirection(named.camera, Vector3::Zero())) << named.name;
  }
}

// chi' = chi - chi^3 grows up to chi = 1 / sqrt(3), chi' = 2 / (3 sqrt(3)).
TEST(CameraDomainTest, ADistortionEndsWhereItFoldsBack) {
  const double end = 1.0 / std::sqrt(3.0);
  const double image = 2.0 / 3.0 * end;
  const Vector3 R(0, -1, 0);
  const CameraModel cameras[] = {
      {Cahvor{PlainLinear(), Vector3::UnitZ(), R}, {200, 160}},
      {Cahvore{PlainLinear(), Vector3::UnitZ(), R, Vector3::Zero(), CahvoreType::kPerspective},
       {200, 160}},
      {BrownPinhole{math::Transform::Identity(), 200, 200, 100, 80, -1.0}, {200, 160}}};
  for (const CameraModel& camera : cameras) {
    EXPECT_TRUE(Project(camera, {0.999 * end, 0, 1}));
    EXPECT_FALSE(Project(camera, {1.001 * end, 0, 1}));
    EXPECT_FALSE(Project(camera, {0, 5.0, 1}));
    const auto ray = BackProject(camera, {100 + 200 * 0.999 * image, 80});
    ASSERT_TRUE(ray);
    EXPECT_LT(ray->direction.x() / ray->direction.z(), end);
    EXPECT_FALSE(BackProject(camera, {100 + 200 * 1.001 * image, 80}));
    EXPECT_FALSE(BackProject(camera, {100, 80 - 200.0}));
  }
}

TEST(CameraDomainTest, APolynomialThatGrowsAgainFarOutIsStillFolded) {
  // dr'/dr = (1 - t)^2 (1 + ...) touches zero; a little lower it crosses twice.
  const RadialPolynomial folded{{1.0, -2.1 / 3.0, 1.0 / 5.0, 0.0}};
  EXPECT_TRUE(GrowsUpTo(folded, 0.8));
  EXPECT_FALSE(GrowsUpTo(folded, 1.0));
  EXPECT_FALSE(GrowsUpTo(folded, 2.0));  // it grows there, but not on the way
  const RadialPolynomial growing{{1.0, -1.9 / 3.0, 1.0 / 5.0, 0.0}};
  EXPECT_TRUE(GrowsUpTo(growing, 1.0));
  EXPECT_TRUE(GrowsUpTo(growing, 2.0));
  // The cubic's hollow: 1 - 3 t^2 + 1.9 t^3 is above zero at t = 1.6, below at t = 1.
  const RadialPolynomial hollow{{1.0, 0.0, -3.0 / 5.0, 1.9 / 7.0}};
  EXPECT_TRUE(Growth(hollow, std::sqrt(1.6)) > 0.0);
  EXPECT_FALSE(GrowsUpTo(hollow, std::sqrt(1.6)));
}

TEST(CameraDomainTest, UndistortFindsTheRootOfTheGrowingPart) {
  const RadialPolynomial polynomials[] = {{{1.0, 0.0, 0.0, 0.0}},   {{0.363, -0.002, 0.016, 0.0}},
                                          {{1.0, -0.3, 0.0, 0.0}},  {{1.2, 3.0, 0.0, 0.0}},
                                          {{1.0, -0.4, 0.3, -0.1}}, {{0.01, 50.0, -2.0, 0.0}}};
  for (const RadialPolynomial& polynomial : polynomials) {
    for (double r = 0.0; r < 3.0; r += 0.01) {
      if (!GrowsUpTo(polynomial, r)) break;
      const auto found = Undistort(polynomial, r * Share(polynomial, r * r));
      ASSERT_TRUE(found) << r;
      // Near the end of the growing part the root is as good as its square is.
      EXPECT_NEAR(*found, r, 1e-13 + 1e-14 / Growth(polynomial, r)) << r;
    }
    EXPECT_FALSE(Undistort(polynomial, -0.1));
    EXPECT_FALSE(Undistort(polynomial, kNaN));
    EXPECT_FALSE(Undistort(polynomial, kInfinity));
  }
  EXPECT_FALSE(Undistort({{0.0, 1.0, 0.0, 0.0}}, 0.5));
  EXPECT_FALSE(Undistort({{-1.0, 1.0, 0.0, 0.0}}, 0.5));
}

TEST(CameraDomainTest, AFisheyeEndsAtTheLargestAngleOfItsLinearity) {
  for (const double linearity : {-0.8, -0.2, 0.0, 0.37, 0.8, 1.0}) {
    const Cahvore camera{PlainLinear(),   Vector3::UnitZ(),      Vector3::Zero(),
                         Vector3::Zero(), CahvoreType::kGeneral, linearity};
    const double end = LargestAngle(linearity);
    const auto at = [&](double theta) {
      return Project(camera, Vector3(std::sin(theta), 0.0, std::cos(theta)));
    };
    EXPECT_TRUE(at(end - 1e-6)) << linearity;
    EXPECT_TRUE(end == std::numbers::pi || !at(end + 1e-6)) << linearity;
    if (linearity < -0.5) {
      EXPECT_TRUE(BackProject(camera, {100.0 - 200.0 / linearity * 0.9999, 80})) << linearity;
      EXPECT_FALSE(BackProject(camera, {100.0 - 200.0 / linearity * 1.0001, 80})) << linearity;
    }
  }
  const Cahvore equidistant{PlainLinear(),   Vector3::UnitZ(),      Vector3::Zero(),
                            Vector3::Zero(), CahvoreType::kFisheye, 1.0};
  EXPECT_TRUE(BackProject(equidistant, {100 + 200 * 3.14, 80}));
  EXPECT_FALSE(BackProject(equidistant, {100 + 200 * 3.15, 80}));
}

TEST(CameraDomainTest, AFisheyeSeesNothingStraightBehind) {
  const Cahvore camera{PlainLinear(),   Vector3::UnitZ(),      Vector3::Zero(),
                       Vector3::Zero(), CahvoreType::kFisheye, 1.0};
  EXPECT_FALSE(Project(camera, {0, 0, -1}));
}

TEST(CameraDomainTest, APointInsideOfTheMovingPupilsCausticIsNotSeen) {
  // The lines of sight of 1 rad and of angles around it cross near the axis.
  const Cahvore camera{PlainLinear(),    Vector3::UnitZ(),      Vector3::Zero(),
                       {0.05, 0.1, 0.0}, CahvoreType::kFisheye, 1.0};
  EXPECT_TRUE(Project(camera, Vector3(0.5, 0, 0.3)));
  EXPECT_FALSE(Project(camera, Vector3(1e-4, 0, -0.02)));
}

TEST(CameraDomainTest, ATangentialFoldIsNotImaged) {
  BrownPinhole camera{math::Transform::Identity(), 200, 200, 100, 80};
  camera.p2 = -0.2;
  // dx'/dx = 1 + 6 p2 x along the row: zero at x = 1 / 1.2.
  EXPECT_TRUE(Project(camera, {0.82, 0, 1}));
  EXPECT_FALSE(Project(camera, {0.85, 0, 1}));
  EXPECT_FALSE(BackProject(camera, {100 + 200 * 0.5, 80}));  // x' has its maximum at 0.41667
}

// Models of wild numbers and wild points: what comes back is finite.
TEST(CameraDomainTest, NothingWildGivesNaN) {
  core::RandomStream random({23, 0}, core::Purpose::kTest);
  const auto wild = [&](double largest) {
    const double scale = std::pow(10.0, 12.0 * random.Uniform() - 10.0);
    return largest * scale * (2.0 * random.Uniform() - 1.0);
  };
  const auto vector = [&](double largest) {
    return Vector3(wild(largest), wild(largest), wild(largest));
  };
  int seen = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Cahv linear{vector(1.0), vector(1.0), vector(500.0), vector(500.0)};
    const Vector3 O = vector(1.0).normalized();
    const Vector3 R = vector(0.5);
    const Vector3 E = vector(0.1);
    const double linearity = 2.0 * random.Uniform() - 1.0;
    BrownPinhole brown{TestPose(), 300, 300, 100, 100};
    brown.k1 = wild(1.0);
    brown.k2 = wild(1.0);
    brown.k3 = wild(1.0);
    brown.p1 = wild(0.1);
    brown.p2 = wild(0.1);
    const AnyLens lenses[] = {linear, Cahvor{linear, O, R},
                              Cahvore{linear, O, R, E, CahvoreType::kGeneral, linearity}, brown};
    for (const AnyLens& lens : lenses) {
      const CameraModel camera{lens, {200, 200}};
      PixelJacobian by_point;
      if (const auto pixel = Project(camera, vector(1.0), &by_point)) {
        ASSERT_TRUE(pixel->allFinite() && !by_point.hasNaN());
        ++seen;
      }
      RayJacobian by_pixel;
      if (const auto ray = BackProject(camera, {wild(100.0), wild(100.0)}, &by_pixel)) {
        ASSERT_TRUE(ray->direction.allFinite() && ray->origin.allFinite());
        ASSERT_NEAR(ray->direction.norm(), 1.0, 1e-9);
      }
    }
  }
  EXPECT_GT(seen, 1000);
}

}  // namespace
}  // namespace rockyard::vision

// Views of a plane after a motion, beside rays that meet it.
#include "vision/odometry/plane_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vision/cameras/rectification.h"
#include "vision/odometry/stereo_measurement.h"
#include "vision/odometry/synthetic_sequence.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;

const RectifiedPair& Cameras() {
  static const RectifiedPair cameras = PlanePair({256, 192});
  return cameras;
}

// What the pair measures where the left eye's ray meets the plane normal . p = height.
StereoMeasurement SeeAt(const Pixel& pixel, const Vector3& normal, double height) {
  const Vector3 C = Cameras().left.C;
  const Vector3 ray = Triangulate(Cameras().left, Cameras().right, pixel, 1.0)->p_A - C;
  StereoMeasurement seen{.left = pixel,
                         .p_A = C + (height - normal.dot(C)) / normal.dot(ray) * ray};
  seen.disparity_px = PairProjection(Cameras())(seen.p_A)->z();
  return seen;
}

// With the slope of the disparities of neighbours: they are linear, so that any neighbour will do.
StereoMeasurement SeeSurface(const Pixel& pixel, const Vector3& normal, double height) {
  StereoMeasurement seen = SeeAt(pixel, normal, height);
  seen.slope << SeeAt(pixel + Pixel(9.0, 0.0), normal, height).disparity_px - seen.disparity_px,
      SeeAt(pixel + Pixel(0.0, 9.0), normal, height).disparity_px - seen.disparity_px;
  seen.slope /= 9.0;
  return seen;
}

void ExpectSeenAsRaysHaveIt(const Transform& X_FS, const Vector3& normal, double height) {
  const PlaneView see_again(Cameras(), X_FS.inverse());
  const PairProjection project(Cameras());
  for (const Pixel& pixel : {Pixel(128.0, 100.0), Pixel(60.5, 150.2), Pixel(200.0, 80.0)}) {
    const auto seen = see_again(SeeSurface(pixel, normal, height));
    ASSERT_TRUE(seen);
    for (const Pixel& by : {Pixel(0.0, 0.0), Pixel(-7.0, 5.0), Pixel(8.0, 8.0)}) {
      const StereoMeasurement first = SeeAt(pixel + by, normal, height);
      const auto second = project(X_FS.inverse() * first.p_A);
      ASSERT_TRUE(second);
      const Pixel offset = second->head<2>() - seen->pixel;
      const Pixel back = seen->view.by_offset * offset / (1.0 + seen->view.by_distance.dot(offset));
      EXPECT_LT((back - by).norm(), 1e-9);
      const auto middle = project(X_FS.inverse() * SeeAt(pixel, normal, height).p_A);
      EXPECT_NEAR(second->z(), middle->z() + seen->slope.dot(offset), 1e-9);
    }
  }
}

TEST(PlaneViewTest, GroundAndWallsAreSeenAsRaysHaveThem) {
  const Transform X_FS = math::MakePose({0.6, -0.1, 0.04}, 0.08, -0.03, 0.05);
  ExpectSeenAsRaysHaveIt(X_FS, Vector3(0.0, 0.0, 1.0), 0.0);
  ExpectSeenAsRaysHaveIt(X_FS, Vector3(-1.0, 0.2, 0.1), -2.5);
  // One that faces the cameras has no slope.
  const Vector3 ahead = Cameras().left.A;
  EXPECT_LT(SeeSurface({100.0, 90.0}, ahead, ahead.dot(Cameras().left.C) + 2.0).slope.norm(), 1e-9);
  ExpectSeenAsRaysHaveIt(X_FS, ahead, ahead.dot(Cameras().left.C) + 2.0);
}

TEST(PlaneViewTest, SeesNothingBehindOrFromTheEdge) {
  const StereoMeasurement ground = SeeSurface({128.0, 150.0}, Vector3(0.0, 0.0, 1.0), 0.0);
  const auto seen = [&](const Transform& X_FS) {
    return PlaneView(Cameras(), X_FS.inverse())(ground).has_value();
  };
  EXPECT_TRUE(seen(Transform::Identity()));
  // Driven past it.
  EXPECT_FALSE(seen(math::MakePose({6.0, 0.0, 0.0}, 0.0, 0.0, 0.0)));
  // Down on the ground, where a row has more disparity than the one above by over 0.75 px.
  EXPECT_FALSE(seen(math::MakePose({0.0, 0.0, -1.1}, 0.0, 0.0, 0.0)));
  // From so far that it is ten times smaller.
  EXPECT_FALSE(seen(math::MakePose({-30.0, 0.0, 0.0}, 0.0, math::DegToRad(-20.0), 0.0)));
}

}  // namespace
}  // namespace rockyard::vision

// Nearest points of ellipsoids against optimality conditions and a search.
#include "rover/ellipsoid.h"

#include <gtest/gtest.h>

#include <numbers>

#include "rover_drive.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

terrain::Rock Turned() {
  terrain::Rock rock = MakeRock(1.0, 2.0, 0.1, 0.3, 0.2, 0.12);
  rock.yaw_rad = 0.7;
  return rock;
}

TEST(Ellipsoid, NearestPointIsOnTheSurfaceBelowItsNormal) {
  const terrain::Rock rock = Turned();
  const Ellipsoid ellipsoid(rock);
  const terrain::RockShape shape(rock);
  for (int i = 0; i < 500; ++i) {
    const double a = 0.37 * i;
    const double b = 0.11 * i;
    const double r = 0.35 + 0.002 * i;
    const Vector3 p = rock.center_W + r * Vector3(std::cos(a) * std::cos(b),
                                                  std::sin(a) * std::cos(b), std::sin(b));
    const SurfacePoint nearest = ellipsoid.Nearest(p);
    EXPECT_NEAR((p - nearest.point_W - nearest.distance_m * nearest.normal_W).norm(), 0.0, 1e-9);
    EXPECT_NEAR((shape.Normal(nearest.point_W) - nearest.normal_W).norm(), 0.0, 1e-9);
    EXPECT_LE(ellipsoid.DistanceBound(p), nearest.distance_m + 1e-12);
    // The point is on the surface: a ray from outside meets it there.
    const auto met = shape.Distance(nearest.point_W + nearest.normal_W, -nearest.normal_W);
    EXPECT_NEAR(met, 1.0, 1e-9);
  }
}

TEST(Ellipsoid, SphereInClosedForm) {
  const Ellipsoid sphere(MakeRock(0.0, 0.0, 0.0, 0.2, 0.2, 0.2));
  const SurfacePoint nearest = sphere.Nearest(Vector3(0.3, 0.4, 0.0));
  EXPECT_NEAR(nearest.distance_m, 0.3, 1e-12);
  EXPECT_NEAR((nearest.normal_W - Vector3(0.6, 0.8, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_LT(sphere.Nearest(Vector3(0.05, 0.0, 0.0)).distance_m, 0.0);
}

}  // namespace
}  // namespace rockyard::rover

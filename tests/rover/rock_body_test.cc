// Nearest points of rocks against optimality conditions and a search.

#include "rover/rock_body.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/random.h"
#include "rover_drive.h"
#include "terrain/rock.h"

namespace rockyard::rover {
namespace {

using core::SampleUniform;
using math::Vector3;

terrain::Rock Turned() {
  terrain::Rock rock = MakeRock(1.0, 2.0, 0.1, 0.3, 0.2, 0.12);
  rock.yaw_rad = 0.7;
  return rock;
}

TEST(RockBody, NearestPointIsOnTheSurfaceBelowItsNormal) {
  const terrain::Rock rock = Turned();
  const RockBody ellipsoid(rock);
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

TEST(RockBody, SphereInClosedForm) {
  const RockBody sphere(MakeRock(0.0, 0.0, 0.0, 0.2, 0.2, 0.2));
  const SurfacePoint nearest = sphere.Nearest(Vector3(0.3, 0.4, 0.0));
  EXPECT_NEAR(nearest.distance_m, 0.3, 1e-12);
  EXPECT_NEAR((nearest.normal_W - Vector3(0.6, 0.8, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_LT(sphere.Nearest(Vector3(0.05, 0.0, 0.0)).distance_m, 0.0);
}

// Caps of ellipsoids, about paraboloids (A = 1 on both sides) and hyperboloids.
class CapTest : public testing::TestWithParam<double> {
 protected:
  terrain::Rock DrawCap() {
    const double diameter_m = SampleUniform(stream_, 0.1, 0.6);
    const double half_height_m = 0.5 * diameter_m * SampleUniform(stream_, 0.4, 1.2);
    terrain::Rock rock = terrain::ShapeRock(
        {.diameter_m = diameter_m,
         .width_ratio = SampleUniform(stream_, 0.7, 1.0),
         .half_height_m = half_height_m,
         .height_m = 2.0 * half_height_m * (1.0 - SampleUniform(stream_, 0.2, 0.45))},
        GetParam());
    rock.yaw_rad = SampleUniform(stream_, -1.5, 1.5);
    rock.center_W.head<2>() << SampleUniform(stream_, -1.0, 1.0), SampleUniform(stream_, -1.0, 1.0);
    return rock;
  }
  // Around the rock and above the ground, beside it and right over its top.
  Vector3 DrawPoint(const terrain::Rock& rock) {
    const double reach_m = (stream_.Uniform() < 0.2 ? 0.1 : 1.0) * rock.diameter_m;
    return {rock.center_W.x() + SampleUniform(stream_, -reach_m, reach_m),
            rock.center_W.y() + SampleUniform(stream_, -reach_m, reach_m),
            SampleUniform(stream_, 0.0, rock.height_m + 0.3)};
  }
  core::RandomStream& stream() { return stream_; }

 private:
  core::RandomStream stream_{{61, 0}, core::Purpose::kTest};
};

INSTANTIATE_TEST_SUITE_P(Pointedness, CapTest,
                         testing::Values(0.4, 0.5, 0.62, 0.63, 0.75, 0.87, 0.95, 0.99));

TEST_P(CapTest, NearestPointIsOnTheSurfaceBelowItsNormal) {
  int above_ground = 0;
  for (int i = 0; i < 2000; ++i) {
    const terrain::Rock rock = DrawCap();
    ASSERT_GT(rock.cap_growth, 0.0);
    const RockBody body(rock);
    const terrain::RockShape shape(rock);
    const Vector3 p = DrawPoint(rock);
    const SurfacePoint nearest = body.Nearest(p);
    // From wherever the search starts.
    for (const Vector3& start : {nearest.point_W, Vector3(rock.center_W), p}) {
      EXPECT_LT((body.Nearest(p, &start).point_W - nearest.point_W).norm(), 1e-8);
    }
    EXPECT_NEAR(nearest.normal_W.norm(), 1.0, 1e-12);
    if (nearest.distance_m <= 0.0) {
      EXPECT_LE(p.z(), shape.Top(p.x(), p.y()) + 1e-12);
      continue;
    }
    EXPECT_NEAR((p - nearest.point_W - nearest.distance_m * nearest.normal_W).norm(), 0.0, 1e-9);
    if (nearest.point_W.z() < 0.0) continue;  // where the ground is
    ++above_ground;
    EXPECT_NEAR((shape.Normal(nearest.point_W) - nearest.normal_W).norm(), 0.0, 1e-9);
    EXPECT_NEAR(shape.Top(nearest.point_W.x(), nearest.point_W.y()), nearest.point_W.z(), 1e-9);
    EXPECT_LE(body.DistanceBound(p), nearest.distance_m + 1e-12);
  }
  EXPECT_GT(above_ground, 800);
}

TEST_P(CapTest, NoPointOfTheSurfaceIsNearer) {
  for (int i = 0; i < 20; ++i) {
    const terrain::Rock rock = DrawCap();
    const terrain::RockShape shape(rock);
    const Vector3 p = DrawPoint(rock);
    const double distance_m = RockBody(rock).Nearest(p).distance_m;
    double least_m = std::numeric_limits<double>::infinity();
    for (int j = 0; j < 5000; ++j) {
      const double reach_m = 0.5 * rock.diameter_m;
      const double x = rock.center_W.x() + SampleUniform(stream(), -reach_m, reach_m);
      const double y = rock.center_W.y() + SampleUniform(stream(), -reach_m, reach_m);
      const double top_m = shape.Top(x, y);
      if (top_m > 0.0) least_m = std::min(least_m, (p - Vector3(x, y, top_m)).norm());
    }
    EXPECT_LE(distance_m, least_m + 1e-12);
  }
}

// Light and wheels meet one surface, from both sides.
TEST_P(CapTest, RaysEndWhereTheDistanceIsZero) {
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const terrain::Rock rock = DrawCap();
    const RockBody body(rock);
    const Vector3 p = DrawPoint(rock);
    const Vector3 aim(rock.center_W.x(), rock.center_W.y(), 0.3 * rock.height_m);
    const Vector3 direction = (aim - p).normalized();
    const double t = terrain::RockShape(rock).Distance(p, direction);
    if (t == 0.0 || t == terrain::RockShape::kNoHit) continue;
    ++hits;
    const Vector3 met = p + t * direction;
    EXPECT_NEAR(body.Nearest(met).distance_m, 0.0, 1e-9);
    EXPECT_LT(body.Nearest(met + 1e-4 * direction).distance_m, 0.0);
    EXPECT_GT(body.Nearest(met - 1e-4 * direction).distance_m, 0.0);
    EXPECT_NEAR((body.Nearest(met + 1e-7 * direction).normal_W -
                 body.Nearest(met - 1e-7 * direction).normal_W)
                    .norm(),
                0.0, 1e-3);
  }
  EXPECT_GT(hits, 200);
}

// Within the rock, on its axis and below its base: some point of the surface, straight ahead.
TEST_P(CapTest, FromInsideThereIsAPoint) {
  const terrain::Rock rock = DrawCap();
  const RockBody body(rock);
  const terrain::RockShape shape(rock);
  for (const Vector3& p : {Vector3(0.0, 0.0, 0.0), Vector3(0.0, 0.0, 0.5 * rock.height_m),
                           Vector3(0.02, 0.01, 0.0), Vector3(0.01, 0.01, -0.02)}) {
    const SurfacePoint nearest = body.Nearest(rock.center_W + p);
    EXPECT_LT(nearest.distance_m, 0.0);
    EXPECT_NEAR(std::max(0.0, shape.Top(nearest.point_W.x(), nearest.point_W.y())),
                nearest.point_W.z(), 1e-6);
  }
}

}  // namespace
}  // namespace rockyard::rover

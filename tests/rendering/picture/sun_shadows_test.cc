// Shadows against closed forms and against rays over the sun's disc.
#include "rendering/picture/sun_shadows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"
#include "rendering/image_scene.h"
#include "rendering/line_kit.h"
#include "terrain/placed_rocks.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;
using terrain::EllipsoidRock;
using terrain::FlatWith;

constexpr int kGround = SurfacePoint::kGround;

Vector3 Toward(double elevation_deg, double azimuth_deg) {
  const double h = math::DegToRad(elevation_deg);
  const double a = math::DegToRad(azimuth_deg);
  return {std::cos(h) * std::cos(a), std::cos(h) * std::sin(a), std::sin(h)};
}

// The shadow of a ball on level ground is an ellipse of semi-axes r and r / sin h around the point
// z / tan h behind it. Under a disc the edge is half lit, and the penumbra as wide as the disc.
TEST(SunShadows, BallCastsAnEllipseWithAPenumbra) {
  const Vector3 sun = Toward(35.0, 120.0);
  const double sine = sun.z();
  constexpr double kRadius = 0.1;
  const Vector3 ball(1.5, 0.2, 0.25);
  const terrain::Terrain terrain =
      FlatWith({EllipsoidRock(ball.x(), ball.y(), ball.z(), kRadius, kRadius, kRadius)});
  const double diameter = math::DegToRad(0.35);
  const SunShadows disc(terrain, sun, diameter, {});
  const SunShadows point(terrain, sun, 0.0, {});
  const Vector3 away = Vector3(-sun.x(), -sun.y(), 0.0).normalized();
  const Vector3 across(-away.y(), away.x(), 0.0);
  const Vector3 middle =
      Vector3(ball.x(), ball.y(), 0.0) + ball.z() * std::sqrt(1.0 - sine * sine) / sine * away;
  for (int i = 0; i < 24; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / 24;
    const auto at = [&](double radius_m) {
      return Vector3(middle + radius_m * (std::cos(turn) * across + std::sin(turn) / sine * away));
    };
    const auto lit = [&](const SunShadows& shadows, double radius_m) {
      return shadows.Visible(at(radius_m), Vector3::UnitZ(), kGround);
    };
    EXPECT_EQ(lit(point, 0.999 * kRadius), 0.0);
    EXPECT_EQ(lit(point, 1.001 * kRadius), 1.0);
    EXPECT_NEAR(lit(disc, kRadius), 0.5, 1e-9);
    // Half of the disc from the edge, seen from where the ray is nearest to the ball.
    const double half_m = 0.5 * diameter * (ball - at(kRadius)).dot(sun);
    EXPECT_EQ(lit(disc, kRadius - 1.01 * half_m), 0.0);
    EXPECT_EQ(lit(disc, kRadius + 1.01 * half_m), 1.0);
    // At a quarter of the diameter: 1/2 + (sqrt(3)/4 + pi/6) / pi.
    EXPECT_NEAR(lit(disc, kRadius + 0.5 * half_m), 0.804499, 0.004);
    EXPECT_NEAR(lit(disc, kRadius - 0.5 * half_m), 0.195501, 0.004);
  }
}

// Rays spread evenly over the disc, by Vogel's spiral.
double ShareOfRays(const terrain::Rock& rock, const Vector3& p, const Vector3& sun,
                   double diameter_rad) {
  const terrain::RockShape shape(rock);
  const Vector3 x = sun.unitOrthogonal();
  const Vector3 y = sun.cross(x);
  constexpr int kRays = 1500;
  int seen = 0;
  for (int i = 0; i < kRays; ++i) {
    const double r = 0.5 * diameter_rad * std::sqrt((i + 0.5) / kRays);
    const double turn = 2.399963229728653 * i;
    const Vector3 ray = (sun + r * (std::cos(turn) * x + std::sin(turn) * y)).normalized();
    if (shape.Distance(p, ray) == terrain::RockShape::kNoHit) ++seen;
  }
  return static_cast<double>(seen) / kRays;
}

TEST(SunShadows, EllipsoidsAndCapsAgreeWithRaysOverTheDisc) {
  core::RandomStream stream({5, 0}, core::Purpose::kTest, 0);
  const double diameter = math::DegToRad(1.0);
  int partly = 0;
  for (int i = 0; i < 2000; ++i) {
    terrain::Rock rock =
        EllipsoidRock(0.0, 0.0, 0.03, 0.15, 0.11, 0.09, core::SampleUniform(stream, 0.0, 3.0));
    const bool is_cap = i % 4 == 0;
    if (is_cap) {
      rock.cap_growth = 0.7;
      rock.center_W.z() = 0.0;
    }
    const Vector3 sun =
        Toward(core::SampleUniform(stream, 10.0, 80.0), core::SampleUniform(stream, 0.0, 360.0));
    const terrain::Terrain terrain = FlatWith({rock});
    const SunShadows shadows(terrain, sun, diameter, {});
    // Points near the edge of the shadow of the rock's upper part.
    const double down = core::SampleUniform(stream, 0.3, 0.9) * 0.1 / sun.z();
    const Vector3 p(-down * sun.x() + core::SampleUniform(stream, -0.18, 0.18),
                    -down * sun.y() + core::SampleUniform(stream, -0.18, 0.18), 0.0);
    if (terrain::RockShape(rock).Distance(p, Vector3::UnitZ()) == 0.0) continue;
    const double expected = ShareOfRays(rock, p, sun, diameter);
    const double share = shadows.Visible(p, Vector3::UnitZ(), kGround);
    if (expected > 0.0 && expected < 1.0) ++partly;
    // A straight edge for a curved one; a cap's eight rays are worth 1/8 each.
    EXPECT_NEAR(share, expected, is_cap ? 0.3 : 0.04) << i;
  }
  EXPECT_GT(partly, 15);
}

TEST(SunShadows, NeitherItselfNorWhatLiesBehindShades) {
  const terrain::Terrain terrain = FlatWith(
      {EllipsoidRock(0.0, 0.0, 0.0, 0.1, 0.1, 0.1), EllipsoidRock(-0.35, 0.0, 0.0, 0.2, 0.2, 0.2)});
  const Vector3 sun = Toward(20.0, 0.0);
  const SunShadows shadows(terrain, sun, 0.006, {});
  const Vector3 facing = Vector3(1.0, 0.0, 0.2).normalized();
  EXPECT_EQ(shadows.Visible(0.1 * facing, facing, 0), 1.0);
  const Vector3 averted(-1.0, 0.0, 0.0);
  EXPECT_EQ(shadows.Visible(0.1 * averted, averted, 0), 0.0);
  // Between the two, in the shadow of the first only; sunward of both.
  EXPECT_EQ(shadows.Visible({-0.12, 0.0, 0.0}, Vector3::UnitZ(), kGround), 0.0);
  EXPECT_EQ(shadows.Visible({0.2, 0.0, 0.0}, Vector3::UnitZ(), kGround), 1.0);
  // The second rock, in the first one's shadow.
  const Vector3 low(0.9, 0.0, 0.1);
  EXPECT_EQ(shadows.Visible(Vector3(-0.35, 0.0, 0.0) + 0.2 * low.normalized(), low.normalized(), 1),
            0.0);
}

// A box throws the shadow of its upper edge to z / tan h behind that.
TEST(SunShadows, RoverCastsTheShadowOfABox) {
  const RoverBody body = SmallBody();  // a box over |x| <= 0.1, z from 0.1 to 0.2
  const terrain::Terrain terrain = FlatWith({});
  const math::Transform X_WR = math::MakePose({2.0, 1.0, 0.0}, 0.0, 0.0, 0.0);
  const Vector3 sun = Toward(45.0, 0.0);
  const SunShadows shadows(terrain, sun, 0.006, {&body, X_WR});
  const auto lit = [&](double x) {
    return shadows.Visible({2.0 + x, 1.0, 0.0}, Vector3::UnitZ(), kGround);
  };
  EXPECT_EQ(lit(-0.1 - 0.2 + 0.001), 0.0);
  EXPECT_EQ(lit(-0.1 - 0.2 - 0.001), 1.0);
  EXPECT_EQ(lit(0.1 - 0.1 - 0.001), 0.0);
  EXPECT_EQ(lit(0.1 - 0.1 + 0.001), 1.0);
}

TEST(SunShadows, GroundShadesItself) {
  terrain::GroundParams ground;
  ground.pits = {{0.0}, {0.0}, {0.6}, {0.2}, {0.05}};
  const terrain::Terrain terrain(terrain::Ground(ground, {1, 0}), {}, {});
  const SunShadows shadows(terrain, Toward(20.0, 0.0), 0.006, {});
  const auto lit = [&](double x) {
    return shadows.Visible({x, 0.0, terrain.ground().Height(x, 0.0)}, Vector3::UnitZ(), kGround);
  };
  EXPECT_EQ(lit(0.2), 0.0);  // at the sunward wall of the pit
  EXPECT_EQ(lit(0.5), 1.0);  // beside it
}

}  // namespace
}  // namespace rockyard::rendering

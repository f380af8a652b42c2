// The family of rocks from dome to cone: against its definition, written down a second time here.

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "core/random.h"
#include "terrain/arena.h"
#include "terrain/rock.h"
#include "terrain/terrain.h"

namespace rockyard::terrain {
namespace {

using core::SampleUniform;
using math::Vector3;

// Every member of the family: dome, cap of an ellipsoid, about a paraboloid, hyperboloids.
constexpr std::array kPointedness = {0.05, 0.2, 0.3, 0.5, 0.62, 0.63, 0.75, 0.87, 0.95, 0.99};

constexpr RockOutline kOutline{
    .diameter_m = 0.3, .width_ratio = 0.8, .half_height_m = 0.15, .height_m = 0.2};

struct Sample {
  RockOutline outline;
  double growth = 0.0;  // A of the definition
  Rock rock;
};

Sample DrawSample(core::RandomStream& stream, double pointedness) {
  Sample sample;
  sample.outline.diameter_m = SampleUniform(stream, 0.1, 0.6);
  sample.outline.width_ratio = SampleUniform(stream, 0.7, 1.0);
  sample.outline.half_height_m = 0.5 * sample.outline.diameter_m * SampleUniform(stream, 0.4, 1.2);
  const double buried = SampleUniform(stream, 0.2, 0.45);
  sample.outline.height_m = 2.0 * sample.outline.half_height_m * (1.0 - buried);
  sample.growth = (1.0 - pointedness) * 4.0 * (1.0 - buried);
  sample.rock = ShapeRock(sample.outline, pointedness);
  sample.rock.yaw_rad = SampleUniform(stream, -1.5, 1.5);
  sample.rock.center_W.head<2>() << SampleUniform(stream, -1.0, 1.0),
      SampleUniform(stream, -1.0, 1.0);
  return sample;
}

// rho^2 - A s - B s^2 of the definition: negative inside. Nothing above the top is inside.
double InsideOut(const Sample& sample, const Vector3& p_W) {
  const Eigen::AngleAxisd turn(-sample.rock.yaw_rad, Vector3::UnitZ());
  const Vector3 aside =
      turn * Vector3(p_W.x() - sample.rock.center_W.x(), p_W.y() - sample.rock.center_W.y(), 0.0);
  const double a = 0.5 * sample.outline.diameter_m;
  const double rho2 =
      std::pow(aside.x() / a, 2) + std::pow(aside.y() / (a * sample.outline.width_ratio), 2);
  const double s = (sample.outline.height_m - p_W.z()) / sample.outline.height_m;
  const double A = sample.growth;
  const double B = A < 2.0 ? 1.0 - A : -0.25 * A * A;
  return s < 0.0 ? rho2 - s : rho2 - A * s - B * s * s;
}

Vector3 RandomDirection(core::RandomStream& stream) {
  const double z = SampleUniform(stream, -1.0, 1.0);
  const double azimuth = SampleUniform(stream, 0.0, 2.0 * std::numbers::pi);
  const double level = std::sqrt(1.0 - z * z);
  return {level * std::cos(azimuth), level * std::sin(azimuth), z};
}

// A point above the ground, often right over the top, and a direction that often points at the
// rock.
struct Ray {
  Vector3 origin_W;
  Vector3 direction_W;
};

Ray RandomRay(core::RandomStream& stream, const Sample& sample) {
  const double reach_m = 0.5 * sample.outline.diameter_m;
  const double aside_m = stream.Uniform() < 0.3 ? 0.02 : 2.5;
  Ray ray;
  ray.origin_W = sample.rock.center_W + reach_m * aside_m * RandomDirection(stream);
  ray.origin_W.z() = SampleUniform(stream, 0.001, 3.0 * sample.outline.height_m);
  Vector3 aim_W = sample.rock.center_W + 1.2 * reach_m * RandomDirection(stream);
  aim_W.z() = SampleUniform(stream, 0.0, 1.2 * sample.outline.height_m);
  ray.direction_W = (aim_W - ray.origin_W).normalized();
  return ray;
}

// First distance in steps at which a ray is inside the rock and above the ground.
std::optional<double> March(const Sample& sample, const Ray& ray, double step_m) {
  for (double t = 0.0; t < 3.0; t += step_m) {
    const Vector3 p_W = ray.origin_W + t * ray.direction_W;
    if (p_W.z() < 0.0) return std::nullopt;
    if (InsideOut(sample, p_W) <= 0.0) return t;
  }
  return std::nullopt;
}

// Distance to the part of the rock above the ground.
std::optional<double> Cast(const Sample& sample, const Ray& ray) {
  const double t = RockShape(sample.rock).Distance(ray.origin_W, ray.direction_W);
  if (t == RockShape::kNoHit || ray.origin_W.z() + t * ray.direction_W.z() < 0.0) {
    return std::nullopt;
  }
  return t;
}

TEST(RockProfileTest, PointednessZeroIsTheEllipsoid) {
  const Rock rock = ShapeRock(
      {.diameter_m = 0.4, .width_ratio = 0.8, .half_height_m = 0.18, .height_m = 0.24}, 0.0);
  EXPECT_EQ(rock.semi_axes_m, Vector3(0.2, 0.2 * 0.8, 0.18));
  EXPECT_EQ(rock.center_W, Vector3(0.0, 0.0, 0.24 - 0.18));
  EXPECT_EQ(rock.cap_growth, 0.0);
  EXPECT_EQ(rock.diameter_m, 0.4);
  EXPECT_EQ(rock.height_m, 0.24);
}

TEST(RockProfileTest, RaysMeetTheDefinedSurface) {
  constexpr double kStep_m = 5e-4;
  core::RandomStream stream({51, 0}, core::Purpose::kTest);
  for (const double pointedness : kPointedness) {
    int hits = 0;
    int grazed = 0;
    for (int i = 0; i < 1500; ++i) {
      const Sample sample = DrawSample(stream, pointedness);
      const Ray ray = RandomRay(stream, sample);
      const auto t = Cast(sample, ray);
      const auto marched = March(sample, ray, kStep_m);
      if (!t) {
        EXPECT_FALSE(marched) << pointedness << " " << i;
        continue;
      }
      ++hits;
      if (*t > 0.0) {
        EXPECT_NEAR(InsideOut(sample, ray.origin_W + *t * ray.direction_W), 0.0, 1e-9);
      } else {
        EXPECT_LE(InsideOut(sample, ray.origin_W), 0.0);
      }
      // The march may step over a chord shorter than its step, and never stops early.
      if (marched) {
        EXPECT_GE(*marched, *t - 1e-9);
      }
      grazed += !marched || *marched > *t + kStep_m + 1e-9;
    }
    EXPECT_GT(hits, 500) << pointedness;
    EXPECT_LE(grazed, 12) << pointedness;
  }
}

// A second sheet of a hyperboloid hangs over the top, and rays begin in it: the camera of a rover.
TEST(RockProfileTest, RaysFromStraightAboveTheTopMeetIt) {
  for (const double pointedness : kPointedness) {
    const Rock rock =
        ShapeRock({.diameter_m = 0.2, .half_height_m = 0.1, .height_m = 0.13}, pointedness);
    const RockShape shape(rock);
    EXPECT_NEAR(shape.Distance({0.0, 0.0, 0.5}, -Vector3::UnitZ()), 0.37, 1e-12) << pointedness;
    EXPECT_EQ(shape.Distance({0.0, 0.0, 0.5}, Vector3::UnitZ()), RockShape::kNoHit);
    // Level over the top, and level through half its height.
    EXPECT_EQ(shape.Distance({-1.0, 0.0, 0.1301}, Vector3::UnitX()), RockShape::kNoHit);
    EXPECT_LT(shape.Distance({-1.0, 0.0, 0.065}, Vector3::UnitX()), 1.0);
  }
}

// A = 1/2: the second sheet begins at its height over the top, where F is 0 as on the rock itself.
TEST(RockProfileTest, RaysFromTheSecondSheetItselfMeetTheTop) {
  const RockShape shape(
      ShapeRock({.diameter_m = 0.2, .half_height_m = 0.125, .height_m = 0.125}, 0.75));
  EXPECT_NEAR(shape.Distance({0.0, 0.0, 0.25}, -Vector3::UnitZ()), 0.125, 1e-12);
}

TEST(RockProfileTest, NothingLiesBelowTheBase) {
  const RockShape shape(
      ShapeRock({.diameter_m = 0.2, .half_height_m = 0.1, .height_m = 0.13}, 0.87));
  // To the cone's continuation below the ground, and level through it.
  const Vector3 direction_W = Vector3(0.3, 0.0, -0.2).normalized();
  EXPECT_EQ(shape.Distance({-0.3, 0.0, 0.1}, direction_W), RockShape::kNoHit);
  EXPECT_EQ(shape.Distance({-0.3, 0.0, -0.01}, Vector3::UnitX()), RockShape::kNoHit);
  EXPECT_EQ(shape.Distance({0.0, 0.0, -0.01}, Vector3::UnitX()), RockShape::kNoHit);
  EXPECT_LT(shape.Distance({-0.3, 0.0, 0.01}, Vector3::UnitX()), 0.3);
}

TEST(RockProfileTest, TopIsWhereTheSurfaceBegins) {
  core::RandomStream stream({52, 0}, core::Purpose::kTest);
  for (const double pointedness : kPointedness) {
    for (int i = 0; i < 200; ++i) {
      const Sample sample = DrawSample(stream, pointedness);
      const RockShape shape(sample.rock);
      const double x = sample.rock.center_W.x() + SampleUniform(stream, -0.2, 0.2);
      const double y = sample.rock.center_W.y() + SampleUniform(stream, -0.2, 0.2);
      const double top_m = shape.Top(x, y);
      if (top_m < 0.0) {
        // Outside of the outline on the ground, or under the widest part of a dome.
        EXPECT_GE(InsideOut(sample, {x, y, 0.0}), 0.0);
        continue;
      }
      EXPECT_LT(InsideOut(sample, {x, y, top_m - 1e-7}), 0.0);
      EXPECT_GT(InsideOut(sample, {x, y, top_m + 1e-7}), 0.0);
    }
    const Sample sample = DrawSample(stream, pointedness);
    EXPECT_NEAR(RockShape(sample.rock).Top(sample.rock.center_W.x(), sample.rock.center_W.y()),
                sample.outline.height_m, 1e-12);
  }
}

// Above 2 in A the widest part is in the air, below it is the ground's: it is D wide in any case.
TEST(RockProfileTest, KeepsItsOutline) {
  for (const double pointedness : kPointedness) {
    const RockShape shape(ShapeRock(kOutline, pointedness));
    EXPECT_GE(shape.Top(0.15 - 1e-9, 0.0), 0.0) << pointedness;
    EXPECT_GE(shape.Top(0.0, 0.12 - 1e-9), 0.0) << pointedness;
    EXPECT_LT(shape.Top(0.15 + 1e-9, 0.0), 0.0) << pointedness;
    EXPECT_LT(shape.Top(0.0, 0.12 + 1e-9), 0.0) << pointedness;
  }
}

TEST(RockProfileTest, NormalsAreTheGradient) {
  constexpr double kStep_m = 1e-6;
  core::RandomStream stream({53, 0}, core::Purpose::kTest);
  for (const double pointedness : kPointedness) {
    int checked = 0;
    for (int i = 0; i < 500; ++i) {
      const Sample sample = DrawSample(stream, pointedness);
      const Ray ray = RandomRay(stream, sample);
      const auto t = Cast(sample, ray);
      if (!t || *t == 0.0) continue;
      const Vector3 p_W = ray.origin_W + *t * ray.direction_W;
      // At the very top differences reach past it.
      if (sample.outline.height_m - p_W.z() < 0.002) continue;
      Vector3 gradient;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3 step = kStep_m * Vector3::Unit(axis);
        gradient[axis] = InsideOut(sample, p_W + step) - InsideOut(sample, p_W - step);
      }
      const Vector3 normal_W = RockShape(sample.rock).Normal(p_W);
      EXPECT_NEAR((normal_W - gradient.normalized()).norm(), 0.0, 1e-6) << pointedness;
      // The ray comes from outside.
      EXPECT_LE(normal_W.dot(ray.direction_W), 1e-9);
      ++checked;
    }
    EXPECT_GT(checked, 80) << pointedness;
  }
}

// From the ellipsoid on, where a dome becomes a cap (A = 2) and where that is a paraboloid (A = 1).
TEST(RockProfileTest, ShapesAreContinuousInPointedness) {
  const double growth_of_0 = 2.0 * kOutline.height_m / kOutline.half_height_m;
  core::RandomStream stream({54, 0}, core::Purpose::kTest);
  for (const double growth : {growth_of_0 - 1e-9, 2.0, 1.0}) {
    const double pointedness = 1.0 - growth / growth_of_0;
    const Rock before = ShapeRock(kOutline, std::max(0.0, pointedness - 1e-9));
    const Rock after = ShapeRock(kOutline, pointedness + 1e-9);
    for (int i = 0; i < 200; ++i) {
      const Vector3 aim_W(0.0, 0.0, SampleUniform(stream, 0.02, 0.19));
      Vector3 origin_W = RandomDirection(stream);
      origin_W.z() = std::abs(origin_W.z()) + 0.01;
      const Vector3 direction_W = (aim_W - origin_W).normalized();
      EXPECT_NEAR(RockShape(before).Distance(origin_W, direction_W),
                  RockShape(after).Distance(origin_W, direction_W), 1e-7)
          << growth;
    }
  }
}

// Bounding balls and footprints of the ellipsoid of centre and semi-axes hold for caps too.
TEST(RockProfileTest, LiesWithinTheEllipsoidOfItsSemiAxes) {
  core::RandomStream stream({55, 0}, core::Purpose::kTest);
  for (const double pointedness : kPointedness) {
    int caps = 0;
    for (int i = 0; i < 300; ++i) {
      const Sample sample = DrawSample(stream, pointedness);
      caps += sample.rock.cap_growth > 0.0;
      Rock hull = sample.rock;
      hull.cap_growth = 0.0;
      const double x = sample.rock.center_W.x() + SampleUniform(stream, -0.3, 0.3);
      const double y = sample.rock.center_W.y() + SampleUniform(stream, -0.3, 0.3);
      EXPECT_LE(RockShape(sample.rock).Top(x, y), RockShape(hull).Top(x, y) + 1e-12);
    }
    // Caps begin at A = 2: at pointedness 0.09 where 0.45 is buried, at 0.375 where 0.2 is.
    if (pointedness > 0.375) {
      EXPECT_EQ(caps, 300);
    } else if (pointedness < 0.09) {
      EXPECT_EQ(caps, 0);
    }
  }
}

TEST(RockProfileTest, IsConvex) {
  core::RandomStream stream({56, 0}, core::Purpose::kTest);
  for (const double pointedness : kPointedness) {
    for (int i = 0; i < 300; ++i) {
      const Sample sample = DrawSample(stream, pointedness);
      const RockShape shape(sample.rock);
      std::vector<Vector3> ends;
      while (ends.size() < 2) {
        const double x = sample.rock.center_W.x() + SampleUniform(stream, -0.3, 0.3);
        const double y = sample.rock.center_W.y() + SampleUniform(stream, -0.3, 0.3);
        const double top_m = shape.Top(x, y);
        if (top_m > 0.0) ends.emplace_back(x, y, top_m);
      }
      const Vector3 middle_W = 0.5 * (ends[0] + ends[1]);
      EXPECT_LE(InsideOut(sample, middle_W), 1e-9) << pointedness;
    }
  }
}

TEST(RockProfileTest, MirrorImagesAreAsPointed) {
  ArenaParams arena{.kind = ArenaKind::kVirtualUnfolded};
  core::RandomStream stream({57, 0}, core::Purpose::kTest);
  const Sample sample = DrawSample(stream, 0.87);
  const double line_m = arena.MirrorLine();
  for (const Rock& image : MirrorImages(arena, sample.rock)) {
    if (std::abs(image.center_W.y() - (2.0 * line_m - sample.rock.center_W.y())) > 1e-9) continue;
    for (int i = 0; i < 50; ++i) {
      const Ray ray = RandomRay(stream, sample);
      Vector3 origin_W = ray.origin_W;
      origin_W.y() = 2.0 * line_m - origin_W.y();
      const Vector3 direction_W = ray.direction_W.cwiseProduct(Vector3(1.0, -1.0, 1.0));
      const double t = RockShape(sample.rock).Distance(ray.origin_W, ray.direction_W);
      const double mirrored = RockShape(image).Distance(origin_W, direction_W);
      if (t == RockShape::kNoHit) {
        EXPECT_EQ(mirrored, t);
      } else {
        EXPECT_NEAR(mirrored, t, 1e-12);
      }
    }
    return;
  }
  FAIL() << "no image beyond the line";
}

}  // namespace
}  // namespace rockyard::terrain

// The roughness as one spline against its octaves, and rays by it against rays that march.

#include "terrain/relief_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "core/random.h"
#include "terrain/ground.h"

namespace rockyard::terrain {
namespace {

using core::SampleUniform;
using math::Vector3;

constexpr core::TrialKey kKey{21, 4};

TEST(ReliefSpline, IsTheSumOfTheOctaves) {
  // Five octaves, and the one that is its own finest.
  for (const double wavelength_m : {2.0, 0.2}) {
    const auto field = std::make_shared<const RoughnessField>(0.03, 0.7, wavelength_m, kKey);
    const ReliefSpline spline(nullptr, field);
    core::RandomStream stream({1, 1}, core::Purpose::kTest);
    for (int i = 0; i < 3000; ++i) {
      // On both sides of zero, and beyond where the lattice repeats.
      const double x_m = SampleUniform(stream, -150.0, 150.0);
      const double y_m = SampleUniform(stream, -150.0, 150.0);
      const ReliefSample expected = field->Sample(x_m, y_m);
      const ReliefSample sample = spline.Sample(x_m, y_m);
      ASSERT_NEAR(sample.height_m, expected.height_m, 1e-12) << x_m << ' ' << y_m;
      ASSERT_NEAR(sample.slope_x, expected.slope_x, 1e-11);
      ASSERT_NEAR(sample.slope_y, expected.slope_y, 1e-11);
    }
  }
}

Ground RoughGround(double rms_m, double slope_rad) {
  GroundParams params{.slope_rad = slope_rad, .slope_direction_rad = 0.7, .roughness_rms_m = rms_m};
  return Ground(params, kKey);
}

// Rays from above the ground in all directions, many of them flat, over ground of steep crests. A
// crest that is cut over less than 1 mm either way may miss; none of these rays does so.
TEST(ReliefSpline, RaysMeetTheSamePoint) {
  for (const double rms_m : {0.01, 0.15}) {
    const Ground ground = RoughGround(rms_m, 0.1);
    core::RandomStream stream({2, 1}, core::Purpose::kTest);
    int hits = 0, misses = 0;
    for (int i = 0; i < 12000; ++i) {
      const double x_m = SampleUniform(stream, -40.0, 40.0);
      const double y_m = SampleUniform(stream, -40.0, 40.0);
      const double up_m = SampleUniform(stream, 0.0, 1.0);
      const Vector3 origin(x_m, y_m, ground.Height(x_m, y_m) + up_m * up_m);
      const double turn = SampleUniform(stream, 0.0, 2.0 * std::numbers::pi);
      const double flat = SampleUniform(stream, -1.0, 1.0);
      const double elevation = 1.5 * flat * flat * flat;
      const Vector3 direction(std::cos(elevation) * std::cos(turn),
                              std::cos(elevation) * std::sin(turn), std::sin(elevation));
      const double far_m = SampleUniform(stream, 0.0, 12.0);
      const auto marched = ground.CastRay(origin, direction, far_m);
      const auto found = ground.CastRay(origin, direction, far_m, RayWay::kSpline);
      (marched ? hits : misses) += 1;
      ASSERT_EQ(marched.has_value(), found.has_value()) << i;
      if (marched) {
        ASSERT_NEAR(*marched, *found, 1e-9) << i;
      }
    }
    EXPECT_GT(hits, 1000);
    EXPECT_GT(misses, 1000);
  }
}

TEST(ReliefSpline, NormalsAreTheSame) {
  const Ground ground = RoughGround(0.05, 0.2);
  for (const double x_m : {-3.3, 0.0, 7.77}) {
    EXPECT_LT((ground.Normal(x_m, 1.0, RayWay::kSpline) - ground.Normal(x_m, 1.0)).norm(), 1e-11);
  }
}

TEST(ReliefSpline, RaysStraightDownUpAndFromBelow) {
  const Ground ground = RoughGround(0.05, 0.0);
  const Vector3 above(1.23, -4.5, 2.0);
  const double height_m = ground.Height(1.23, -4.5);
  const auto down = ground.CastRay(above, -Vector3::UnitZ(), 10.0, RayWay::kSpline);
  ASSERT_TRUE(down);
  EXPECT_NEAR(*down, 2.0 - height_m, 1e-9);
  EXPECT_FALSE(ground.CastRay(above, -Vector3::UnitZ(), 1.5, RayWay::kSpline));
  EXPECT_FALSE(ground.CastRay(above, Vector3::UnitZ(), 100.0, RayWay::kSpline));
  EXPECT_FALSE(ground.CastRay(above, Vector3::UnitX(), 100.0, RayWay::kSpline));
  const Vector3 below(1.23, -4.5, height_m - 0.01);
  EXPECT_EQ(ground.CastRay(below, Vector3::UnitX(), 10.0, RayWay::kSpline), 0.0);
}

// Ground with a pit is marched over either way.
TEST(ReliefSpline, PitsAreMet) {
  GroundParams params{
      .roughness_rms_m = 0.01,
      .pits = {
          .x_m = {0.0}, .y_m = {0.0}, .diameter_m = {1.0}, .depth_m = {0.4}, .flank_m = {0.3}}};
  const Ground ground(params, kKey);
  const Vector3 above(0.0, 0.0, 1.0);
  EXPECT_EQ(ground.CastRay(above, -Vector3::UnitZ(), 10.0, RayWay::kSpline),
            ground.CastRay(above, -Vector3::UnitZ(), 10.0));
}

TEST(ReliefSpline, ThreadsSeeTheSamePages) {
  const Ground ground = RoughGround(0.02, 0.0);
  std::vector<std::vector<double>> seen(4);
  std::vector<std::thread> threads;
  for (auto& values : seen) {
    threads.emplace_back([&ground, &values] {
      for (int i = 0; i < 400; ++i) {
        const Vector3 from(0.17 * i - 30.0, 0.11 * i - 20.0, 0.5);
        values.push_back(
            ground.CastRay(from, Vector3(0.6, 0.0, -0.8), 5.0, RayWay::kSpline).value_or(-1.0));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& values : seen) EXPECT_EQ(values, seen.front());
}

}  // namespace
}  // namespace rockyard::terrain

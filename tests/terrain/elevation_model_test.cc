// Ground on an elevation model against the analytic ground that was sampled: heights, slopes and
// rays, at three cells, with the orders at which the errors of cubic splines must fall.
#include "terrain/elevation_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "core/random.h"
#include "terrain/analytic_ground.h"
#include "terrain/ground.h"
#include "terrain/relief_spline.h"

namespace rockyard::terrain {
namespace {

using core::SampleUniform;
using math::Vector3;

constexpr core::TrialKey kKey{21, 4};

double HillSlopeX(double x_m, double y_m) {
  const double k = 2.0 * std::numbers::pi / 4.0;
  return 0.15 * k * std::cos(k * x_m) * std::cos(2.0 * std::numbers::pi * y_m / 3.0);
}

struct Place {
  double x_m, y_m;
};
Place PlaceInside(core::RandomStream& stream) {
  return {SampleUniform(stream, -5.0, 7.0), SampleUniform(stream, -4.0, 4.0)};
}

TEST(ElevationModel, GoesThroughEveryNode) {
  core::RandomStream stream({1, 1}, core::Purpose::kTest);
  const ElevationParams params =
      Sampled([&](double, double) { return SampleUniform(stream, -1.0, 1.0); }, 0.5);
  const Ground ground = GroundOn(params);
  for (std::size_t i = 0; i < params.heights_m.size(); ++i) {
    const auto column = static_cast<std::int64_t>(i) % params.columns - params.origin_column;
    const auto row = static_cast<std::int64_t>(i) / params.columns - params.origin_row;
    ASSERT_NEAR(ground.Height(static_cast<double>(column) * 0.5, static_cast<double>(row) * 0.5),
                params.heights_m[i], 1e-12)
        << i;
  }
}

// Cubics in either coordinate are splines themselves, up to the edges; four nodes are enough.
TEST(ElevationModel, IsExactForCubicsUpToTheEdge) {
  const auto cubic = [](double x, double y) {
    return 0.2 + 0.1 * x - 0.3 * y + 0.02 * x * y + 0.01 * x * x * x - 0.004 * x * x * y * y * y;
  };
  for (const double cell_m : {0.25, 0.5, 1.0}) {
    const Ground ground = GroundOn(Sampled(cubic, cell_m));
    core::RandomStream stream({2, 1}, core::Purpose::kTest);
    for (int i = 0; i < 500; ++i) {
      const auto [x_m, y_m] = PlaceInside(stream);
      ASSERT_NEAR(ground.Height(x_m, y_m), cubic(x_m, y_m), 1e-11) << x_m << ' ' << y_m;
    }
  }
  ElevationParams four;
  four.columns = 4;
  for (int i = 0; i < 16; ++i) four.heights_m.push_back(cubic(i % 4, i / 4));
  EXPECT_NEAR(GroundOn(four).Height(2.6, 0.3), cubic(2.6, 0.3), 1e-12);
}

// The largest errors over the model, of heights also over what is 1.5 m from its edges.
struct Errors {
  double inner_height_m = 0.0;
  double height_m = 0.0;
  double slope = 0.0;
  double ray_m = 0.0;
};
Errors ErrorsAt(double cell_m) {
  const Ground ground = GroundOn(Sampled(Hills, cell_m));
  core::RandomStream stream({3, 1}, core::Purpose::kTest);
  Errors errors;
  for (int i = 0; i < 4000; ++i) {
    const auto [x_m, y_m] = PlaceInside(stream);
    const double height_m = Hills(x_m, y_m);
    const double error_m = std::abs(ground.Height(x_m, y_m) - height_m);
    errors.height_m = std::max(errors.height_m, error_m);
    if (std::abs(x_m - 1.0) < 4.5 && std::abs(y_m) < 2.5) {
      errors.inner_height_m = std::max(errors.inner_height_m, error_m);
    }
    const Vector3 normal = ground.Normal(x_m, y_m);
    errors.slope =
        std::max(errors.slope, std::abs(-normal.x() / normal.z() - HillSlopeX(x_m, y_m)));
    // A ray at 45 degrees that the analytic ground meets there: no steeper than 22 degrees, it is
    // met first there.
    const double turn = SampleUniform(stream, 0.0, 2.0 * std::numbers::pi);
    const Vector3 direction(std::sqrt(0.5) * std::cos(turn), std::sqrt(0.5) * std::sin(turn),
                            -std::sqrt(0.5));
    const Vector3 origin = Vector3(x_m, y_m, height_m) - 1.0 * direction;
    const auto distance_m = ground.CastRay(origin, direction, 3.0);
    if (!distance_m) {
      ADD_FAILURE() << "no hit at " << x_m << ' ' << y_m;
      break;
    }
    errors.ray_m = std::max(errors.ray_m, std::abs(*distance_m - 1.0));
  }
  return errors;
}

// The stated bound at every cell, and orders of 4, 3 and 4 within a fifth. Places at the edge
// count, where the constant is the largest.
TEST(ElevationModel, ErrorsFallAtTheOrdersOfCubicSplines) {
  const double kx = 2.0 * std::numbers::pi / 4.0;
  const double ky = 2.0 * std::numbers::pi / 3.0;
  const double fourth = 0.15 * (std::pow(kx, 4.0) + std::pow(ky, 4.0));
  std::vector<Errors> by_cell;
  for (const double cell_m : {0.25, 0.125, 0.0625}) {
    by_cell.push_back(ErrorsAt(cell_m));
    const double bound_m = 5.0 / 384.0 * std::pow(cell_m, 4.0) * fourth;
    EXPECT_LT(by_cell.back().inner_height_m, bound_m);
    EXPECT_LT(by_cell.back().height_m, 7.0 * bound_m);
    EXPECT_LT(by_cell.back().slope, std::pow(cell_m, 3.0) * fourth);
    // The gap closes at no less than 0.45 of the ray's length.
    EXPECT_LT(by_cell.back().ray_m, by_cell.back().height_m / 0.4);
  }
  for (std::size_t i = 0; i + 1 < by_cell.size(); ++i) {
    EXPECT_NEAR(std::log2(by_cell[i].height_m / by_cell[i + 1].height_m), 4.0, 0.8);
    EXPECT_NEAR(std::log2(by_cell[i].slope / by_cell[i + 1].slope), 3.0, 0.6);
    EXPECT_NEAR(std::log2(by_cell[i].ray_m / by_cell[i + 1].ray_m), 4.0, 0.8);
  }
  // A control: errors that did not fall so would be seen.
  EXPECT_GT(by_cell.front().height_m, 1e-5);
}

TEST(ElevationModel, GoesOnLevelBeyondItsEdges) {
  const Ground ground = GroundOn(Sampled(Hills, 0.5));
  const double x_m = 9.0;
  EXPECT_EQ(ground.Height(x_m, 1.3), ground.Height(x_m + 500.0, 1.3));
  EXPECT_NEAR(ground.Normal(700.0, -900.0).z(), 1.0, 1e-15);
  const auto down = ground.CastRay({700.0, -900.0, 5.0}, -Vector3::UnitZ(), 10.0);
  ASSERT_TRUE(down);
  EXPECT_NEAR(*down, 5.0 - ground.Height(700.0, -900.0), 1e-12);
  // Over the edge the slope is continuous, as everywhere.
  for (const double edge_m : {-5.0, 7.0}) {
    EXPECT_LT((ground.Normal(edge_m - 1e-7, 0.4) - ground.Normal(edge_m + 1e-7, 0.4)).norm(), 1e-5);
  }
}

GroundParams RoughModel(double cell_m, double wavelength_m) {
  GroundParams params{.slope_rad = 0.05,
                      .slope_direction_rad = 0.7,
                      .roughness_rms_m = 0.02,
                      .roughness_wavelength_m = wavelength_m};
  params.elevation = Sampled(Hills, cell_m);
  return params;
}

// Model and roughness are one spline, whichever lattice is the finer one, and where a wavelength
// was typed with ten digits.
TEST(ElevationModel, CarriesRoughness) {
  for (const auto& [cell_m, wavelength_m] :
       {std::pair{0.5, 1.0}, {1.0, 0.5}, {0.25, 4.0}, {0.03125, 0.25}, {0.5, 1.0 + 4e-10}}) {
    const GroundParams rough = RoughModel(cell_m, wavelength_m);
    const Ground ground(rough, kKey);
    GroundParams model = rough;
    model.roughness_rms_m = 0.0;
    const Ground smooth(model, kKey);
    const RoughnessField field(0.02, rough.hurst_exponent, wavelength_m, kKey);
    core::RandomStream stream({4, 1}, core::Purpose::kTest);
    for (int i = 0; i < 60; ++i) {
      // Beyond the model, too.
      const double x_m = SampleUniform(stream, -30.0, 30.0);
      const double y_m = SampleUniform(stream, -30.0, 30.0);
      ASSERT_NEAR(ground.Height(x_m, y_m),
                  smooth.Height(x_m, y_m) + field.Sample(x_m, y_m).height_m, 1e-8);
    }
  }
}

// Rays over ground with pits step by them.
TEST(ElevationModel, BoundsHold) {
  const GroundParams rough = RoughModel(0.5, 1.0);
  const ReliefSpline spline(
      rough.elevation.surface->Of(rough.elevation)->model(),
      std::make_shared<const RoughnessField>(0.02, rough.hurst_exponent, 1.0, kKey));
  constexpr double kStep_m = 1e-4;
  ReliefBounds seen;
  for (int i = 0; i < 20000; ++i) {
    const double x_m = -6.0 + 0.07 * (i % 200);
    const double y_m = -5.0 + 0.1 * (i / 200);
    const ReliefSample at = spline.Sample(x_m, y_m);
    const ReliefSample ahead = spline.Sample(x_m + kStep_m, y_m);
    seen.height_m = std::max(seen.height_m, at.height_m);
    seen.slope = std::max(seen.slope, std::hypot(at.slope_x, at.slope_y));
    seen.curvature_per_m =
        std::max(seen.curvature_per_m,
                 std::hypot(ahead.slope_x - at.slope_x, ahead.slope_y - at.slope_y) / kStep_m);
  }
  EXPECT_LE(seen.height_m, spline.bounds().height_m);
  EXPECT_LE(seen.slope, spline.bounds().slope);
  EXPECT_LE(seen.curvature_per_m, spline.bounds().curvature_per_m);
  EXPECT_GT(seen.slope, 0.2 * spline.bounds().slope);
  EXPECT_GT(seen.curvature_per_m, 0.1 * spline.bounds().curvature_per_m);
}

// With a pit the same ground is marched over by bounds of the whole. Rays that both find meet it at
// one point; a crest cut over less than 1 mm either way may miss, and none of these rays does so.
TEST(ElevationModel, RaysMeetWhatRaysThatMarchMeet) {
  const GroundParams rough = RoughModel(0.5, 1.0);
  GroundParams far_pit = rough;
  far_pit.pits = {
      .x_m = {500.0}, .y_m = {0.0}, .diameter_m = {1.0}, .depth_m = {0.1}, .flank_m = {0.4}};
  const Ground splined(rough, kKey);
  const Ground marched(far_pit, kKey);
  core::RandomStream stream({5, 1}, core::Purpose::kTest);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const double x_m = SampleUniform(stream, -9.0, 11.0);
    const double y_m = SampleUniform(stream, -8.0, 8.0);
    const double up_m = SampleUniform(stream, 0.01, 1.5);
    const Vector3 origin(x_m, y_m, splined.Height(x_m, y_m) + up_m);
    const double turn = SampleUniform(stream, 0.0, 2.0 * std::numbers::pi);
    const double rise = SampleUniform(stream, -1.2, 0.4);
    const Vector3 direction(std::cos(rise) * std::cos(turn), std::cos(rise) * std::sin(turn),
                            std::sin(rise));
    const auto a = splined.CastRay(origin, direction, 8.0);
    const auto b = marched.CastRay(origin, direction, 8.0);
    ASSERT_EQ(a.has_value(), b.has_value()) << i;
    if (!a) continue;
    ++hits;
    ASSERT_NEAR(*a, *b, 1e-9) << i;
    EXPECT_EQ(a, splined.CastRay(origin, direction, 8.0, RayWay::kSpline));
  }
  EXPECT_GT(hits, 1000);
}

TEST(ElevationModel, IsSharedUntilItChanges) {
  ElevationParams params = Sampled(Hills, 0.5);
  const ElevationParams copy = params;
  EXPECT_EQ(params.surface->Of(params), copy.surface->Of(copy));
  const auto before = params.surface->Of(params);
  const auto differs = [&](const auto& change) {
    const auto own = params.surface->Of(params);
    ElevationParams changed = params;
    change(changed);
    EXPECT_NE(changed.surface->Of(changed), own);
  };
  differs([](ElevationParams& p) { p.cell_m = 0.25; });
  differs([](ElevationParams& p) { p.origin_column += 1; });
  differs([](ElevationParams& p) { p.origin_row += 1; });
  differs([](ElevationParams& p) { p.columns = p.rows(); });
  params.heights_m[17] += 0.5;
  EXPECT_NE(params.surface->Of(params), before);
  EXPECT_NEAR(GroundOn(params).Height(-5.0 + 17 * 0.5, -4.0), params.heights_m[17], 1e-12);
}

TEST(ElevationModel, ThreadsSeeTheSamePages) {
  const Ground ground(RoughModel(0.5, 1.0), kKey);
  std::vector<std::vector<double>> seen(4);
  std::vector<std::thread> threads;
  for (auto& values : seen) {
    threads.emplace_back([&ground, &values] {
      for (int i = 0; i < 400; ++i) {
        // Beyond the model, where pages are under a lock, too.
        values.push_back(ground.Height(0.17 * i - 30.0, 0.11 * i - 20.0));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& values : seen) EXPECT_EQ(values, seen.front());
}

}  // namespace
}  // namespace rockyard::terrain

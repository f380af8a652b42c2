// The fast map against the plain one, cell for cell, on random ground with gaps.

#include <gtest/gtest.h>

#include "core/random.h"
#include "navigation/gestalt/map.h"
#include "navigation/gestalt/reference.h"

namespace rockyard::navigation {
namespace {

// Waves, noise and blocks of up to 30 cm; holes without points, and places with few.
messages::PointCloud RandomGround(std::uint32_t trial, double extent_m, int points) {
  core::RandomStream stream({31, trial}, core::Purpose::kTest, 1);
  const double wave = core::SampleUniform(stream, 0.0, 0.1);
  const double noise = core::SampleUniform(stream, 0.0, 0.06);
  const double tilt = core::SampleUniform(stream, -0.15, 0.15);
  struct Disc {
    double x, y, radius, height;
  };
  std::array<Disc, 12> discs;
  for (Disc& disc : discs) {
    disc = {core::SampleUniform(stream, -extent_m, extent_m),
            core::SampleUniform(stream, -extent_m, extent_m),
            core::SampleUniform(stream, 0.1, 0.25 * extent_m),
            core::SampleUniform(stream, -0.3, 0.3)};
  }
  messages::PointCloud cloud;
  for (int i = 0; i < points; ++i) {
    const double x = core::SampleUniform(stream, -extent_m, extent_m);
    const double y = core::SampleUniform(stream, -extent_m, extent_m);
    double z = tilt * x + wave * std::sin(3.0 * x) + core::SampleNormal(stream, 0.0, noise);
    bool seen = true;
    for (std::size_t k = 0; k < discs.size(); ++k) {
      if (std::hypot(x - discs[k].x, y - discs[k].y) > discs[k].radius) continue;
      if (k % 2 == 0) z += discs[k].height;
      if (k % 2 == 1) seen = false;
    }
    if (seen) cloud.points_R.push_back({x, y, z});
  }
  return cloud;
}

struct Tally {
  int unknown = 0;
  int hazards = 0;
  int best = 0;
};

// Compares all cells of a map that holds a cloud within 2 m of its rover.
Tally Compare(const GestaltMapParams& params, std::uint32_t trial, int points) {
  const messages::PointCloud cloud = RandomGround(trial, 1.8, points);
  GestaltMap map(params);
  map.BeginCycle(0.01, -0.02);
  map.Add(cloud, math::Transform::Identity());
  ReferenceMap reference(params);
  for (const math::Vector3& point : cloud.points_R) reference.Add(point);
  const GoodnessGrid& grid = map.Evaluate();
  Tally tally;
  for (int iy = 1; iy + 1 < grid.ny; ++iy) {
    for (int ix = 1; ix + 1 < grid.nx; ++ix) {
      const CellValue expected = reference.Evaluate(grid.x0_m + (ix + 0.5) * grid.xstep_m,
                                                    grid.y0_m + (iy + 0.5) * grid.ystep_m);
      const CellValue& value = grid.Cell(ix, iy);
      EXPECT_EQ(value, expected) << "trial " << trial << ", cell " << ix << ", " << iy << ": "
                                 << int{value.goodness} << " for " << int{expected.goodness};
      tally.unknown += !value.known;
      tally.hazards += value.known && value.goodness < 250;
      tally.best += value.known && value.goodness == 255;
    }
  }
  return tally;
}

GestaltMapParams Params(double xstep_m, double ystep_m) {
  GestaltMapParams params;
  params.grid = {-3.0, -3.1, 3.0, 3.1, xstep_m, ystep_m};
  params.grid_dist_timeout_m = 100.0;
  return params;
}

TEST(GestaltDifferentialTest, DefaultTests) {
  Tally sum;
  for (std::uint32_t trial = 0; trial < 60; ++trial) {
    const Tally tally = Compare(Params(0.2, 0.2), trial, 200 + 40 * static_cast<int>(trial));
    sum.unknown += tally.unknown;
    sum.hazards += tally.hazards;
    sum.best += tally.best;
  }
  // All kinds of cells occur, so that agreement means something.
  EXPECT_GT(sum.unknown, 1000);
  EXPECT_GT(sum.hazards, 1000);
  EXPECT_GT(sum.best, 500);
}

TEST(GestaltDifferentialTest, OtherCells) {
  for (std::uint32_t trial = 100; trial < 110; ++trial) {
    Compare(Params(0.1, 0.1), trial, 4000);
    Compare(Params(0.5, 0.5), trial, 1000);
    Compare(Params(0.15, 0.33), trial, 2000);
    Compare(Params(1.0, 0.9), trial, 400);
  }
}

TEST(GestaltDifferentialTest, EveryChoice) {
  for (std::uint32_t trial = 200; trial < 272; ++trial) {
    GestaltMapParams params = Params(0.2, 0.25);
    const auto pick = [trial](std::uint32_t shift, std::uint32_t values) {
      return (trial * 2654435761U >> shift) % values;
    };
    params.tests = {pick(1, 2) == 1, pick(2, 2) == 1, pick(3, 2) == 1, pick(4, 2) == 1};
    params.failed_fit = static_cast<FailedFit>(pick(5, 3));
    params.certainty = static_cast<CellCertainty>(pick(8, 2));
    params.border_neighbours = static_cast<BorderNeighbours>(pick(9, 2));
    params.patch = static_cast<PatchSize>(pick(10, 2));
    params.roughness_formula = static_cast<RoughnessFormula>(pick(11, 2));
    params.hazard_height = static_cast<HazardHeight>(pick(12, 3));
    params.step_reference = static_cast<StepReference>(pick(14, 2));
    params.roughness_fraction = 0.25 + 0.25 * pick(15, 4);
    params.min_cell_coverage = 0.2 * pick(17, 6);
    params.min_patch_share = 0.21 * pick(20, 4);
    params.eigen_ratio = 2.0 + 10.0 * pick(22, 3);
    params.outliers_per_cell = pick(25, 4);
    params.pairs.step_obst = {40, 250};
    params.pairs.rough_obst = {60, 220};
    params.pairs.pitch_obst = {80, 200};
    SCOPED_TRACE(trial);
    Compare(params, trial, 1500);
  }
}

}  // namespace
}  // namespace rockyard::navigation

// Cost of the map of GESTALT on a grid of 9 m x 9 m, beside table 3 of Goldberg 2002. Every cell
// holds points, so that every patch is fitted: the worst case. Each benchmark prints a hash of what
// it computed. Counters: us, and how many times as long as on the next coarser cells, here and in
// the paper's three columns (Pentium III 500 MHz, Sparc 300 MHz, RAD6000 20 MHz; 50, 20, 10 cm).
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <string>

#include "core/distributions.h"
#include "core/hash.h"
#include "core/random.h"
#include "navigation/gestalt_map.h"
#include "navigation/gestalt_votes.h"

namespace rockyard::navigation {
namespace {

constexpr double kSide_m = 9.0;
constexpr std::array<double, 3> kCells_m = {0.5, 0.2, 0.1};

// Seconds by cell size, in the order of kCells_m.
struct Table3 {
  std::array<double, 3> pentium_s;
  std::array<double, 3> sparc_s;
  std::array<double, 3> rad6000_s;
};
constexpr Table3 kFitPlanes = {{0.0294, 0.14, 1.0}, {0.0761, 0.404, 2.72}, {1.4, 4.21, 25.1}};
constexpr Table3 kTraversability = {
    {0.00171, 0.0192, 0.144}, {0.00351, 0.0579, 0.45}, {0.0567, 0.685, 5.49}};
constexpr Table3 kPathVotes = {{0.022, 0.0454, 0.0838}, {0.0637, 0.126, 0.214}, {1.15, 1.69, 3.06}};

GestaltMapParams Params(double cell_m) {
  GestaltMapParams params;
  params.grid = {0.0, 0.0, kSide_m, kSide_m, cell_m, cell_m};
  params.grid_dist_timeout_m = 100.0;
  return params;
}

// Rolling ground with blocks and centimetres of noise; four points for every cell of 10 cm.
messages::PointCloud Ground() {
  core::RandomStream stream({41, 0}, core::Purpose::kTest, 1);
  messages::PointCloud cloud;
  for (double x = -4.975; x < 5.0; x += 0.05) {
    for (double y = -4.975; y < 5.0; y += 0.05) {
      const bool rock = std::sin(3.1 * x) * std::sin(2.3 * y + x) > 0.93;
      const double noise = core::SampleUniform(stream, -0.02, 0.02);
      cloud.points_R.push_back({x, y, 0.03 * std::sin(x + y) + (rock ? 0.18 : 0.0) + noise});
    }
  }
  return cloud;
}

struct Cells {
  CellWindow window;
  CellBox box;
};

// All cells of the grid, filled with the ground.
Cells FilledCells(const GestaltMapParams& params) {
  Cells cells{CellWindow(params.grid.nx(), params.grid.ny()), {}};
  cells.box = {0, params.grid.nx(), 0, params.grid.ny()};
  for (const math::Vector3& p : Ground().points_R) {
    const auto ix = static_cast<int>(std::floor((p.x() + 0.5 * kSide_m) / params.grid.xstep_m));
    const auto iy = static_cast<int>(std::floor((p.y() + 0.5 * kSide_m) / params.grid.ystep_m));
    if (ix < 0 || iy < 0 || ix >= params.grid.nx() || iy >= params.grid.ny()) continue;
    cells.window.At(ix, iy).moments.AddPoint(math::ToMomentUnits(p.x()), math::ToMomentUnits(p.y()),
                                             math::ToMomentUnits(p.z()));
  }
  return cells;
}

double CellSize(const benchmark::State& state) {
  return kCells_m[static_cast<std::size_t>(state.range(0))];
}

// The paper's milliseconds on its three machines, and their growth from the next coarser cells.
void Publish(benchmark::State& state, const Table3& paper, const core::Hasher& hash) {
  const auto i = static_cast<std::size_t>(state.range(0));
  state.counters["P3_ms"] = 1e3 * paper.pentium_s[i];
  state.counters["Sparc_ms"] = 1e3 * paper.sparc_s[i];
  state.counters["RAD_ms"] = 1e3 * paper.rad6000_s[i];
  if (i > 0) {
    state.counters["P3_growth"] = paper.pentium_s[i] / paper.pentium_s[i - 1];
    state.counters["Sparc_growth"] = paper.sparc_s[i] / paper.sparc_s[i - 1];
    state.counters["RAD_growth"] = paper.rad6000_s[i] / paper.rad6000_s[i - 1];
  }
  state.SetLabel(std::to_string(static_cast<int>(100.0 * CellSize(state))) + " cm " +
                 core::Hex(hash.value()));
}

void BM_FitPlanes(benchmark::State& state) {
  GestaltMapParams params = Params(CellSize(state));
  params.tests.pitch = state.range(1) != 0;
  const Cells cells = FilledCells(params);
  PatchPlanes planes(params);
  for (auto _ : state) {
    planes.Fit(cells.window, cells.box);
    benchmark::DoNotOptimize(planes.planes().data());
  }
  core::Hasher hash;
  for (const PatchPlane& plane : planes.planes()) {
    hash.Real(plane.residual_m).Real(plane.slope_rad).Integer(plane.plane_valid);
  }
  Publish(state, kFitPlanes, hash);
}

void BM_Traversability(benchmark::State& state) {
  const GestaltMapParams params = Params(CellSize(state));
  const Cells cells = FilledCells(params);
  PatchPlanes planes(params);
  planes.Fit(cells.window, cells.box);
  PatchSteps steps;
  const Traversability traversability(params);
  GoodnessGrid grid;
  grid.nx = params.grid.nx();
  grid.ny = params.grid.ny();
  for (auto _ : state) {
    steps.Find(cells.window, cells.box, planes.reach());
    traversability.Assess(planes.planes(), steps.steps_m(), grid);
    benchmark::DoNotOptimize(grid.cells.data());
  }
  core::Hasher hash;
  for (const CellValue& cell : grid.cells) hash.Integer(cell.goodness).Integer(cell.known);
  Publish(state, kTraversability, hash);
}

// All votes of one cycle: 23 arcs either way and two point turns.
void BM_PathVotes(benchmark::State& state) {
  GestaltParams params;
  params.map = Params(CellSize(state));
  GestaltMap map(params.map);
  map.BeginCycle(0.0, 0.0);
  map.Add(Ground(), math::Transform::Identity());
  const GoodnessGrid grid = map.Evaluate();
  const ArcVoter voter(params);
  const messages::PoseEstimate estimate{.x_m = 0.03, .y_m = -0.07, .heading_rad = 0.4};
  const messages::Goal goal{7.0, 1.0};
  for (auto _ : state) benchmark::DoNotOptimize(voter.Vote(grid, estimate, goal).forward.data());
  core::Hasher hash;
  for (const messages::MotionVote& vote : voter.Vote(grid, estimate, goal).forward) {
    hash.Real(vote.hazard).Real(vote.merged);
  }
  Publish(state, kPathVotes, hash);
}

// A whole cycle with a cloud of 128 x 128 points ahead, as a stereo pair gives it.
void BM_Cycle(benchmark::State& state) {
  GestaltMapParams params = Params(CellSize(state));
  params.grid_dist_timeout_m = 3.0;
  messages::PointCloud cloud;
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 128; ++column) {
      const double range = 0.6 / std::tan(0.2 + 0.007 * row);
      const double bearing = 0.007 * (column - 63.5);
      cloud.points_R.push_back({range, range * std::tan(bearing), 0.01 * std::sin(9.0 * column)});
    }
  }
  GestaltMap map(params);
  core::Hasher hash;
  double x_m = 0.0;
  for (auto _ : state) {
    x_m += 0.35;
    map.BeginCycle(x_m, 0.0);
    map.Add(cloud, math::MakePose({x_m, 0.0, 0.0}, 0.0, 0.0, 0.0));
    benchmark::DoNotOptimize(map.Evaluate().cells.data());
  }
  for (const CellValue& cell : map.Evaluate().cells) hash.Integer(cell.goodness);
  state.SetLabel(std::to_string(static_cast<int>(100.0 * CellSize(state))) + " cm");
}

BENCHMARK(BM_FitPlanes)
    ->ArgNames({"cells", "pitch"})
    ->ArgsProduct({{0, 1, 2}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Traversability)->ArgName("cells")->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_PathVotes)->ArgName("cells")->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Cycle)->ArgName("cells")->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rockyard::navigation

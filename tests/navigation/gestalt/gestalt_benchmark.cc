// Cost of the steps of GESTALT on a grid of 9 m x 9 m, beside table 3 of Goldberg 2002. Every cell
// holds points, so that all patches but those of the corners are fitted: the worst case. Each
// benchmark prints a hash of what it computed. Counters: the paper's milliseconds (Pentium III
// 500 MHz, Sparc 300 MHz, RAD6000 20 MHz), and `growth`, how many times as long as on the next
// coarser cells (50, 20, 10 cm), here and in the paper.
//
// There are 6.25 and 4 times as many cells as on the next coarser ones. Planes and hazards here
// cost about as much a cell whatever its size, as the sums over a patch slide from cell to cell.
// From 20 to 10 cm the paper's planes grow by 7.14, 6.73 and 5.96 and its hazards by 7.5, 7.8
// and 8.0, more than 4: step 3 of section 4 merges a patch of the rover's size for every cell, and
// such a patch holds four times as many cells too. From 50 to 20 cm its planes grow by 4.8, 5.3
// and 3.0 alone, as a part of their time does not go with the cells.

#include <benchmark/benchmark.h>

#include <ctime>

#include "core/hash.h"
#include "core/random.h"
#include "navigation/gestalt/map.h"
#include "navigation/gestalt/reference.h"
#include "navigation/gestalt/splines.h"
#include "navigation/gestalt/votes.h"
#include "trial/clock/compute_tables.h"

namespace rockyard::navigation {
namespace {

using trial::kTable3Cells_m;
using trial::Table3Row;

constexpr double kSide_m = 9.0;

// Table 1 on a grid of that side, in which nothing is too far.
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

// A row of table 3; does not compile where there is none of that name.
consteval const Table3Row& RowOf(std::string_view name) {
  for (const Table3Row& row : trial::kTable3Rows) {
    if (row.name == name) return row;
  }
  throw "no such row";
}

std::string Label(std::size_t cells, std::uint64_t hash) {
  return std::to_string(static_cast<int>(100.0 * kTable3Cells_m[cells])) + " cm " + core::Hex(hash);
}

template <bool kPitch>
class FitPlanes {
 public:
  static constexpr const Table3Row& kPaper = RowOf("Fit planes");

  explicit FitPlanes(double cell_m) : planes_(WithPitch(Params(cell_m))) {}

  void Run() {
    planes_.Fit(cells_.window, cells_.box);
    benchmark::DoNotOptimize(planes_.planes().data());
  }
  std::uint64_t Hash() const {
    core::Hasher hash;
    for (const PatchPlane& plane : planes_.planes()) {
      hash.Real(plane.residual_m).Real(plane.slope_rad).Integer(plane.plane_valid);
    }
    return hash.value();
  }

 private:
  GestaltMapParams WithPitch(GestaltMapParams params) {
    params.tests.pitch = kPitch;
    cells_ = FilledCells(params);
    return params;
  }

  Cells cells_{CellWindow(1, 1), {}};
  PatchPlanes planes_;
};

class Hazards {
 public:
  static constexpr const Table3Row& kPaper = RowOf("Traversability analysis");

  explicit Hazards(double cell_m)
      : params_(Params(cell_m)),
        cells_(FilledCells(params_)),
        planes_(params_),
        traversability_(params_) {
    planes_.Fit(cells_.window, cells_.box);
    grid_.nx = params_.grid.nx();
    grid_.ny = params_.grid.ny();
  }

  void Run() {
    steps_.Find(cells_.window, cells_.box, planes_.reach());
    traversability_.Assess(planes_.planes(), steps_.steps_m(), grid_);
    benchmark::DoNotOptimize(grid_.cells.data());
  }
  std::uint64_t Hash() const {
    core::Hasher hash;
    for (const CellValue& cell : grid_.cells) hash.Integer(cell.goodness).Integer(cell.known);
    return hash.value();
  }

 private:
  GestaltMapParams params_;
  Cells cells_;
  PatchPlanes planes_;
  PatchSteps steps_;
  Traversability traversability_;
  GoodnessGrid grid_;
};

GestaltParams WithMap(double cell_m) {
  GestaltParams params;
  params.map = Params(cell_m);
  return params;
}

// What a map makes of the ground.
GoodnessGrid GroundGrid(double cell_m) {
  GestaltMap map(Params(cell_m));
  map.BeginCycle(0.0, 0.0);
  map.Add(Ground(), math::Transform::Identity());
  return map.Evaluate();
}

// All votes of one cycle: 23 arcs either way and two turns in place.
class PathVotes {
 public:
  static constexpr const Table3Row& kPaper = RowOf("Path votes");

  explicit PathVotes(double cell_m) : voter_(WithMap(cell_m)), grid_(GroundGrid(cell_m)) {}

  void Run() { benchmark::DoNotOptimize(Vote().forward.data()); }
  std::uint64_t Hash() const {
    core::Hasher hash;
    for (const messages::MotionVote& vote : Vote().forward) {
      hash.Real(vote.hazard).Real(vote.merged);
    }
    return hash.value();
  }

 private:
  MotionVotes Vote() const {
    const messages::PoseEstimate estimate{.x_m = 0.03, .y_m = -0.07, .heading_rad = 0.4};
    return voter_.Vote(grid_, estimate, messages::Goal{7.0, 1.0});
  }

  ArcVoter voter_;
  GoodnessGrid grid_;
};

// The votes of one cycle on 225 splines, and the choice (Howard 2012, section 3).
class SplineChoice {
 public:
  SplineChoice(double cell_m, const GestaltParams& params)
      : params_(params), grid_(GroundGrid(cell_m)), voter_(params, 0.07) {}

  void Run() const {
    const SplineVotes votes = Vote();
    benchmark::DoNotOptimize(ChooseSpline(votes, params_));
  }
  // The same votes by plain integrals and VoteOnPath.
  void RunPlain() const {
    benchmark::DoNotOptimize(
        ReferenceVotes(params_, grid_, kStart, kCurvature_per_m, kGoal).data());
  }
  std::uint64_t Hash() const {
    core::Hasher hash;
    for (const messages::SplineVote& vote : Vote()) {
      hash.Real(vote.hazard).Real(vote.waypoint).Real(vote.merged);
    }
    return hash.value();
  }

 private:
  static constexpr messages::PoseEstimate kStart{.x_m = 0.03, .y_m = -0.07, .heading_rad = 0.4};
  static constexpr double kCurvature_per_m = 0.2;
  static constexpr messages::Goal kGoal{7.0, 1.0};

  SplineVotes Vote() const { return voter_.Vote(grid_, kStart, kCurvature_per_m, kGoal); }

  GestaltParams params_;
  GoodnessGrid grid_;
  SplineVoter voter_;
};

// One navigation cycle after another, 35 cm apart, each with a cloud of 128 x 128 points ahead, as
// a stereo pair gives it, and the map within 3 m.
class Cycle {
 public:
  explicit Cycle(double cell_m) : map_(Within3m(Params(cell_m))) {
    for (int row = 0; row < 128; ++row) {
      for (int column = 0; column < 128; ++column) {
        const double range = 0.6 / std::tan(0.2 + 0.007 * row);
        const double bearing = 0.007 * (column - 63.5);
        cloud_.points_R.push_back(
            {range, range * std::tan(bearing), 0.01 * std::sin(9.0 * column)});
      }
    }
  }

  void Run() {
    x_m_ += 0.35;
    map_.BeginCycle(x_m_, 0.0);
    map_.Add(cloud_, math::MakePose({x_m_, 0.0, 0.0}, 0.0, 0.0, 0.0));
    benchmark::DoNotOptimize(map_.Evaluate().cells.data());
  }
  std::uint64_t Hash() {
    core::Hasher hash;
    for (const CellValue& cell : map_.Evaluate().cells) hash.Integer(cell.goodness);
    return hash.value();
  }

 private:
  static GestaltMapParams Within3m(GestaltMapParams params) {
    params.grid_dist_timeout_m = 3.0;
    return params;
  }

  GestaltMap map_;
  messages::PointCloud cloud_;
  double x_m_ = 0.0;
};

// Processor time of `runs` runs, the least of five tries.
template <typename Function>
double Seconds(const Function& function, int runs) {
  double least = 1e9;
  for (int i = 0; i < 5; ++i) {
    const std::clock_t start = std::clock();
    for (int run = 0; run < runs; ++run) function();
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

// The paper's milliseconds on its three machines, and what they and ours are to the next coarser
// cells.
template <typename Step>
void BM_Step(benchmark::State& state) {
  const auto i = static_cast<std::size_t>(state.range(0));
  Step step(kTable3Cells_m[i]);
  for (auto _ : state) step.Run();
  const Table3Row& paper = Step::kPaper;
  state.counters["P3_ms"] = 1e3 * paper.pentium_3_s[i];
  state.counters["Sparc_ms"] = 1e3 * paper.sparc_s[i];
  state.counters["RAD_ms"] = 1e3 * paper.rad6000_s[i];
  if (i > 0) {
    Step coarser(kTable3Cells_m[i - 1]);
    state.counters["growth"] =
        Seconds([&step] { step.Run(); }, 100) / Seconds([&coarser] { coarser.Run(); }, 100);
    state.counters["P3_growth"] = paper.pentium_3_s[i] / paper.pentium_3_s[i - 1];
    state.counters["Sparc_growth"] = paper.sparc_s[i] / paper.sparc_s[i - 1];
    state.counters["RAD_growth"] = paper.rad6000_s[i] / paper.rad6000_s[i - 1];
  }
  state.SetLabel(Label(i, step.Hash()));
}

void BM_Cycle(benchmark::State& state) {
  const auto i = static_cast<std::size_t>(state.range(0));
  Cycle cycle(kTable3Cells_m[i]);
  for (auto _ : state) cycle.Run();
  Cycle hashed(kTable3Cells_m[i]);
  for (int run = 0; run < 20; ++run) hashed.Run();
  state.SetLabel(Label(i, hashed.Hash()));
}

// `plain` is how many times as long the same votes take by plain integrals.
void BM_Splines(benchmark::State& state, SplineLaw law) {
  const auto i = static_cast<std::size_t>(state.range(0));
  GestaltParams params = WithMap(kTable3Cells_m[i]);
  params.splines.law = law;
  params.speed.min_speed_share = 0.5;
  const SplineChoice choice(kTable3Cells_m[i], params);
  for (auto _ : state) choice.Run();
  const auto plain = [&choice] { choice.RunPlain(); };
  const auto fast = [&choice] { choice.Run(); };
  state.counters["plain"] = Seconds(plain, 10) / Seconds(fast, 10);
  state.SetLabel(Label(i, choice.Hash()));
}

void Sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("cells")->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
}

BENCHMARK_TEMPLATE(BM_Step, FitPlanes<false>)->Apply(Sizes);
BENCHMARK_TEMPLATE(BM_Step, FitPlanes<true>)->Apply(Sizes);
BENCHMARK_TEMPLATE(BM_Step, Hazards)->Apply(Sizes);
BENCHMARK_TEMPLATE(BM_Step, PathVotes)->Apply(Sizes);
BENCHMARK_CAPTURE(BM_Splines, InDistance, SplineLaw::kDistance)->Apply(Sizes);
BENCHMARK_CAPTURE(BM_Splines, InTime, SplineLaw::kTime)->Apply(Sizes);
BENCHMARK(BM_Cycle)->Apply(Sizes);

}  // namespace
}  // namespace rockyard::navigation

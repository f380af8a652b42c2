// Time per physics step on level ground and among rocks, simulated over CPU time, trials per
// CPU-second without sensing and navigation, each with a hash of the last state.
// Rocks follow N(>=D) = k D^-2.66 per m2 for 0.1 to 1 m (Matthies 1995 sec. 3), half buried; the
// rover drives, backs off and turns in a fixed pattern, so that it goes on whatever it meets.
#include <benchmark/benchmark.h>

#include <array>
#include <numbers>

#include "core/hash.h"
#include "rover_drive.h"
#include "terrain/rock.h"

namespace rockyard::rover {
namespace {

constexpr int kStepsPerTrial = 3600;

// Low-discrepancy numbers: the benchmark needs a fixed field, not a random one.
double Scatter(int index, double stride) { return std::fmod(0.5 + stride * index, 1.0); }

terrain::Terrain RockField(double k, double pointedness = 0.0) {
  constexpr double kExponent = 2.66;
  constexpr double kSmallest_m = 0.1;
  constexpr double kArea_m2 = 14.0 * 6.0;
  const int count = static_cast<int>(k * std::pow(kSmallest_m, -kExponent) * kArea_m2);
  std::vector<terrain::Rock> rocks;
  for (int i = 0; i < count; ++i) {
    const double x = -2.0 + 14.0 * Scatter(i, 0.7548776662466927);
    const double y = -3.0 + 6.0 * Scatter(i, 0.5698402909980532);
    const double tail = 1.0 - Scatter(i, 0.6180339887498949) * (1.0 - std::pow(10.0, -kExponent));
    const double a = 0.5 * kSmallest_m * std::pow(tail, -1.0 / kExponent);
    if (std::hypot(x, y) < 0.6 + a) continue;
    rocks.push_back(terrain::ShapeRock(
        {.diameter_m = 2.0 * a, .width_ratio = 0.85, .half_height_m = 0.7 * a, .height_m = 0.7 * a},
        pointedness));
    rocks.back().center_W.head<2>() << x, y;
    rocks.back().yaw_rad = 2.0 * std::numbers::pi * Scatter(i, 0.3247179572447461);
  }
  return FlatTerrain(std::move(rocks));
}

// Cost of the steps alone, and how many trials of this kind a CPU-second holds.
void Count(benchmark::State& bench, const RoverParams& params, int steps) {
  using benchmark::Counter;
  const double simulated_s = steps * params.physics.step_s;
  bench.counters["step"] = Counter(steps, Counter::kIsIterationInvariantRate | Counter::kInvert);
  bench.counters["simulated_per_cpu"] = Counter(simulated_s, Counter::kIsIterationInvariantRate);
  bench.counters["trials_per_cpu_s"] = Counter(1.0, Counter::kIsIterationInvariantRate);
}

// Seven seconds ahead, one back, two turning; again and again.
const messages::WheelCommand& Pattern(int step,
                                      const std::array<messages::WheelCommand, 3>& commands) {
  const int second = step / 60 % 10;
  return commands[second < 7 ? 0 : second < 8 ? 1 : 2];
}

void Minute(benchmark::State& bench, double k, double pointedness = 0.0) {
  const RoverParams params;
  const terrain::Terrain terrain = RockField(k, pointedness);
  const std::array<messages::WheelCommand, 3> commands{
      Drive(params, 0.15, 0.0), Drive(params, -0.15, 0.0), Drive(params, 0.0, 0.5)};
  std::string hash;
  for (auto _ : bench) {
    const auto rover = PlacedRover(params, terrain);
    for (int i = 0; i < kStepsPerTrial; ++i) rover->Step(Pattern(i, commands));
    hash = StateHash(rover->state());
  }
  Count(bench, params, kStepsPerTrial);
  bench.SetLabel(hash);
}
BENCHMARK_CAPTURE(Minute, Level, 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Minute, Nominal, 0.00415)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Minute, VikingLander2, 0.013)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Minute, NominalPointed, 0.00415, 0.87)->Unit(benchmark::kMillisecond);

// The published course of 7.6 m (Matthies 1995 sec. 5), rims running straight all the way in a
// fresh world; where rocks stop the rover, its wheels go on.
void Course(benchmark::State& bench, double k) {
  const RoverParams params;
  const int steps = static_cast<int>(7.6 / params.drive.speed_m_s / params.physics.step_s);
  const messages::WheelCommand command = Drive(params, params.drive.speed_m_s, 0.0);
  const terrain::Terrain terrain = RockField(k);
  std::string hash;
  for (auto _ : bench) {
    const auto rover = PlacedRover(params, terrain);
    for (int i = 0; i < steps; ++i) rover->Step(command);
    bench.counters["reached_m"] = rover->state().X_WR.translation().x();
    hash = StateHash(rover->state());
  }
  Count(bench, params, steps);
  bench.SetLabel(hash);
}
BENCHMARK_CAPTURE(Course, Level, 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Course, Nominal, 0.00415)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Course, VikingLander2, 0.013)->Unit(benchmark::kMillisecond);

void MakeAndPlace(benchmark::State& bench) {
  const RoverParams params;
  const terrain::Terrain terrain = RockField(0.013);
  for (auto _ : bench) {
    const auto rover = PlacedRover(params, terrain);
    benchmark::DoNotOptimize(rover->state().X_WR);
  }
}
BENCHMARK(MakeAndPlace)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rockyard::rover

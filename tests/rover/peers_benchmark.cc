// rockyard's rover beside MuJoCo, ODE and Bullet: the same rover straight ahead on the same hard
// ground, over rocks that are balls, since all four have those. Arguments: rate in Hz, iterations
// of the solver. README.md of src/rover has the table.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "peers/peer.h"
#include "rover_drive.h"

namespace rockyard::rover {
namespace {

constexpr double kSpeed_m_s = 0.15;
constexpr double kDrive_s = 14.0;
constexpr double kSettle_s = 1.0;

// A ball that is as high as the rock, and as long where it leaves the ground.
Ball BallLike(double x_m, double y_m, double center_z_m, double a_m, double c_m) {
  const double height_m = center_z_m + c_m;
  const double half2 = a_m * a_m * (1.0 - center_z_m * center_z_m / (c_m * c_m));
  const double radius_m = (half2 + height_m * height_m) / (2.0 * height_m);
  return {math::Vector3(x_m, y_m, height_m - radius_m), radius_m};
}

// Level ground, or one like the rocks of convergence_benchmark.cc.
std::vector<Ball> Balls(bool rocks) {
  if (!rocks) return {};
  return {BallLike(0.7, 0.2, 0.0, 0.12, 0.05), BallLike(1.1, -0.2, -0.02, 0.2, 0.11),
          BallLike(1.6, 0.18, -0.03, 0.15, 0.10), BallLike(2.1, 0.0, -0.05, 0.3, 0.09)};
}

class Rockyard : public Peer {
 public:
  Rockyard(const PeerScene& scene, Fidelity fidelity) : params_(scene.params) {
    params_.fidelity = fidelity;
    params_.physics.step_s = scene.step_s;
    params_.physics.solver_iterations = scene.iterations;
    if (fidelity == Fidelity::kQuasiStatic) params_.quasi_static.step_s = scene.step_s;
    std::vector<terrain::Rock> rocks;
    for (const Ball& ball : scene.balls) {
      const double r = ball.radius_m;
      rocks.push_back(MakeRock(ball.center_W.x(), ball.center_W.y(), ball.center_W.z(), r, r, r));
    }
    const terrain::SoilParams soil = terrain::MakeSoil(terrain::SoilPreset::kHardGround);
    terrain_ = std::make_unique<terrain::Terrain>(terrain::Ground({.soil = soil}, {}),
                                                  std::move(rocks), std::vector<terrain::Wall>{});
    rover_ = PlacedRover(params_, *terrain_);
  }
  void Step(double rate_rad_s) override {
    rover_->Step(Drive(params_, rate_rad_s * params_.geometry.wheel_radius_m, 0.0));
  }
  math::Transform X_WR() const override { return rover_->state().X_WR; }
  messages::PerWheel<double> WheelAngles() const override {
    return rover_->state().wheel_angle_rad;
  }

 private:
  RoverParams params_;
  std::unique_ptr<terrain::Terrain> terrain_;
  std::unique_ptr<Rover> rover_;
};

enum class Engine { kMultibody, kQuasiStatic, kMujoco, kMujocoFirm, kOde, kOdeQuick, kBullet };

std::unique_ptr<Peer> MakePeer(Engine engine, const PeerScene& scene) {
  switch (engine) {
    case Engine::kMultibody:
      return std::make_unique<Rockyard>(scene, Fidelity::kMultibody);
    case Engine::kQuasiStatic:
      return std::make_unique<Rockyard>(scene, Fidelity::kQuasiStatic);
    case Engine::kMujoco:
      return MakeMujoco(scene, false);
    case Engine::kMujocoFirm:
      return MakeMujoco(scene, true);
    case Engine::kOde:
      return MakeOde(scene, false);
    case Engine::kOdeQuick:
      return MakeOde(scene, true);
    case Engine::kBullet:
      return MakeBullet(scene);
  }
  return nullptr;
}

std::string Hash(const Peer& peer) {
  core::Hasher hasher;
  const math::Transform X_WR = peer.X_WR();
  for (const double value : X_WR.matrix().reshaped()) hasher.Real(value);
  for (const double angle : peer.WheelAngles()) hasher.Real(angle);
  return core::Hex(hasher.value());
}

// Building and settling do not count. Others ramp up as rockyard's motors do.
void Straight(benchmark::State& bench, Engine engine, bool rocks) {
  const double step_s = 1.0 / static_cast<double>(bench.range(0));
  const PeerScene scene(Balls(rocks), step_s, static_cast<int>(bench.range(1)));
  const double rate_rad_s = kSpeed_m_s / scene.params.geometry.wheel_radius_m;
  const bool ours = engine == Engine::kMultibody || engine == Engine::kQuasiStatic;
  const int steps = static_cast<int>(std::lround(kDrive_s / step_s));
  double tilt_rad = 0.0;
  for (auto _ : bench) {
    bench.PauseTiming();
    auto peer = MakePeer(engine, scene);
    for (int i = 0; i < std::lround(kSettle_s / step_s); ++i) peer->Step(0.0);
    const double start_m = peer->X_WR().translation().x();
    tilt_rad = 0.0;
    bench.ResumeTiming();
    for (int i = 0; i < steps; ++i) {
      const double share = ours ? 1.0 : (i + 1) * step_s / scene.params.drive.ramp_s;
      peer->Step(std::min(1.0, share) * rate_rad_s);
      tilt_rad = std::max(tilt_rad, math::Tilt(peer->X_WR()));
    }
    bench.PauseTiming();
    bench.counters["way_m"] = peer->X_WR().translation().x() - start_m;
    bench.SetLabel(Hash(*peer));
    peer.reset();
    bench.ResumeTiming();
  }
  using benchmark::Counter;
  bench.counters["tilt_deg"] = math::RadToDeg(tilt_rad);
  bench.counters["step"] = Counter(steps, Counter::kIsIterationInvariantRate | Counter::kInvert);
  bench.counters["simulated_per_cpu"] = Counter(kDrive_s, Counter::kIsIterationInvariantRate);
}

template <int... kIterations>
void Grid(benchmark::internal::Benchmark* b) {
  for (const int rate : {60, 120, 240, 480, 960, 1920}) {
    for (const int iterations : {kIterations...}) b->Args({rate, iterations});
  }
  b->Unit(benchmark::kMillisecond);
}
#define PEER(engine, grid)                                                           \
  BENCHMARK_CAPTURE(Straight, engine##Level, Engine::k##engine, false)->Apply(grid); \
  BENCHMARK_CAPTURE(Straight, engine##Rocks, Engine::k##engine, true)->Apply(grid)
PEER(Multibody, (Grid<5, 10, 40>));
PEER(QuasiStatic, (Grid<10>));
PEER(Mujoco, (Grid<5, 20, 100>));
PEER(MujocoFirm, (Grid<5, 20, 100>));
PEER(Ode, (Grid<0>));
PEER(OdeQuick, (Grid<20, 50, 100, 200>));
PEER(Bullet, (Grid<10, 50, 100, 200>));
#undef PEER

}  // namespace
}  // namespace rockyard::rover

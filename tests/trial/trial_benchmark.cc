// Closed loop: trials per CPU-second by field and fidelity of the rover, and the parts of a trial
// that are not the rover's motion. Each benchmark prints a hash of all that it computed, so that
// nobody gets faster by computing something else unnoticed.

#include <benchmark/benchmark.h>

#include <cmath>
#include <utility>

#include "core/hash.h"
#include "navigation/pathfinder/pathfinder_params.h"
#include "sensing/light_stripe.h"
#include "terrain/field.h"
#include "trial/course/layout.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

void HashTrial(const DriveResult& result, core::Hasher& hash) {
  hash.Integer(static_cast<std::uint64_t>(result.outcome)).Text(result.detail);
  for (const truth::DriveColumn& column : truth::kDriveColumns) {
    hash.Real(result.record.*column.member);
  }
}

// The first `trials` trials of seed 1 make one iteration.
void ClosedLoop(benchmark::State& state, const std::string& name, const std::string& fidelity,
                std::uint32_t trials) {
  const DriveParams drive = Pathfinder(name, {"rover.fidelity=" + fidelity});
  double ticks = 0.0;
  double scans = 0.0;
  for ([[maybe_unused]] auto _ : state) {
    core::Hasher hash;
    ticks = scans = 0.0;
    for (const DriveResult& result : RunTrials(drive, trials)) {
      HashTrial(result, hash);
      ticks +=
          (result.record.drive_time_s + result.record.turn_time_s) * drive.clock.control_rate_hz;
      scans += result.record.scans;
    }
    state.SetLabel("hash " + core::Hex(hash.value()));
  }
  state.counters["trials/s"] =
      benchmark::Counter(trials, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["ticks"] = ticks / trials;
  state.counters["scans"] = scans / trials;
}
BENCHMARK_CAPTURE(ClosedLoop, nominal_multibody, "nominal", "multibody", 8)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ClosedLoop, obstacles_085_multibody, "obstacles_0.85", "multibody", 8)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ClosedLoop, vl2_multibody, "vl2", "multibody", 8)->Unit(benchmark::kMillisecond);

BENCHMARK_CAPTURE(ClosedLoop, nominal_quasi_static, "nominal", "quasi_static", 40)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ClosedLoop, obstacles_085_quasi_static, "obstacles_0.85", "quasi_static", 40)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ClosedLoop, vl2_quasi_static, "vl2", "quasi_static", 40)
    ->Unit(benchmark::kMillisecond);

terrain::Field FieldOf(const DriveParams& drive, std::uint32_t index) {
  return terrain::BuildField(drive.terrain, LayoutKey(drive, {1, index}),
                             TerrainCourse(drive.course));
}

void BuildTerrain(benchmark::State& state, const std::string& name) {
  const DriveParams drive = Pathfinder(name);
  std::uint32_t index = 0;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(FieldOf(drive, index++));
  core::Hasher hash;
  const terrain::Field field = FieldOf(drive, 0);
  for (const terrain::Rock& rock : field.terrain.rocks()) {
    hash.Real(rock.center_W.x()).Real(rock.center_W.y()).Real(rock.height_m);
  }
  state.SetLabel("hash " + core::Hex(hash.value()));
}
BENCHMARK_CAPTURE(BuildTerrain, nominal, "nominal")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BuildTerrain, vl2, "vl2")->Unit(benchmark::kMicrosecond);

// Poses a scan interval apart along the true track of a trial, the rover upright.
std::vector<math::Transform> TrackOf(const DriveParams& drive, std::uint32_t index) {
  std::vector<math::Transform> poses;
  math::Pose2 last;
  for (const truth::TraceSample& sample : RunTraced(drive, index).trace.samples) {
    const math::Pose2& pose = sample.pose;
    const bool turned =
        std::abs(math::WrapAngle(pose.heading_rad - last.heading_rad)) >=
        drive.navigation.navigators.params<navigation::PathfinderParams>().turn_increment_rad;
    const bool drove =
        std::hypot(pose.x_m - last.x_m, pose.y_m - last.y_m) >=
        drive.navigation.navigators.params<navigation::PathfinderParams>().scan_interval_m;
    if (!poses.empty() && !turned && !drove) continue;
    last = pose;
    math::Transform X_WR = math::Transform::Identity();
    X_WR.translation() = math::Vector3(pose.x_m, pose.y_m, 0.0);
    X_WR.linear() = Eigen::AngleAxisd(pose.heading_rad, math::Vector3::UnitZ()).toRotationMatrix();
    poses.push_back(X_WR);
  }
  return poses;
}

// A few trials, so that one field's luck counts less; each scan sees its own trial's field.
struct Tracks {
  std::vector<terrain::Field> fields;
  std::vector<std::pair<std::size_t, math::Transform>> poses;  // field, pose

  explicit Tracks(const DriveParams& drive) {
    constexpr std::uint32_t kTrials = 4;
    for (std::uint32_t i = 0; i < kTrials; ++i) {
      fields.push_back(FieldOf(drive, i));
      for (const math::Transform& X_WR : TrackOf(drive, i)) poses.emplace_back(i, X_WR);
    }
  }
};

void Scan(benchmark::State& state, const std::string& name) {
  const DriveParams drive = Pathfinder(name);
  const Tracks tracks(drive);
  const sensing::LightStripe sensor(drive.sensors.light_stripe);
  const auto scan = [&](std::size_t i) {
    const auto& [field, X_WR] = tracks.poses[i % tracks.poses.size()];
    return sensor.Scan(tracks.fields[field].terrain, X_WR, {1, 0}, static_cast<std::int64_t>(i));
  };
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(scan(i++));
  core::Hasher hash;
  for (std::size_t k = 0; k < tracks.poses.size(); ++k) {
    const messages::StripeScan seen = scan(k);
    for (const messages::StripePixel& pixel : seen.pixels.points()) {
      hash.Integer(pixel.detected).Real(pixel.column_px);
    }
  }
  state.counters["poses"] = static_cast<double>(tracks.poses.size());
  state.SetLabel("hash " + core::Hex(hash.value()));
}
BENCHMARK_CAPTURE(Scan, nominal, "nominal")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Scan, vl2, "vl2")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace rockyard::trial

// Studies "detection" and "approach": scenes with one rock.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/random.h"
#include "experiments/cell_experiment.h"
#include "experiments/hazard_detection/hazard_detection.h"
#include "experiments/hazard_detection/hazard_judge.h"

namespace rockyard::experiments {
namespace {

using core::Purpose;
using core::RandomStream;

// What is drawn for one scene.
struct RockScene {
  terrain::Terrain terrain;
  double heading_rad = 0.0;
  double distance_shift_m = 0.0;
};

class RockStudy : public CellExperiment {
 public:
  RockStudy(const HazardDetectionParams& params, const trial::DriveParams& drive,
            const trial::ScanWatcher& watcher, const std::vector<std::string_view>& measured)
      : CellExperiment(params.Factors(), HazardColumns(), measured),
        params_(params),
        law_(drive.terrain.rocks),
        front_x_m_(drive.sensors.light_stripe.front_x_m),
        judge_(drive, watcher),
        bare_judge_(drive) {}

 protected:
  const HazardDetectionParams& params() const { return params_; }
  const HazardJudge& judge() const { return judge_; }

  RockCell CellOf(std::size_t cell) const {
    const std::vector<double> values = table().Values(cell);
    if (params_.proportions == RockProportions::kNatural) return {values[0], 0.0, values[1]};
    return {values[0], values[1], values[2]};
  }

  // Returns the last factor of the cell.
  double LastOf(std::size_t cell) const { return table().Values(cell).back(); }

  // Records depend on the order of the draws: side, lateral place, distance, heading.
  RockScene DrawScene(const RockCell& cell, core::TrialKey key) const {
    RandomStream placement(key, Purpose::kScenePlacement);
    const double side = core::SampleBernoulli(placement, 0.5) ? 1.0 : -1.0;
    const auto spread = [&](double half) { return core::SampleUniform(placement, -half, half); };
    const double lateral_m = side * (cell.lateral_offset_m + spread(0.5 * params_.lateral_width_m));
    const double shift_m = spread(0.5 * params_.distance_width_m);
    const double heading_rad = spread(params_.heading_jitter_rad);
    RandomStream shape(key, Purpose::kSceneRock);
    return {SceneTerrain(DrawSceneRock(cell, params_.proportions, law_, lateral_m, shape)),
            heading_rad, shift_m};
  }

  math::Transform Pose(double gap_m, double heading_rad) const {
    return PoseBefore(gap_m, heading_rad, front_x_m_);
  }

  // Returns the charges that the rock caused: those that bare sand does not draw under the same
  // noise.
  Percept CausedByRock(const Percept& seen, const math::Transform& X_WR, core::TrialKey key,
                       std::int64_t first_scan) const {
    const Percept bare = bare_judge_.Look(bare_, X_WR, key, first_scan);
    Percept caused(judge_.stripes());
    caused.scans = seen.scans;
    caused.first.missing = ChargedOnlyIn(seen.first.missing, bare.first.missing);
    caused.first.neighbour = ChargedOnlyIn(seen.first.neighbour, bare.first.neighbour);
    caused.first.range = ChargedOnlyIn(seen.first.range, bare.first.range);
    caused.believed = ChargedOnlyIn(seen.believed, bare.believed);
    return caused;
  }

  Percept LookAt(const terrain::Terrain& terrain, const math::Transform& X_WR, core::TrialKey key,
                 std::int64_t first_scan) const {
    Percept seen = judge_.Look(terrain, X_WR, key, first_scan);
    const bool charged = Any(seen.first.missing) || Any(seen.first.neighbour) ||
                         Any(seen.first.range) || Any(seen.believed);
    return charged ? CausedByRock(seen, X_WR, key, first_scan) : seen;
  }

 private:
  HazardDetectionParams params_;
  terrain::RockFieldParams law_;
  double front_x_m_;
  HazardJudge judge_;
  HazardJudge bare_judge_;
  terrain::Terrain bare_{terrain::Ground(), {}, {}};
};

double Flag(bool flag) { return flag ? 1.0 : 0.0; }

class DetectionStudy final : public RockStudy {
 public:
  DetectionStudy(const HazardDetectionParams& params, const trial::DriveParams& drive,
                 const trial::ScanWatcher& watcher)
      : RockStudy(params, drive, watcher,
                  {"scenes", "scans", "detected_single", "detected_double", "by_missing",
                   "by_neighbour", "by_range"}) {}

 private:
  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override {
    std::vector<double> sums(7, 0.0);
    const RockCell rock = CellOf(cell);
    for (std::int64_t scene = 0; scene < params().scenes_per_run; ++scene) {
      const core::TrialKey scene_key = SceneKey(key, params().scenes_per_run, scene);
      const RockScene drawn = DrawScene(rock, scene_key);
      const math::Transform X_WR = Pose(LastOf(cell) + drawn.distance_shift_m, drawn.heading_rad);
      const Percept percept = LookAt(drawn.terrain, X_WR, scene_key, 0);
      const bool missing = Any(percept.first.missing);
      const bool neighbour = Any(percept.first.neighbour);
      const bool range = Any(percept.first.range);
      const double row[] = {1.0,
                            static_cast<double>(percept.scans),
                            Flag(missing || neighbour || range),
                            Flag(Any(percept.believed)),
                            Flag(missing),
                            Flag(neighbour),
                            Flag(range)};
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += row[i];
    }
    return sums;
  }
};

class ApproachStudy final : public RockStudy {
 public:
  ApproachStudy(const HazardDetectionParams& params, const trial::DriveParams& drive,
                const trial::ScanWatcher& watcher)
      : RockStudy(params, drive, watcher,
                  {"scenes", "scans", "detected_single", "detected_double"}) {}

 private:
  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override {
    std::vector<double> sums(4, 0.0);
    const RockCell rock = CellOf(cell);
    for (std::int64_t scene = 0; scene < params().scenes_per_run; ++scene) {
      AddDrive(rock, SceneKey(key, params().scenes_per_run, scene), sums);
    }
    return sums;
  }

  // Drives from first_scan_m before the rock until the front reaches it.
  void AddDrive(const RockCell& rock, core::TrialKey key, std::vector<double>& sums) const {
    const RockScene drawn = DrawScene(rock, key);
    RandomStream phase(key, Purpose::kScenePhase);
    const double interval_m = params().scan_interval_m;
    const double last_gap_m = interval_m * phase.Uniform();
    const auto poses = 1 + static_cast<std::int64_t>(
                               std::floor((params().first_scan_m - last_gap_m) / interval_m));
    std::int64_t scans = 0;
    bool single = false;
    bool believed = false;
    for (std::int64_t pose = 0; pose < poses && !(single && believed); ++pose) {
      const double gap_m = last_gap_m + static_cast<double>(poses - 1 - pose) * interval_m;
      // Scans of a drive are numbered one after the other, as in the closed loop: what a point
      // keeps from scan to scan passes from pose to pose. So later noise, and the record, depend on
      // earlier rescans.
      const Percept percept = LookAt(drawn.terrain, Pose(gap_m, drawn.heading_rad), key, scans);
      scans += percept.scans;
      single |=
          Any(percept.first.missing) || Any(percept.first.neighbour) || Any(percept.first.range);
      believed |= Any(percept.believed);
    }
    sums[0] += 1.0;
    sums[1] += static_cast<double>(scans);
    sums[2] += Flag(single);
    sums[3] += Flag(believed);
  }
};

}  // namespace

std::unique_ptr<Experiment> MakeDetectionStudy(const HazardDetectionParams& params,
                                               const trial::DriveParams& drive,
                                               const trial::ScanWatcher& watcher) {
  return std::make_unique<DetectionStudy>(params, drive, watcher);
}

std::unique_ptr<Experiment> MakeApproachStudy(const HazardDetectionParams& params,
                                              const trial::DriveParams& drive,
                                              const trial::ScanWatcher& watcher) {
  return std::make_unique<ApproachStudy>(params, drive, watcher);
}

}  // namespace rockyard::experiments

// Studies "false_alarm", flat sand without rocks, and "missed", hazards on straight drives through
// random fields.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/random.h"
#include "experiments/cell_experiment.h"
#include "experiments/hazard_detection/hazard_detection.h"
#include "experiments/hazard_detection/hazard_judge.h"
#include "perception/hazard_detector.h"
#include "terrain/blind_swath.h"
#include "terrain/field.h"
#include "terrain/terrain.h"
#include "trial/course/layout.h"

namespace rockyard::experiments {
namespace {

// Returns the drive of one cell of the study "false_alarm".
trial::DriveParams WithFactors(trial::DriveParams drive, const CellTable& table, std::size_t cell) {
  const std::vector<std::string_view> columns = table.columns();
  const std::vector<double> values = table.Values(cell);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    sensing::LightStripeParams& sensor = drive.sensors.light_stripe;
    if (columns[i] == "wrong_place_probability") {
      sensor.wrong_place_probability = values[i];
    } else if (columns[i] == "outlier_persistence") {
      sensor.outlier_persistence = values[i];
    } else if (columns[i] == "laser_power_w") {
      sensor.laser.input_power_w = values[i];
    } else if (columns[i] == "sun_elevation_deg") {
      drive.sensors.sun.elevation_rad = math::DegToRad(values[i]);
    }
  }
  return drive;
}

// The study "false_alarm".
class AlarmStudy final : public CellExperiment {
 public:
  AlarmStudy(const HazardDetectionParams& params, const trial::DriveParams& drive,
             const trial::ScanWatcher& watcher)
      : CellExperiment(params.Factors(), HazardColumns(),
                       {"scenes", "scans", "alarm_single", "alarm_pair", "alarm_believed"}),
        scenes_(params.scenes_per_run) {
    for (std::size_t cell = 0; cell < table().size(); ++cell) {
      judges_.emplace_back(WithFactors(drive, table(), cell), watcher);
    }
  }

 private:
  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override {
    const HazardJudge& judge = judges_[cell];
    std::vector<double> sums(5, 0.0);
    for (std::int64_t scene = 0; scene < scenes_; ++scene) {
      AddScene(judge, SceneKey(key, scenes_, scene), sums);
    }
    return sums;
  }

  void AddScene(const HazardJudge& judge, core::TrialKey key, std::vector<double>& sums) const {
    const math::Transform X_WR = math::Transform::Identity();
    const messages::ElevationScan first = judge.Scan(sand_, X_WR, key, 0);
    sums[0] += 1.0;
    if (!perception::ReportHazards(first, judge.hazard()).any()) {
      sums[1] += 1.0;
      return;
    }
    const messages::ElevationScan second = judge.Scan(sand_, X_WR, key, 1);
    // Look takes the same scans again: equal numbers have equal noise.
    const Percept percept = judge.Look(sand_, X_WR, key, 0);
    sums[1] += static_cast<double>(percept.scans);
    sums[2] += 1.0;
    if (perception::ReportHazards(second, judge.hazard()).any() &&
        perception::ScansAgree(first, second, judge.hazard().agree_m)) {
      sums[3] += 1.0;
    }
    if (Any(percept.believed)) sums[4] += 1.0;
  }

  std::int64_t scenes_;
  std::vector<HazardJudge> judges_;
  terrain::Terrain sand_{terrain::Ground(), {}, {}};
};

}  // namespace

std::unique_ptr<Experiment> MakeAlarmStudy(const HazardDetectionParams& params,
                                           const trial::DriveParams& drive,
                                           const trial::ScanWatcher& watcher) {
  return std::make_unique<AlarmStudy>(params, drive, watcher);
}

namespace {

using math::Vector3;
using trial::DriveParams;

// A rock in the way.
struct Hazard {
  double contact_x_m;        // of the rover's front
  terrain::Terrain without;  // the field without this rock
  terrain::Terrain alone;    // this rock on bare sand
  bool seen_single = false;
  bool seen_double = false;
};

// The study "missed".
class FieldStudy final : public CellExperiment {
 public:
  FieldStudy(const HazardDetectionParams& params, const trial::DriveParams& drive,
             const trial::ScanWatcher& watcher)
      : CellExperiment(params.Factors(), HazardColumns(),
                       {"scenes", "path_m", "hazards", "missed_single", "missed"}),
        drive_(drive),
        params_(params),
        judge_(drive, watcher),
        bare_judge_(drive) {}

 private:
  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override {
    terrain::TerrainParams terrain = drive_.terrain;
    terrain.rocks.k_per_m2 = table().Values(cell)[0];
    std::vector<double> sums(5, 0.0);
    for (std::int64_t scene = 0; scene < params_.scenes_per_run; ++scene) {
      AddDrive(terrain, SceneKey(key, params_.scenes_per_run, scene), sums);
    }
    return sums;
  }

  void AddDrive(const terrain::TerrainParams& terrain, core::TrialKey key,
                std::vector<double>& sums) const {
    const trial::CourseParams& course = drive_.course;
    const terrain::Field field = terrain::BuildField(terrain, key, trial::TerrainCourse(course));
    std::vector<Hazard> hazards = HazardsIn(field.terrain);
    core::RandomStream phase(key, core::Purpose::kScenePhase);
    const double start_x_m = course.start_x_m + params_.scan_interval_m * phase.Uniform();
    const auto poses = static_cast<std::int64_t>(
        std::floor((course.goal_x_m - start_x_m) / params_.scan_interval_m));
    // Scans are numbered one after the other, as in the closed loop: what a point keeps from scan
    // to scan passes from pose to pose. Records depend on the numbers: a pose with nothing to see
    // counts as the one scan that it takes without an alarm.
    std::int64_t scan_number = 0;
    for (std::int64_t pose = 0; pose <= poses; ++pose) {
      const double x_m = start_x_m + static_cast<double>(pose) * params_.scan_interval_m;
      scan_number +=
          Needed(hazards, x_m) ? LookFrom(x_m, field.terrain, key, scan_number, hazards) : 1;
    }
    sums[0] += 1.0;
    sums[1] += course.goal_x_m - course.start_x_m - Unseen_m();
    sums[2] += static_cast<double>(hazards.size());
    for (const Hazard& hazard : hazards) {
      sums[3] += hazard.seen_single ? 0.0 : 1.0;
      sums[4] += hazard.seen_double ? 0.0 : 1.0;
    }
  }

  // Returns the way at the start on which a hazard would be met before it could be scanned from
  // first_scan_m on.
  double Unseen_m() const { return params_.first_scan_m + params_.scan_interval_m; }

  double front_m() const { return drive_.sensors.light_stripe.front_x_m; }

  // Returns the hazards: rocks that are high enough, whose outline meets the path swept by the
  // rover, far enough from the start to be scanned from first_scan_m on, and met before the goal.
  std::vector<Hazard> HazardsIn(const terrain::Terrain& field) const {
    const trial::CourseParams& course = drive_.course;
    const double half_m = 0.5 * drive_.rover.geometry.width_m;
    std::vector<Hazard> hazards;
    for (const terrain::Rock& rock : field.rocks()) {
      if (rock.height_m < params_.hazard_height_m) continue;
      const auto contact_x_m = terrain::FirstContact(rock, course.start_y_m, half_m);
      if (!contact_x_m) continue;
      const double driven_m = *contact_x_m - front_m() - course.start_x_m;
      if (driven_m < Unseen_m()) continue;
      if (driven_m > course.goal_x_m - course.start_x_m) continue;
      hazards.push_back({*contact_x_m, Without(field, rock), {terrain::Ground(), {rock}, {}}});
    }
    return hazards;
  }

  static terrain::Terrain Without(const terrain::Terrain& field, const terrain::Rock& rock) {
    std::vector<terrain::Rock> others;
    for (const terrain::Rock& other : field.rocks()) {
      if (&other != &rock) others.push_back(other);
    }
    const auto walls = field.walls();
    return {field.ground(), std::move(others), {walls.begin(), walls.end()}};
  }

  bool Near(const Hazard& hazard, double x_m) const {
    const double gap_m = hazard.contact_x_m - front_m() - x_m;
    return gap_m >= 0.0 && gap_m <= params_.first_scan_m;
  }

  bool Needed(const std::vector<Hazard>& hazards, double x_m) const {
    return std::any_of(hazards.begin(), hazards.end(), [&](const Hazard& hazard) {
      return Near(hazard, x_m) && !(hazard.seen_single && hazard.seen_double);
    });
  }

  // Returns whether a stripe that is charged is charged for a rock, all noise being the same:
  // without the rock it would not be, or the rock alone on bare sand charges it, which bare sand
  // does not.
  static bool IsDueTo(bool without, bool alone, bool sand) { return !without || (alone && !sand); }

  // Looks from x_m along the course and notes which hazards are seen. Returns the number of scans.
  std::int64_t LookFrom(double x_m, const terrain::Terrain& field, core::TrialKey key,
                        std::int64_t first_scan, std::vector<Hazard>& hazards) const {
    math::Transform X_WR = math::Transform::Identity();
    X_WR.translation() = Vector3(x_m, drive_.course.start_y_m, 0.0);
    const Percept seen = judge_.Look(field, X_WR, key, first_scan);
    const Percept sand = bare_judge_.Look(sand_, X_WR, key, first_scan);
    for (Hazard& hazard : hazards) {
      if (!Near(hazard, x_m) || (hazard.seen_single && hazard.seen_double)) continue;
      const Percept without = bare_judge_.Look(hazard.without, X_WR, key, first_scan);
      const Percept alone = bare_judge_.Look(hazard.alone, X_WR, key, first_scan);
      for (std::size_t stripe = 0; stripe < judge_.stripes(); ++stripe) {
        hazard.seen_single |= seen.first.Charges(stripe) &&
                              IsDueTo(without.first.Charges(stripe), alone.first.Charges(stripe),
                                      sand.first.Charges(stripe));
        hazard.seen_double |=
            seen.believed[stripe] &&
            IsDueTo(without.believed[stripe], alone.believed[stripe], sand.believed[stripe]);
      }
    }
    return seen.scans;
  }

  DriveParams drive_;
  HazardDetectionParams params_;
  HazardJudge judge_;
  HazardJudge bare_judge_;
  terrain::Terrain sand_{terrain::Ground(), {}, {}};
};

}  // namespace

std::unique_ptr<Experiment> MakeMissedStudy(const HazardDetectionParams& params,
                                            const trial::DriveParams& drive,
                                            const trial::ScanWatcher& watcher) {
  return std::make_unique<FieldStudy>(params, drive, watcher);
}

}  // namespace rockyard::experiments

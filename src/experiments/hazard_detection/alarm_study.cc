// Study "false_alarm": flat sand, no rock.
#include <cstdint>

#include "experiments/cell_table.h"
#include "experiments/hazard_detection/hazard_judge.h"
#include "experiments/hazard_detection/hazard_study.h"
#include "experiments/record_of.h"
#include "perception/hazard_detector.h"

namespace rockyard::experiments {
namespace {

// The drive of one cell.
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

class AlarmStudy final : public HazardStudyRunner {
 public:
  AlarmStudy(const HazardDetectionParams& params, const trial::DriveParams& drive,
             const trial::ScanWatcher& watcher)
      : scenes_(params.scenes_per_run) {
    const CellTable table(params.Factors());
    for (std::size_t cell = 0; cell < table.size(); ++cell) {
      judges_.emplace_back(WithFactors(drive, table, cell), watcher);
    }
  }

  std::vector<std::string_view> columns() const override {
    return {"scenes", "scans", "alarm_single", "alarm_pair", "alarm_believed"};
  }

  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override {
    const HazardJudge& judge = judges_[cell];
    std::vector<double> sums(5, 0.0);
    for (std::int64_t scene = 0; scene < scenes_; ++scene) {
      AddScene(judge, SceneKey(key, scenes_, scene), sums);
    }
    return sums;
  }

 private:
  void AddScene(const HazardJudge& judge, core::TrialKey key, std::vector<double>& sums) const {
    const math::Transform X_WR = math::Transform::Identity();
    const messages::ElevationScan first = judge.Scan(sand_, X_WR, key, 0);
    sums[0] += 1.0;
    if (!perception::ReportHazards(first, judge.hazard()).any()) {
      sums[1] += 1.0;
      return;
    }
    const messages::ElevationScan second = judge.Scan(sand_, X_WR, key, 1);
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

std::unique_ptr<HazardStudyRunner> MakeAlarmStudy(const HazardDetectionParams& params,
                                                  const trial::DriveParams& drive,
                                                  const trial::ScanWatcher& watcher) {
  return std::make_unique<AlarmStudy>(params, drive, watcher);
}

}  // namespace rockyard::experiments

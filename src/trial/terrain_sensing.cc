#include "trial/terrain_sensing.h"

namespace rockyard::trial {

using messages::LookDirection;

TerrainSensing::TerrainSensing(const DriveParams& drive, core::TrialKey key,
                               const Watchers& watchers)
    : kind_(drive.sensors.terrain_sensors.chosen()),
      reads_points_(drive.navigation.navigators.chosen().traits().reads ==
                    navigation::LookReading::kPoints),
      sensor_(kind_.Make(drive, key, watchers)),
      hazard_detector_(drive.perception.hazard),
      look_time_(MakeLookTime(drive)) {}

Percept TerrainSensing::Look(LookDirection direction, const terrain::Terrain& terrain,
                             const math::Transform& X_WR,
                             const messages::AttitudeEstimate& attitude) {
  if (looks_again_) ++rescans_;
  const bool behind = direction == LookDirection::kBehind;
  const TerrainLook look{terrain, X_WR, direction, attitude, looks_};
  if (behind && !sensor_->LooksBehind()) {
    return {.cloud = messages::PointCloud{looks_, direction, {}}};
  }
  ++looks_;
  if (behind) ++looks_behind_;
  if (reads_points_) return {.time = look_time_, .cloud = sensor_->Points(look)};
  return Judge(sensor_->Elevations(look));
}

Percept TerrainSensing::Judge(const messages::ElevationScan& elevations) {
  const perception::HazardDetector::Verdict verdict = hazard_detector_.Process(elevations);
  looks_again_ = verdict.scan_again;
  return {.look_again = verdict.scan_again, .time = look_time_, .report = verdict.report};
}

}  // namespace rockyard::trial

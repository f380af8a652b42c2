#include "trial/terrain_sensing.h"

#include <utility>

#include "perception/cloud_elevations.h"
#include "trial/onboard_calibration.h"

namespace rockyard::trial {

using messages::LookDirection;

TerrainSensing::TerrainSensing(const DriveParams& drive, core::TrialKey key, ScanWatcher watcher)
    : key_(key),
      reads_points_(*drive.navigation.navigators.chosen().traits().reads ==
                    navigation::LookReading::kPoints),
      scanner_(drive, std::move(watcher)),
      triangulator_(
          OnboardStripeCalibration(drive.sensors.light_stripe, drive.perception.calibration)),
      cloud_elevations_(drive.perception.cloud_elevations),
      hazard_detector_(drive.perception.hazard),
      look_time_(MakeLookTime(drive)) {
  if (drive.sensors.terrain_sensor == TerrainSensor::kStereo) {
    const sensing::StereoParams& sensor = drive.sensors.stereo;
    const perception::CalibrationErrorParams& errors = drive.perception.calibration;
    stereo_.emplace(sensor);
    misplaced_ahead_ = StereoMisplacement(sensor, errors, LookDirection::kAhead);
    misplaced_behind_ = StereoMisplacement(sensor, errors, LookDirection::kBehind);
  }
}

Percept TerrainSensing::Look(LookDirection direction, const terrain::Terrain& terrain,
                             const math::Transform& X_WR,
                             const messages::AttitudeEstimate& attitude) {
  if (looks_again_) ++rescans_;
  Percept percept =
      stereo_ ? TakeImages(direction, terrain, X_WR, attitude) : Scan(direction, terrain, X_WR);
  looks_again_ = percept.look_again;
  return percept;
}

Percept TerrainSensing::Scan(LookDirection direction, const terrain::Terrain& terrain,
                             const math::Transform& X_WR) {
  if (direction == LookDirection::kBehind) {
    return {.cloud = messages::PointCloud{scans_, direction, {}}};
  }
  const messages::StripeScan scan = scanner_.Scan(terrain, X_WR, key_, scans_);
  ++scans_;
  if (reads_points_)
    return {.time = look_time_, .cloud = perception::StripeCloud(scan, triangulator_)};
  return Judge(triangulator_.Elevations(scan));
}

Percept TerrainSensing::TakeImages(LookDirection direction, const terrain::Terrain& terrain,
                                   const math::Transform& X_WR,
                                   const messages::AttitudeEstimate& attitude) {
  messages::PointCloud cloud = stereo_->Look(terrain, X_WR, key_, image_sets_, direction);
  const auto& misplaced = direction == LookDirection::kAhead ? misplaced_ahead_ : misplaced_behind_;
  if (misplaced) {
    for (math::Vector3& p_RoP_R : cloud.points_R) p_RoP_R = *misplaced * p_RoP_R;
  }
  ++image_sets_;
  if (direction == LookDirection::kBehind) ++rear_image_sets_;
  if (reads_points_) return {.time = look_time_, .cloud = std::move(cloud)};
  return Judge(perception::CloudElevations(cloud, attitude, cloud_elevations_));
}

Percept TerrainSensing::Judge(const messages::ElevationScan& elevations) {
  const perception::HazardDetector::Verdict verdict = hazard_detector_.Process(elevations);
  return {.look_again = verdict.scan_again, .time = look_time_, .report = verdict.report};
}

}  // namespace rockyard::trial

// How a rover of a trial looks at the terrain: whichever sensor it has, and what on-board
// perception makes of it for its navigator.
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "math/pose.h"
#include "messages/estimates.h"
#include "messages/point_cloud.h"
#include "perception/cloud_params.h"
#include "perception/hazard_detector.h"
#include "perception/triangulation.h"
#include "sensing/stereo_sensor.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"
#include "trial/hazard_scanner.h"
#include "trial/look_time.h"
#include "trial/scan_watcher.h"

namespace rockyard::trial {

// What one look shows: a report or points, as the navigator reads them.
struct Percept {
  bool look_again = false;  // undecided: another look at this pose has to follow
  LookTime time = {};       // that the look took
  std::optional<messages::HazardReport> report = {};
  std::optional<messages::PointCloud> cloud = {};
};

// The four pairs of sensor and navigator:
//   light stripe, behaviour controller: elevations, hazard criteria, two-scan rule;
//   stereo, behaviour controller: the highest points of a cloud as elevations, then the same;
//   stereo, map: the cloud;
//   light stripe, map: the triangulated points as a cloud; nothing is seen behind, at no cost.
class TerrainSensing {
 public:
  TerrainSensing(const DriveParams& drive, core::TrialKey key, ScanWatcher watcher);

  // The rover has stopped at a new pose.
  void Begin() { hazard_detector_.Reset(); }

  // Looks from X_WR; `attitude` is how the rover believes to stand. Noise is indexed by the number
  // of the look, counted over the trial.
  Percept Look(messages::LookDirection direction, const terrain::Terrain& terrain,
               const math::Transform& X_WR, const messages::AttitudeEstimate& attitude);

  std::int64_t scans() const { return scans_; }      // with the light stripe
  std::int64_t rescans() const { return rescans_; }  // looks again at one pose, of either sensor
  std::int64_t image_sets() const { return image_sets_; }
  std::int64_t rear_image_sets() const { return rear_image_sets_; }
  const LookTime& look_time() const { return look_time_; }

 private:
  Percept Scan(messages::LookDirection direction, const terrain::Terrain& terrain,
               const math::Transform& X_WR);
  Percept TakeImages(messages::LookDirection direction, const terrain::Terrain& terrain,
                     const math::Transform& X_WR, const messages::AttitudeEstimate& attitude);
  Percept Judge(const messages::ElevationScan& elevations);

  core::TrialKey key_;
  bool reads_points_;  // the navigator
  HazardScanner scanner_;
  std::optional<sensing::StereoSensor> stereo_;
  // Of the points that it sees, by a wrong calibration; none where it is right.
  std::optional<math::Transform> misplaced_ahead_;
  std::optional<math::Transform> misplaced_behind_;
  perception::Triangulator triangulator_;
  perception::CloudElevationParams cloud_elevations_;
  perception::HazardDetector hazard_detector_;
  LookTime look_time_;

  bool looks_again_ = false;
  std::int64_t scans_ = 0;
  std::int64_t rescans_ = 0;
  std::int64_t image_sets_ = 0;
  std::int64_t rear_image_sets_ = 0;
};

}  // namespace rockyard::trial

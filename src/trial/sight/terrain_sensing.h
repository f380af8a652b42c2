// What a rover asks of its terrain sensor, and what on-board perception makes of the answer for the
// navigator. Onboard keeps it; Drive orders looks by it. Records depend on the numbers of looks,
// which name their noise: a look in a direction in which the sensor has nothing takes no number, so
// that the next look has it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "messages/estimates.h"
#include "messages/look_images.h"
#include "messages/point_cloud.h"
#include "perception/hazard_detector.h"
#include "trial/clock/compute_profile.h"
#include "trial/drive_params.h"
#include "trial/sight/look.h"

namespace rockyard::trial {

// What one look shows: a report or points, and images, as the navigator reads them.
struct Percept {
  bool look_again = false;  // undecided: another look at this pose has to follow
  LookTime time = {};       // what the look took
  std::optional<messages::HazardReport> report = {};
  std::optional<messages::PointCloud> cloud = {};
  std::optional<messages::LookImages> images = {};
};

// The four pairs of sensor and navigator:
//   light stripe, behaviour controller: elevations, hazard criteria, two-scan rule;
//   stereo, behaviour controller: the highest points of a cloud as elevations, then the same;
//   stereo, map: the cloud;
//   light stripe, map: the triangulated points as a cloud; nothing is seen behind, at no cost.
// A navigator that asks for images gets those of stereo beside it; one that reads images alone gets
// nothing else, and nothing is made of them.
class TerrainSensing {
 public:
  // `watchers` are shown what its sensor's reader makes of a look.
  explicit TerrainSensing(const DriveParams& drive, const SightWatchers& watchers = {});

  // Begins looks from a new pose.
  void Begin() { hazard_detector_.Reset(); }

  // Returns the order of the next look, by a rover that believes to stand so.
  LookOrder Order(messages::LookDirection direction, const messages::AttitudeEstimate& attitude);
  // Takes what came of the look, and returns what it shows.
  Percept Take(const LookOrder& order, const LookData& data);

  std::int64_t looks() const { return looks_; }  // so far: the number of the next one
  // Return counts of looks, which are scans or sets of images by the kind of the sensor.
  std::int64_t scans() const { return takes_image_sets_ ? 0 : looks_; }
  std::int64_t rescans() const { return rescans_; }  // looks again at one pose, of any sensor
  std::int64_t image_sets() const { return takes_image_sets_ ? looks_ : 0; }
  std::int64_t rear_image_sets() const { return takes_image_sets_ ? looks_behind_ : 0; }
  const LookTime& look_time() const { return look_time_; }

  // Returns whether a look can be taken from a rover on the move: images of one moment, for points.
  // A light stripe scan takes time, and a hazard report may ask for a second look from one pose.
  bool LooksOnTheMove() const {
    return (reads_points_ || reads_images_alone_) && look_time_.scanning_s == 0.0;
  }

 private:
  // Returns the report or the points of a look.
  Percept Read(const LookOrder& order, const LookData& data);
  Percept Judge(const messages::ElevationScan& elevations);

  bool takes_image_sets_;  // whether looks are sets of images, not scans
  bool reads_points_;      // whether the navigator reads points, not reports
  bool wants_images_;
  bool reads_images_alone_;
  std::unique_ptr<TerrainReader> reader_;
  perception::HazardDetector hazard_detector_;
  LookTime look_time_;

  bool looks_again_ = false;
  std::int64_t looks_ = 0;
  std::int64_t looks_behind_ = 0;
  std::int64_t rescans_ = 0;
};

}  // namespace rockyard::trial

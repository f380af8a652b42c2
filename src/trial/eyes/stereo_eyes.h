// The stereo cameras of a rover as the closed loop uses them: a pose in, points out.
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "math/pose.h"
#include "messages/point_cloud.h"
#include "perception/stereo_points.h"
#include "sensing/stereo_imager.h"
#include "sensing/stereo_sensor.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"
#include "trial/watchers.h"

namespace rockyard::trial {

// What one look shows, pixel by pixel and as points.
struct StereoSeen {
  sensing::DepthImage disparities_px;  // of the reduced left image; 0 where there is no match
  messages::PointCloud cloud;          // of those pixels, as far as they are wanted and in range
};

// One interface for all fidelities (sensors.stereo.fidelity): `ideal` and `error_model` are
// sensing::StereoSensor, rays and what matching would make of them; `image` is
// sensing::StereoImager, cameras down to digital numbers, with perception::StereoPoints, which
// matches the images with the cameras that the rover believes to have.
class StereoEyes {
 public:
  // The watcher is called after every look that has images; it has no influence on it.
  StereoEyes(const DriveParams& drive, core::TrialKey key, StereoWatcher watcher = {});

  // What the rover makes of one look at X_WR, with the calibration that it has. Pure function of
  // its arguments, whatever was looked at before. `look_number` counts every look of the trial from
  // 0 and indexes the noise. Cost: 0.2 to 0.3 ms, or some 0.3 s with images of 512 x 512 pixels.
  StereoSeen See(const terrain::Terrain& terrain, const math::Transform& X_WR,
                 std::int64_t look_number, messages::LookDirection direction) const;
  // Returns its points alone.
  messages::PointCloud Look(const terrain::Terrain& terrain, const math::Transform& X_WR,
                            std::int64_t look_number, messages::LookDirection direction) const {
    return See(terrain, X_WR, look_number, direction).cloud;
  }

 private:
  struct Cameras {
    sensing::StereoImager imager;
    perception::StereoPoints ahead;
    perception::StereoPoints behind;
  };

  Cameras MakeCameras(const DriveParams& drive) const;
  StereoSeen Match(const terrain::Terrain& terrain, const math::Transform& X_WR,
                   std::int64_t look_number, messages::LookDirection direction) const;
  // Where a wrong calibration moves what is seen, in R; none where it is right.
  const std::optional<math::Transform>& Misplaced(messages::LookDirection direction) const {
    return direction == messages::LookDirection::kAhead ? misplaced_ahead_ : misplaced_behind_;
  }
  void Misplace(messages::PointCloud& cloud) const;
  void Show(const math::Transform& X_WR, const perception::StereoSight& sight,
            const perception::StereoPoints& eyes, const messages::PointCloud& cloud) const;

  sensing::StereoParams params_;
  core::TrialKey key_;
  StereoWatcher watcher_;
  std::optional<math::Transform> misplaced_ahead_;
  std::optional<math::Transform> misplaced_behind_;
  // One of both.
  std::optional<sensing::StereoSensor> rays_;
  std::optional<Cameras> cameras_;
};

}  // namespace rockyard::trial

// On-board perception of stereo cameras: from images, or from what matching would make of them, to
// points and elevations. Drives read their looks with it, and so does the experiment that measures
// stereo.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "math/pose.h"
#include "messages/point_cloud.h"
#include "perception/cloud_elevations.h"
#include "perception/point_reader.h"
#include "perception/stereo_points.h"
#include "sensing/stereo_view.h"
#include "trial/drive_params.h"
#include "trial/sight/look.h"
#include "trial/sight/onboard_calibration.h"

namespace rockyard::trial {

// What one look shows, pixel by pixel and as points.
struct StereoSeen {
  sensing::DepthImage disparities_px;  // of the reduced left image; 0 where there is no match
  messages::PointCloud cloud;          // of matched pixels that are wanted (sensing::IsWanted)
};

// Reads the looks of stereo cameras of any fidelity. Images are matched by
// perception::StereoPoints. Points come out where the calibrated cameras see them
// (sensing::CalibratedRig, MakeStereoView); a wrong mount (perception.calibration) then moves them
// rigidly, whatever the fidelity. Another reader that the scenario chooses (perception.reader) gets
// the images in place of StereoPoints, with the cameras where they are believed, and its points are
// handed on as they come.
class StereoReader final : public TerrainReader {
 public:
  // The watcher is shown every look whose images are matched by StereoPoints.
  explicit StereoReader(const DriveParams& drive,
                        std::function<void(const StereoSightView&)> watcher = {});

  // Requires rockyard's own stereo where there are images.
  StereoSeen See(const LookOrder& order, const LookData& data) const;

  messages::PointCloud Points(const LookOrder& order, const LookData& data) const override;
  // Returns the highest points of the cloud as elevations.
  messages::ElevationScan Elevations(const LookOrder& order, const LookData& data) const override {
    return perception::CloudElevations(Points(order, data), order.attitude, elevations_);
  }
  std::optional<messages::LookImages> Images(const LookOrder& order,
                                             const LookData& data) const override;

 private:
  // One of the two pairs of cameras, as the rover believes that it is mounted.
  struct Pair {
    Pair(const DriveParams& drive, messages::LookDirection direction);

    void Misplace(messages::PointCloud& cloud) const;

    sensing::StereoView view_R;                     // reduced
    BelievedCameras cameras;                        // that take images
    std::optional<perception::StereoPoints> match;  // of images
    std::optional<math::Transform> misplaced;       // in R; none where the mount is right
  };

  const Pair& PairOf(messages::LookDirection direction) const {
    return direction == messages::LookDirection::kAhead ? ahead_ : behind_;
  }
  messages::PointCloud Read(const LookOrder& order, const LookData& data) const;
  StereoSeen Match(const LookOrder& order, const sensing::StereoImages& images) const;
  void Show(const Pair& pair, const perception::StereoSight& sight,
            const messages::PointCloud& cloud) const;

  sensing::StereoParams params_;
  perception::CloudElevationParams elevations_;
  std::unique_ptr<perception::PointReader> reader_;  // of images; null: StereoPoints
  Pair ahead_;
  Pair behind_;
  std::function<void(const StereoSightView&)> watcher_;
};

}  // namespace rockyard::trial

// On-board perception of the light stripe sensor: from a scan or images to elevations and points.
// What in them is a hazard is decided by perception::HazardDetector.
#pragma once

#include <functional>
#include <optional>

#include "perception/stripe_finder.h"
#include "perception/triangulation.h"
#include "trial/drive_params.h"
#include "trial/eyes/look.h"

namespace rockyard::trial {

// Finder and triangulation go by one calibration, the one that the rover believes.
class StripeReader final : public TerrainReader {
 public:
  // The watcher is shown every scan that is read.
  explicit StripeReader(const DriveParams& drive,
                        std::function<void(const messages::StripeScan&)> watcher = {});

  // The columns in which stripes are found: those of the geometric sensor, or of the images.
  messages::StripeScan ScanOf(const LookData& data) const;

  messages::ElevationScan Elevations(const LookOrder& order, const LookData& data) const override;
  messages::PointCloud Points(const LookOrder& order, const LookData& data) const override;

 private:
  perception::Triangulator triangulator_;
  std::optional<perception::StripeFinder> finder_;  // of images
  std::function<void(const messages::StripeScan&)> watcher_;
};

}  // namespace rockyard::trial

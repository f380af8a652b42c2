// On-board perception of the light stripe sensor: from a scan or images to elevations and points.
// Drives read their looks with it, and HazardScanner for studies; perception::HazardDetector
// decides which elevations are a hazard.
#pragma once

#include <functional>
#include <optional>

#include "perception/stripe_finder.h"
#include "perception/triangulation.h"
#include "trial/drive_params.h"
#include "trial/sight/look.h"

namespace rockyard::trial {

// Reads the looks of the light stripe sensor. Must stay: finder and triangulation go by the same
// calibration, which the rover believes.
class StripeReader final : public TerrainReader {
 public:
  // The watcher is shown every scan that is read.
  explicit StripeReader(const DriveParams& drive,
                        std::function<void(const messages::StripeScan&)> watcher = {});

  // Returns the columns in which stripes are found: as the geometric sensor gives them, or as the
  // finder finds them in images.
  messages::StripeScan ScanOf(const LookData& data) const;

  messages::ElevationScan Elevations(const LookOrder& order, const LookData& data) const override;
  messages::PointCloud Points(const LookOrder& order, const LookData& data) const override;

 private:
  perception::Triangulator triangulator_;
  std::optional<perception::StripeFinder> finder_;  // of images
  std::function<void(const messages::StripeScan&)> watcher_;
};

}  // namespace rockyard::trial

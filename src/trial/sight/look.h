// One look at the ground, between the two sides of a drive: what the rover orders, what leaves the
// world, and how on-board code reads it. Sensors, their readers and TerrainSensing pass these on.
// Must stay: nothing here tells where the rover truly is.
//
// Words: a *look* is what a terrain sensor takes at one moment, a scan of the light stripe or a
// pair of stereo images, ahead or behind.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <variant>

#include "messages/estimates.h"
#include "messages/look_images.h"
#include "messages/measurements.h"
#include "messages/point_cloud.h"
#include "messages/stripe_images.h"
#include "perception/stereo_points.h"
#include "sensing/stereo_rig.h"
#include "sensing/stereo_view.h"

namespace rockyard::trial {

// The look that the rover asks for.
struct LookOrder {
  messages::LookDirection direction = messages::LookDirection::kAhead;
  messages::AttitudeEstimate attitude = {};  // how the rover believes to stand
  std::int64_t number = 0;  // counts the looks of the trial from 0 and indexes the noise
  bool points = false;      // whether points are wanted; else elevations
};

// What stereo matching would make of images that nobody took (sensing::StereoSensor).
struct ModelledStereo {
  sensing::DepthImage inverse_depths;  // one over the depth of every pixel, 1/m
};

// What a terrain sensor measured; nothing where it does not look in that direction. A sensor
// delivers one kind of data, and its reader takes that kind.
using LookData = std::variant<std::monostate, messages::StripeScan, messages::StripeImages,
                              messages::PointCloud, ModelledStereo, sensing::StereoImages>;

// Stereo images as they were matched, and what came of them. Valid during the call only.
struct StereoSightView {
  const perception::StereoSight& sight;
  const vision::RectifiedPair& pair;  // aligned and reduced, in R as the rover's calibration has it
  const vision::StereoPipelineParams& matching;
  const messages::PointCloud& cloud;  // what the navigator gets, or elevations are taken from
};

// Who is shown what on-board code makes of a look; the truth is added by WithTruth
// (drive/drive_observer.h). Watchers change nothing.
struct SightWatchers {
  std::function<void(const messages::StripeScan&)> scan = {};
  std::function<void(const StereoSightView&)> stereo = {};
};

// On-board perception of one terrain sensor.
class TerrainReader {
 public:
  virtual ~TerrainReader() = default;

  // Return what the rover makes of a look: elevations of the array by which hazards are judged, or
  // points. They are pure functions of their arguments. `data` comes from the reader's own sensor
  // and holds something.
  virtual messages::ElevationScan Elevations(const LookOrder& order,
                                             const LookData& data) const = 0;
  virtual messages::PointCloud Points(const LookOrder& order, const LookData& data) const = 0;
  // Returns the images of a look as a navigator gets them; nothing where no cameras took any.
  virtual std::optional<messages::LookImages> Images(const LookOrder& /*order*/,
                                                     const LookData& /*data*/) const {
    return std::nullopt;
  }
};

}  // namespace rockyard::trial

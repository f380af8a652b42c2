// One look at the ground, between the two sides of a drive: what the rover orders, what leaves the
// world, and how on-board code reads it. Nothing here tells where the rover truly is.
#pragma once

#include <cstdint>
#include <functional>
#include <variant>

#include "messages/estimates.h"
#include "messages/measurements.h"
#include "messages/point_cloud.h"
#include "messages/stripe_images.h"
#include "perception/stereo_points.h"
#include "sensing/stereo_rig.h"
#include "sensing/stereo_view.h"

namespace rockyard::trial {

// What the rover asks for.
struct LookOrder {
  messages::LookDirection direction = messages::LookDirection::kAhead;
  messages::AttitudeEstimate attitude = {};  // how it believes to stand
  std::int64_t number = 0;  // of all looks of the trial, from 0: it indexes the noise
  bool points = false;      // else elevations
};

// One over the depth of every pixel, 1/m: what stereo matching would make of images that nobody
// took (sensing::StereoSensor).
struct ModelledStereo {
  sensing::DepthImage inverse_depths;
};

// What a terrain sensor measured; nothing where it does not look in that direction. A sensor
// delivers one kind, and its reader takes that one.
using LookData = std::variant<std::monostate, messages::StripeScan, messages::StripeImages,
                              messages::PointCloud, ModelledStereo, sensing::StereoImages>;

// Images as they were matched, and what came of them. Valid during the call only.
struct StereoSightView {
  const perception::StereoSight& sight;
  const vision::RectifiedPair& pair;  // aligned and reduced, in R as the rover's calibration has it
  const vision::StereoPipelineParams& matching;
  const messages::PointCloud& cloud;  // what is handed on, with the look's number and direction
};

// Who is shown what on-board code makes of a look, on board: it changes nothing.
struct SightWatchers {
  std::function<void(const messages::StripeScan&)> scan = {};
  std::function<void(const StereoSightView&)> stereo = {};
};

// On-board perception of one terrain sensor.
class TerrainReader {
 public:
  virtual ~TerrainReader() = default;

  // What the rover makes of a look: elevations of the array that hazards are judged by, or points.
  // Pure functions of their arguments. `data` is that of its own sensor, and not nothing.
  virtual messages::ElevationScan Elevations(const LookOrder& order,
                                             const LookData& data) const = 0;
  virtual messages::PointCloud Points(const LookOrder& order, const LookData& data) const = 0;
};

}  // namespace rockyard::trial

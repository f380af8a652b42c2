// Looks over the shoulder of stereo cameras: for pictures of a look, never for decisions.
#pragma once

#include <cstdint>
#include <functional>

#include "math/pose.h"
#include "messages/point_cloud.h"
#include "perception/stereo_points.h"
#include "vision/cameras/rectification.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::trial {

// A look that was just rendered and matched (sensors.stereo.fidelity image; the other fidelities
// have no images and call nobody). Valid during the call only.
struct WatchedStereo {
  const math::Transform& X_WR;  // true
  const perception::StereoSight& sight;
  const vision::RectifiedPair& pair;  // aligned and reduced, in R as the rover's calibration has it
  const vision::StereoPipelineParams& matching;
  const messages::PointCloud& cloud;  // what is handed on, with the look's number and direction
};

using StereoWatcher = std::function<void(const WatchedStereo&)>;

}  // namespace rockyard::trial

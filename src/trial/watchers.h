// Whoever looks over the shoulder of a trial: for pictures and for tests. A trial is the same with
// any of them and without: they get references to const alone.
#pragma once

#include <cstdint>
#include <functional>

#include "core/random.h"
#include "math/pose.h"
#include "messages/measurements.h"
#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "perception/stereo_points.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"
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

// A scan that was just taken, and what it was taken of. Valid during the call only.
struct WatchedScan {
  const DriveParams& drive;  // of the sensor: a study may vary it from cell to cell
  const terrain::Terrain& terrain;
  const math::Transform& X_WR;
  core::TrialKey key;
  const messages::StripeScan& scan;
};

using ScanWatcher = std::function<void(const WatchedScan&)>;

// A decision that followed a look, and what was seen. Valid during the call only.
struct WatchedStep {
  const DriveParams& drive;
  const terrain::Terrain& terrain;
  const math::Transform& X_WR;  // true, where it looked
  core::TrialKey key;
  const messages::NavigationView& view;
  const messages::PointCloud& cloud;
  const messages::LookMoment& look;  // when, and where it believed to be then
};

using StepWatcher = std::function<void(const WatchedStep&)>;

struct Watchers {
  ScanWatcher scan = {};      // called after every scan of the light stripe
  StereoWatcher stereo = {};  // after every look of stereo cameras that has images
  StepWatcher step = {};      // after every decision of a map-based navigator that follows a look
};

}  // namespace rockyard::trial

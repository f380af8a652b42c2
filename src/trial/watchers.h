// Watchers look over the shoulder of a trial: pictures of looks, scans and decisions are made with
// them, and tests check with them. Must stay: a trial is the same with any watcher and without, so
// that watchers get references to const alone.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "core/random.h"
#include "math/pose.h"
#include "messages/estimates.h"
#include "messages/measurements.h"
#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "navigation/navigator_set_params.h"
#include "perception/stereo_points.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"
#include "vision/cameras/rectification.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::trial {

// A look of stereo cameras that was just rendered and matched (sensors.stereo.fidelity image; with
// the other fidelities no watcher is called). Valid during the call only.
struct WatchedStereo {
  const math::Transform& X_WR;  // true
  const perception::StereoSight& sight;
  const vision::RectifiedPair& pair;  // aligned and reduced, in R as the rover's calibration has it
  const vision::StereoPipelineParams& matching;
  const messages::PointCloud& cloud;  // what the navigator gets, or elevations are taken from
};

using StereoWatcher = std::function<void(const WatchedStereo&)>;

// A scan of the light stripe that was just taken, and what it was taken of. Valid during the call
// only.
struct WatchedScan {
  const DriveParams& drive;  // by which the sensor was made: studies vary it from cell to cell
  const terrain::Terrain& terrain;
  const math::Transform& X_WR;  // true
  core::TrialKey key;
  const messages::StripeScan& scan;
};

using ScanWatcher = std::function<void(const WatchedScan&)>;

// A decision of a map-based navigator that followed a look, and what was seen. Valid during the
// call only.
struct WatchedStep {
  const DriveParams& drive;
  const terrain::Terrain& terrain;
  const math::Transform& X_WR;  // true, where it looked
  core::TrialKey key;
  const messages::NavigationView& view;
  const messages::PointCloud& cloud;
  const messages::LookMoment& look;  // when it looked, and what it believed then
};

using StepWatcher = std::function<void(const WatchedStep&)>;

// What a navigator shows from a decision on. Valid during the call only.
struct WatchedOverlay {
  double time_s = 0.0;
  const math::Transform& X_WR;      // true
  messages::PoseEstimate believed;  // in the frame of the overlay, in which goals are told
  const messages::Overlay& overlay;
  // Why the navigator could not say what it shows; it is not asked again, and `overlay` is empty.
  std::string_view failure = {};
};

using OverlayWatcher = std::function<void(const WatchedOverlay&)>;

// The watchers of one trial; empty ones are not called.
struct Watchers {
  ScanWatcher scan = {};      // called after every scan of the light stripe
  StereoWatcher stereo = {};  // after every look of stereo cameras that has images
  StepWatcher step = {};      // after every decision of a map-based navigator that follows a look
  // After every decision from which on the navigator shows something else. Without this watcher no
  // navigator is asked what it shows.
  OverlayWatcher overlay = {};
  // After a drive with a plugin or process for a navigator: what that took.
  std::function<void(core::TrialKey, const messages::NavigatorUse&)> navigator_use = {};
  // Before anything else of a drive: what was shown before it is void. A drive begins twice where
  // the machine may be to blame for a fault of its navigator.
  std::function<void()> begin = {};
};

}  // namespace rockyard::trial

// Trackers: the overhead cameras that measured the "true" pose in the test arena (Matthies 1995,
// section 3), and the tracker on the rover that follows what it is to drive to. Results of drives
// report errors by the first; the world of a drive measures with the second. The estimator
// `perfect` takes the true pose from here. Ranges are horizontal. Records depend on the order of
// draws: systematic radius, direction, heading; of each sample x, y, heading.
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "math/functions.h"
#include "math/pose.h"
#include "messages/estimates.h"
#include "messages/measurements.h"
#include "sensing/tracker_params.h"
#include "truth/rover_state.h"

namespace rockyard::sensing {

// The overhead tracker. The paper bounds its systematic error and gives the root mean square of its
// random error. Model: the systematic error of a trial is constant, uniform in a disc of radius
// systematic_position and uniform within +-systematic_heading; each sample adds normal noise, with
// its position noise shared equally by x and y. In the arena the systematic error varies with
// place; over one drive it is taken as constant. Where the tracker is enabled, errors are reported
// against what it measures; nothing on board sees it.
class Tracker {
 public:
  Tracker(const TrackerParams& params, core::TrialKey key);

  // Returns what the tracker reports for the true pose. Noise is indexed by the sample number
  // (stream kTracker, substream sample + 1; substream 0 holds the systematic error).
  math::Pose2 Observe(const math::Pose2& truth, std::int64_t sample) const;

 private:
  TrackerParams params_;
  core::TrialKey key_;
  math::Pose2 bias_;
};

// Tracks a feature that the rover is to drive to: where the feature lies as seen from the rover,
// whatever the rover believes of its own pose. A measurement is the true bearing plus N(0,
// bearing_sd) and the true range times 1 + N(0, range_sd_fraction), never below 0. The true place
// decides whether the feature is seen. Limits: no rock stands in the way, the track is never lost
// nor taken up at another feature, and tracking takes neither time nor energy.
class FeatureTracker {
 public:
  FeatureTracker(const FeatureTrackerParams& params, core::TrialKey key)
      : params_(params), key_(key) {}

  // Returns how the rover at its true pose in W sees the feature at (x_m, y_m) in W; nothing beyond
  // the range or the field of view. Noise is indexed by the sample number, from 0 (stream
  // kFeatureTracker, substream sample; bearing first, then range).
  std::optional<messages::FeatureSighting> Observe(const math::Pose2& rover, double x_m, double y_m,
                                                   std::int64_t sample) const;

 private:
  FeatureTrackerParams params_;
  core::TrialKey key_;
};

// Returns the true pose as an operator's message.
inline messages::PoseUpdate TruePose(const truth::RoverState& state) {
  const math::Pose2 pose = math::ToPose2(state.X_WR);
  return {pose.x_m, pose.y_m, pose.heading_rad};
}

// Returns what the pose in the plane leaves out: the attitude by which math::MakePose gives back
// the orientation, and the height above the one at which the drive began.
inline messages::AttitudeEstimate TrueAttitude(const truth::RoverState& state, double start_z_m) {
  const auto& R_WR = state.X_WR.linear();
  return {.roll_rad = math::Atan2(R_WR(2, 1), R_WR(2, 2)),
          .pitch_rad = math::Atan2(-R_WR(2, 0), math::Hypot(R_WR(2, 1), R_WR(2, 2))),
          .z_m = state.X_WR.translation().z() - start_z_m};
}

}  // namespace rockyard::sensing

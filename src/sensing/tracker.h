// The overhead cameras that measured the "true" pose in the test arena (Matthies 1995, section 3).
#pragma once

#include <cstdint>

#include "core/random.h"
#include "math/pose.h"
#include "sensing/tracker_params.h"

namespace rockyard::sensing {

// The paper bounds the systematic error and gives the root mean square of the random one. Model:
// the systematic error of a trial is constant, uniform in a disc of radius systematic_position and
// uniform within +-systematic_heading; each sample adds normal noise, its position noise shared
// equally by x and y. In the arena the systematic error varies with place; over one run it is taken
// as constant.
class Tracker {
 public:
  Tracker(const TrackerParams& params, core::TrialKey key);

  // Returns what the tracker reports for the true pose; noise goes by sample number (stream
  // kTracker, substream sample + 1; substream 0 holds the systematic error).
  math::Pose2 Observe(const math::Pose2& truth, std::int64_t sample) const;

 private:
  TrackerParams params_;
  core::TrialKey key_;
  math::Pose2 bias_;
};

}  // namespace rockyard::sensing

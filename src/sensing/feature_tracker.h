// Tracks a feature that the rover is to drive to: where it lies as seen from the rover, whatever
// the rover believes of its own pose.
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "math/pose.h"
#include "messages/measurements.h"
#include "sensing/feature_tracker_params.h"

namespace rockyard::sensing {

// The tracker of one trial. A measurement is the true bearing plus N(0, bearing_sd) and the true
// range times 1 + N(0, range_sd_fraction), never below 0. Whether the feature is seen goes by its
// true place. Limits: no rock stands in the way, the track is never lost nor taken up at another
// feature, and tracking takes neither time nor energy.
class FeatureTracker {
 public:
  FeatureTracker(const FeatureTrackerParams& params, core::TrialKey key)
      : params_(params), key_(key) {}

  // Returns the sighting from the true pose of the rover in W of the feature at (x_m, y_m) in W;
  // nothing beyond the range or the field of view. Noise goes by sample number, from 0 (stream
  // kFeatureTracker, substream sample; bearing first, then range).
  std::optional<messages::FeatureSighting> Observe(const math::Pose2& rover, double x_m, double y_m,
                                                   std::int64_t sample) const;

 private:
  FeatureTrackerParams params_;
  core::TrialKey key_;
};

}  // namespace rockyard::sensing

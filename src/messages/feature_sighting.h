// What a tracker of features reports.
#pragma once

namespace rockyard::messages {

// Where the feature lies that the rover drives to, as seen from R's origin in the levelled rover
// frame.
struct FeatureSighting {
  double range_m = 0.0;      // horizontal, >= 0
  double bearing_rad = 0.0;  // from the heading, positive left, within [-pi, pi]
};

}  // namespace rockyard::messages

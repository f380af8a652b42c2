// Where a feature lies that the rover tracks, in the frame in which the rover believes its pose:
// the on-board side of a drive moves its goal there with every sighting, and its record depends on
// the bits.
#pragma once

#include "math/functions.h"
#include "messages/estimates.h"
#include "messages/measurements.h"

namespace rockyard::perception {

// Returns the place of the feature, by the believed pose and the sighting. However far the pose has
// drifted, the place is right as seen from the rover. Sighting and estimate must be of the same
// moment.
inline messages::Goal PlaceOf(const messages::FeatureSighting& sighting,
                              const messages::PoseEstimate& estimate) {
  const double direction_rad = estimate.heading_rad + sighting.bearing_rad;
  return {estimate.x_m + sighting.range_m * math::Cos(direction_rad),
          estimate.y_m + sighting.range_m * math::Sin(direction_rad)};
}

}  // namespace rockyard::perception

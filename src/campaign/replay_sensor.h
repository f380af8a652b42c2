// What the terrain sensor of a drive lights and sees, for its replay.
#pragma once

#include "replay/data.h"
#include "scenario/scenario.h"

namespace rockyard::campaign {

// Directions that are kept along each side of a camera's image.
inline constexpr int kRimRaysOfASide = 6;

// The light planes and cameras of the sensor that the scenario chooses, as they truly are; neither
// where it has none that can be drawn.
replay::ReplaySensor SensorOf(const scenario::Scenario& scenario);

}  // namespace rockyard::campaign

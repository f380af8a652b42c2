// The highest step across the whole width of a rover that it climbs from soil: it tries steps of
// one height after another. The command `mobility` tells it.
#pragma once

#include <functional>
#include <optional>

#include "rover/rover_params.h"
#include "terrain/soil_params.h"

namespace rockyard::campaign {

// Returns whether the rover, driving straight ahead over level soil, gets onto a step of that
// height with all its wheels. The step stands at a right angle to its way, is deeper than the rover
// is long, and has the friction of rock (contact.wheel_rock_friction); its upper edge is rounded
// within a sixth of the wheel's radius. It gets the way that it needs times three. The rover is
// the multibody, whatever `params` say: the quasi-static rover knows no sharp edges. A slow rover
// is simulated faster than it drives (physics.time_scale), up to a quarter of the speed from where
// on inertia tells. Cost: 0.1 to 1 s.
bool ClimbsStep(const rover::RoverParams& params, const terrain::SoilParams& soil, double height_m);

// Returns the highest step that the rover climbs, to 5 mm: heights grow by half a wheel's radius up
// to three diameters until one is too high, and the interval below that one is halved. Nothing
// where `stop` has returned true, which is asked before each height.
std::optional<double> HighestStep(const rover::RoverParams& params, const terrain::SoilParams& soil,
                                  const std::function<bool()>& stop);

}  // namespace rockyard::campaign

// The terrain sensors that there are.
#pragma once

#include <memory>

#include "trial/eyes/terrain_sensor_set_params.h"

namespace rockyard::trial {

// Light stripes and cameras of Matthies 1995, section 6.
std::unique_ptr<TerrainSensorKind> LightStripeKind();
// Pairs of cameras of Goldberg 2002.
std::unique_ptr<TerrainSensorKind> StereoKind();

}  // namespace rockyard::trial

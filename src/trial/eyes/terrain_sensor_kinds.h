// The kinds of terrain sensors that there are, which StandardTerrainSensors lists.
#pragma once

#include <memory>

#include "trial/eyes/terrain_sensor_set_params.h"

namespace rockyard::trial {

// Makes the light stripes and cameras of Matthies 1995, section 6 (light_stripe_kind.cc).
std::unique_ptr<TerrainSensorKind> LightStripeKind();
// Makes the pairs of cameras of Goldberg 2002 (stereo_kind.cc).
std::unique_ptr<TerrainSensorKind> StereoKind();

}  // namespace rockyard::trial

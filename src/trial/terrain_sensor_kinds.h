// The terrain sensors there are, each in a file of its own.
#pragma once

#include "trial/terrain_sensor_kind_params.h"

namespace rockyard::trial {

// Light stripes and cameras of Matthies 1995, section 6: light_stripe_kind.cc.
TerrainSensorKind LightStripeKind();
// Pairs of cameras of Goldberg 2002: stereo_kind.cc.
TerrainSensorKind StereoKind();

}  // namespace rockyard::trial

// Light stripes and cameras of Matthies 1995, section 6.
#pragma once

#include "trial/terrain_sensor_kind_params.h"

namespace rockyard::trial {

TerrainSensorKind LightStripeKind();

}  // namespace rockyard::trial

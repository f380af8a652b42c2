// Light stripes and cameras of Matthies 1995, section 6.
#pragma once

#include <memory>

#include "trial/terrain_sensor_set_params.h"

namespace rockyard::trial {

std::unique_ptr<TerrainSensorKind> LightStripeKind();

}  // namespace rockyard::trial

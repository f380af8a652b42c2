// Pairs of cameras of Goldberg 2002.
#pragma once

#include "trial/terrain_sensor_kind_params.h"

namespace rockyard::trial {

TerrainSensorKind StereoKind();

}  // namespace rockyard::trial

// Pairs of cameras of Goldberg 2002.
#pragma once

#include <memory>

#include "trial/terrain_sensor_set_params.h"

namespace rockyard::trial {

std::unique_ptr<TerrainSensorKind> StereoKind();

}  // namespace rockyard::trial

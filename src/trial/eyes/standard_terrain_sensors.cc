#include "trial/eyes/terrain_sensor_kinds.h"
#include "trial/eyes/terrain_sensor_set_params.h"

namespace rockyard::trial {

TerrainSensorSet StandardTerrainSensors() {
  TerrainSensorSet set;
  set.Add(LightStripeKind());
  set.Add(StereoKind());
  return set;
}

}  // namespace rockyard::trial

// The one list of terrain sensors, apart from TerrainSensorSet, which knows no kind.
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

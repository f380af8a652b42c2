#include "trial/terrain_sensor_kinds.h"

#include <array>
#include <cstddef>

namespace rockyard::trial {

const TerrainSensorKind& KindOf(TerrainSensor sensor) {
  // In the order of the enumeration.
  static const std::array<TerrainSensorKind, core::EnumNames<TerrainSensor>::kNames.size()> kKinds{
      LightStripeKind(), StereoKind()};
  return kKinds.at(static_cast<std::size_t>(sensor));
}

}  // namespace rockyard::trial

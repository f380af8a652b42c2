#include <array>
#include <cstddef>

#include "trial/light_stripe_kind.h"
#include "trial/stereo_kind.h"
#include "trial/terrain_sensor_kind_params.h"

namespace rockyard::trial {

const TerrainSensorKind& KindOf(TerrainSensor sensor) {
  // In the order of the enumeration.
  static const std::array<TerrainSensorKind, core::EnumNames<TerrainSensor>::kNames.size()> kKinds{
      LightStripeKind(), StereoKind()};
  return kKinds.at(static_cast<std::size_t>(sensor));
}

}  // namespace rockyard::trial

#include "trial/eyes/terrain_sensor_set_params.h"

#include <array>

namespace rockyard::trial {
namespace {

using core::Setting;

// The other groups of SensorParams. light_stripe and stereo are not listed, as they belong to the
// kinds of these names.
constexpr std::array<std::string_view, 6> kOtherGroups{"sun",      "look",    "gyro",
                                                       "encoders", "tracker", "vehicle"};

}  // namespace

TerrainSensorSet::TerrainSensorSet()
    : KindSet({.group = "sensors",
               .key = "terrain_sensor",
               .one = "a terrain sensor",
               .others = kOtherGroups,
               .choice = Setting("what the rover looks at the terrain with; the groups of other "
                                 "sensors do nothing")}) {}

}  // namespace rockyard::trial

#include "trial/eyes/terrain_sensor_set_params.h"

#include <array>

namespace rockyard::trial {
namespace {

using core::Setting;

// The groups of light_stripe and stereo are of those kinds.
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

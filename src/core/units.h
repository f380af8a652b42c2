// Units from names, for messages and tables of parameters, and degrees that read back exactly.
// Fingerprints depend on the digits of ExactDegrees (field_archive.h); no record or fingerprint on
// UnitOf.
#pragma once

#include <string>
#include <string_view>

namespace rockyard::core {

// Returns the unit that a name carries as its suffix: "wheel_radius_m" -> "m", "speed_m_s" ->
// "m/s", "variance_deg2_per_m" -> "deg2/m", "torque_Nm" -> "Nm", "rocks_per_m2" -> "1/m2". The
// first unit of several is the numerator, the others divide. "1" where there is none.
std::string UnitOf(std::string_view name);

// Returns the decimal with the fewest digits that DegToRad turns into exactly value_rad, so that a
// written angle reads back to the same bits. Where no double does, returns the nearest conversion.
double ExactDegrees(double value_rad);

}  // namespace rockyard::core

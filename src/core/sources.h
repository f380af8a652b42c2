// Where published values come from, in the words that parameters give as their source. Schemas,
// tables and pages show them; no record and no fingerprint depends on one.
#pragma once

#include <string_view>

namespace rockyard::core {

inline constexpr std::string_view kMatthiesTable3 = "Matthies 1995 table 3";
inline constexpr std::string_view kMatthiesSection6 = "Matthies 1995 sec. 6";
inline constexpr std::string_view kGoldbergTable1 = "Goldberg 2002 table 1";

}  // namespace rockyard::core

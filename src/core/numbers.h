// NaN and infinity of double, under the names that statistics, reports and tools use.
#pragma once

#include <limits>

namespace rockyard::core {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace rockyard::core

// Elevation scans made by hand.
#pragma once

#include <array>
#include <initializer_list>

#include "messages/estimates.h"

namespace rockyard::perception {

using Stripes = messages::PerStripe<bool>;

inline Stripes Only(std::initializer_list<std::size_t> stripes) {
  Stripes flags{};
  for (const std::size_t stripe : stripes) flags[stripe] = true;
  return flags;
}

// Every point found; each row at one elevation, nearest row first.
inline messages::ElevationScan ScanOfRows(const std::array<double, messages::kStripeRows>& rows) {
  messages::ElevationScan scan;
  for (std::size_t row = 0; row < messages::kStripeRows; ++row) {
    for (messages::ElevationPoint& point : scan.points[row]) {
      point = {.detected = true, .elevation_m = rows[row]};
    }
  }
  return scan;
}

inline messages::ElevationScan FlatScan() { return ScanOfRows({0.0, 0.0, 0.0, 0.0}); }

// Flat but for one point of row 2.
inline messages::ElevationScan RockScan(std::size_t stripe, double elevation_m) {
  messages::ElevationScan scan = FlatScan();
  scan.points[2][stripe].elevation_m = elevation_m;
  return scan;
}

}  // namespace rockyard::perception

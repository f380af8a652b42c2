#include "localization/beacon_fix.h"

#include <cmath>

#include "math/polar.h"

namespace rockyard::localization {

messages::PoseFix PlaceFromBeacon(const messages::BeaconReading& reading) {
  constexpr int kX = messages::Index(messages::PoseCoordinate::kX);
  constexpr int kY = messages::Index(messages::PoseCoordinate::kY);
  messages::PoseFix fix;
  fix.capture = reading.capture;
  fix.measured.set(kX).set(kY);
  fix.pose_W[kX] = reading.station_x_m + reading.range_m * std::cos(reading.bearing_rad);
  fix.pose_W[kY] = reading.station_y_m + reading.range_m * std::sin(reading.bearing_rad);
  fix.covariance.topLeftCorner<2, 2>() = math::PolarCovariance(
      reading.bearing_rad, reading.range_sd_m, reading.range_m * reading.bearing_sd_rad);
  return fix;
}

}  // namespace rockyard::localization

#include "sensing/radio_beacon.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/distributions.h"
#include "math/angles.h"

namespace rockyard::sensing {

std::optional<messages::BeaconReading> RadioBeacon::Observe(const math::Transform& X_WR,
                                                            std::int64_t number) const {
  EXPECT(number >= 0);
  const double dx_m = X_WR.translation().x() - station_.x_m;
  const double dy_m = X_WR.translation().y() - station_.y_m;
  const double range_m = std::hypot(dx_m, dy_m);
  if (range_m > params_.range_m) return std::nullopt;
  core::RandomStream stream(key_, core::Purpose::kRadioBeacon, static_cast<std::uint32_t>(number));
  const double range_error_m = core::SampleNormal(stream, 0.0, params_.range_sd_m);
  const double bearing_error_rad = core::SampleNormal(stream, 0.0, params_.bearing_sd_rad);
  return messages::BeaconReading{
      .station_x_m = station_.x_m,
      .station_y_m = station_.y_m,
      .range_m = std::max(0.0, range_m + range_error_m),
      .bearing_rad = math::WrapAngle(std::atan2(dy_m, dx_m) + bearing_error_rad),
      .range_sd_m = params_.range_sd_m,
      .bearing_sd_rad = params_.bearing_sd_rad};
}

}  // namespace rockyard::sensing

#include "sensing/feature_tracker.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/distributions.h"
#include "math/angles.h"

namespace rockyard::sensing {

std::optional<messages::FeatureSighting> FeatureTracker::Observe(const math::Pose2& rover,
                                                                 double x_m, double y_m,
                                                                 std::int64_t sample) const {
  EXPECT(sample >= 0);
  const double dx_m = x_m - rover.x_m;
  const double dy_m = y_m - rover.y_m;
  const double range_m = std::hypot(dx_m, dy_m);
  const double bearing_rad = math::WrapAngle(std::atan2(dy_m, dx_m) - rover.heading_rad);
  if (range_m > params_.range_m || std::abs(bearing_rad) > params_.half_field_of_view_rad) {
    return std::nullopt;
  }
  core::RandomStream stream(key_, core::Purpose::kFeatureTracker,
                            static_cast<std::uint32_t>(sample));
  const double bearing_error_rad = core::SampleNormal(stream, 0.0, params_.bearing_sd_rad);
  const double range_factor = core::SampleNormal(stream, 1.0, params_.range_sd_fraction);
  return messages::FeatureSighting{.range_m = std::max(0.0, range_m * range_factor),
                                   .bearing_rad = math::WrapAngle(bearing_rad + bearing_error_rad)};
}

}  // namespace rockyard::sensing

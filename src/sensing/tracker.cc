#include "sensing/tracker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/random.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::sensing {

Tracker::Tracker(const TrackerParams& params, core::TrialKey key) : params_(params), key_(key) {
  // Drawn once a trial: substream 0.
  core::RandomStream stream(key, core::Purpose::kTracker, 0);
  // Uniform in a disc: the radius is R sqrt(u), the direction uniform.
  const double radius_m = params.systematic_position_m * std::sqrt(stream.Uniform());
  const double direction_rad = core::SampleUniform(stream, -std::numbers::pi, std::numbers::pi);
  bias_ = {
      radius_m * math::Cos(direction_rad), radius_m * math::Sin(direction_rad),
      core::SampleUniform(stream, -params.systematic_heading_rad, params.systematic_heading_rad)};
}

math::Pose2 Tracker::Observe(const math::Pose2& truth, std::int64_t sample) const {
  EXPECT(sample >= 0);
  core::RandomStream stream(key_, core::Purpose::kTracker, static_cast<std::uint32_t>(sample + 1));
  // The published RMS is that of the distance: sqrt(sigma_x^2 + sigma_y^2).
  const double per_axis_m = params_.random_position_m / std::numbers::sqrt2;
  const double x_m = truth.x_m + bias_.x_m + core::SampleNormal(stream, 0.0, per_axis_m);
  const double y_m = truth.y_m + bias_.y_m + core::SampleNormal(stream, 0.0, per_axis_m);
  const double heading_rad = truth.heading_rad + bias_.heading_rad +
                             core::SampleNormal(stream, 0.0, params_.random_heading_rad);
  return {x_m, y_m, math::WrapAngle(heading_rad)};
}

std::optional<messages::FeatureSighting> FeatureTracker::Observe(const math::Pose2& rover,
                                                                 double x_m, double y_m,
                                                                 std::int64_t sample) const {
  EXPECT(sample >= 0);
  const double dx_m = x_m - rover.x_m;
  const double dy_m = y_m - rover.y_m;
  const double range_m = math::Hypot(dx_m, dy_m);
  const double bearing_rad = math::WrapAngle(math::Atan2(dy_m, dx_m) - rover.heading_rad);
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

#include "sensing/tracker.h"

#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/distributions.h"

namespace rockyard::sensing {

Tracker::Tracker(const TrackerParams& params, core::TrialKey key) : params_(params), key_(key) {
  // Drawn once a trial: substream 0.
  core::RandomStream stream(key, core::Purpose::kTracker, 0);
  // Uniform in a disc: the radius is R sqrt(u), the direction uniform.
  const double radius_m = params.systematic_position_m * std::sqrt(stream.Uniform());
  const double direction_rad = core::SampleUniform(stream, -std::numbers::pi, std::numbers::pi);
  bias_ = {
      radius_m * std::cos(direction_rad), radius_m * std::sin(direction_rad),
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

}  // namespace rockyard::sensing

#include "localization/attitude.h"

#include <cmath>

#include "core/check.h"
#include "math/angles.h"

namespace rockyard::localization {

double ForwardStep(const messages::PoseEstimate& before, const messages::PoseEstimate& after) {
  const double turn_rad = math::WrapAngle(after.heading_rad - before.heading_rad);
  // On an arc the chord points along the mean of both headings.
  const double along_rad = before.heading_rad + 0.5 * turn_rad;
  return (after.x_m - before.x_m) * std::cos(along_rad) +
         (after.y_m - before.y_m) * std::sin(along_rad);
}

void AttitudeEstimator::Filter(const math::Vector3& force_R, double duration_s) {
  // The first measurement, or no filter: taken as it is.
  if (!force_R_ || params_.filter_s <= 0.0) {
    force_R_ = force_R;
    return;
  }
  // First-order low pass over a tick: f += (1 - e^(-dt/T)) (f_now - f), exact for a force that
  // stays.
  *force_R_ += -std::expm1(-duration_s / params_.filter_s) * (force_R - *force_R_);
}

void AttitudeEstimator::Integrate(const messages::VehicleState& state, double forward_m,
                                  double duration_s) {
  EXPECT(duration_s > 0.0);
  if (params_.source == AttitudeSource::kAccelerometers && state.specific_force_R) {
    Filter(*state.specific_force_R, duration_s);
    const math::Vector3& f = *force_R_;
    if (f.squaredNorm() > 0.0) {
      // f = g (-sin p, sin r cos p, cos r cos p) at rest, in R. |(f_y, f_z)| = g cos p >= 0, so
      // pitch stays within +-90 deg; roll needs no g.
      estimate_.pitch_rad = std::atan2(-f.x(), std::hypot(f.y(), f.z()));
      estimate_.roll_rad = std::atan2(f.y(), f.z());
    }
  }
  if (params_.height == HeightSource::kIntegrated) {
    // Positive pitch has the nose down, so driving forward loses height.
    estimate_.z_m -= forward_m * std::sin(estimate_.pitch_rad);
  }
}

}  // namespace rockyard::localization

#include "perception/attitude.h"

#include <cmath>

#include "core/check.h"
#include "math/angles.h"

namespace rockyard::perception {

double ForwardStep(const messages::PoseEstimate& before, const messages::PoseEstimate& after) {
  const double turn_rad = math::WrapAngle(after.heading_rad - before.heading_rad);
  const double along_rad = before.heading_rad + 0.5 * turn_rad;
  return (after.x_m - before.x_m) * std::cos(along_rad) +
         (after.y_m - before.y_m) * std::sin(along_rad);
}

void AttitudeEstimator::Filter(const math::Vector3& force_R, double duration_s) {
  if (!force_R_ || params_.filter_s <= 0.0) {
    force_R_ = force_R;
    return;
  }
  *force_R_ += -std::expm1(-duration_s / params_.filter_s) * (force_R - *force_R_);
}

void AttitudeEstimator::Integrate(const messages::VehicleState& state, double forward_m,
                                  double duration_s) {
  EXPECT(duration_s > 0.0);
  if (params_.source == AttitudeSource::kAccelerometers && state.specific_force_R) {
    Filter(*state.specific_force_R, duration_s);
    const math::Vector3& f = *force_R_;
    if (f.squaredNorm() > 0.0) {
      estimate_.pitch_rad = std::atan2(-f.x(), std::hypot(f.y(), f.z()));
      estimate_.roll_rad = std::atan2(f.y(), f.z());
    }
  }
  if (params_.height == HeightSource::kIntegrated) {
    estimate_.z_m -= forward_m * std::sin(estimate_.pitch_rad);
  }
}

}  // namespace rockyard::perception

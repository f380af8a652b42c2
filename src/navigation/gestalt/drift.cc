#include "navigation/gestalt/drift.h"

#include <algorithm>
#include <cmath>

#include "math/functions.h"

namespace rockyard::navigation {

void Drift::Correct(const messages::PoseEstimate& rover_O, double left_m) {
  const double driven_m = rover_O.distance_m - odometer_m_;
  odometer_m_ = rover_O.distance_m;
  if (!params_.enabled || math::Atan2(std::abs(left_m), driven_m) > params_.max_angle_rad) return;
  const auto [sine, cosine] = math::SinCos(rover_O.heading_rad);
  const double keeps = math::Exp(-driven_m / params_.memory_m);
  x_m_ = keeps * x_m_ - sine * left_m;
  y_m_ = keeps * y_m_ + cosine * left_m;
  driven_m_ = keeps * driven_m_ + driven_m;
}

double Drift::Angle_rad(double heading_rad) const {
  if (driven_m_ <= 0.0) return 0.0;
  const auto [sine, cosine] = math::SinCos(heading_rad);
  // What is missing of memory_m counts as driven without any drift.
  return math::Atan2(cosine * y_m_ - sine * x_m_, std::max(driven_m_, params_.memory_m));
}

}  // namespace rockyard::navigation

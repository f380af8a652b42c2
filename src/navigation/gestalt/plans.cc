#include "navigation/gestalt/plans.h"

namespace rockyard::navigation {

std::int64_t PlansOnTheMove::Begin(double time_s) {
  on_ = true;
  late_ = false;
  driven_m_ = 0.0;
  time_s_ = time_s;
  return ++moves_;
}

void PlansOnTheMove::Measure(double driven_m, double time_s) {
  const double tick_s = time_s - time_s_;
  speed_m_s_ = tick_s > 0.0 ? (driven_m - driven_m_) / tick_s : 0.0;
  driven_m_ = driven_m;
  time_s_ = time_s;
}

bool PlansOnTheMove::Asks(double leg_m) {
  if (awaits_look_ || driven_m_ < params_.replan_fraction * leg_m) return false;
  awaits_look_ = true;
  look_speed_m_s_ = speed_m_s_;
  return true;
}

bool PlansOnTheMove::WaitsAtEnd() {
  if (awaits_look_ && !late_) {
    late_ = true;
    ++counts_.late;
  }
  return awaits_look_ && params_.late_plan == LatePlan::kWait;
}

void PlansOnTheMove::Answer() {
  awaits_look_ = false;
  ++counts_.plans;
}

void PlansOnTheMove::Start(const messages::PoseEstimate& origin,
                           const messages::PoseEstimate& now) {
  ++counts_.started;
  const double dx_m = origin.x_m - now.x_m;
  const double dy_m = origin.y_m - now.y_m;
  counts_.start_error_squared_m2 += dx_m * dx_m + dy_m * dy_m;
}

}  // namespace rockyard::navigation

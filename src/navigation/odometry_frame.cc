#include "navigation/odometry_frame.h"

#include <cmath>

#include "math/angles.h"

namespace rockyard::navigation {

using messages::Goal;
using messages::PoseEstimate;

void OdometryFrame::Correct(const PoseEstimate& before, const PoseEstimate& after) {
  const PoseEstimate rover_O = FromWorld(before);
  // X_OW' with X_OW' after = X_OW before: the heading first, then p_O = p_OW + Rz(heading) p_W.
  X_OW_ = {0.0, 0.0, math::WrapAngle(rover_O.heading_rad - after.heading_rad)};
  const PoseEstimate turned_O = FromWorld(after);
  X_OW_.x_m = rover_O.x_m - turned_O.x_m;
  X_OW_.y_m = rover_O.y_m - turned_O.y_m;
}

PoseEstimate OdometryFrame::FromWorld(const PoseEstimate& estimate_W) const {
  const Goal place_O = FromWorld(Goal{estimate_W.x_m, estimate_W.y_m});
  return {place_O.x_m, place_O.y_m, math::WrapAngle(estimate_W.heading_rad + X_OW_.heading_rad),
          estimate_W.distance_m};
}

Goal OdometryFrame::FromWorld(const Goal& goal_W) const {
  const double cosine = std::cos(X_OW_.heading_rad);
  const double sine = std::sin(X_OW_.heading_rad);
  return {X_OW_.x_m + cosine * goal_W.x_m - sine * goal_W.y_m,
          X_OW_.y_m + sine * goal_W.x_m + cosine * goal_W.y_m};
}

}  // namespace rockyard::navigation

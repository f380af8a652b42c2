#include "trial/slip_onset.h"

#include <cmath>

namespace rockyard::trial {

messages::RelativeMotion TrueMotion(const math::Pose2& from, const math::Pose2& to) {
  const double c = std::cos(from.heading_rad);
  const double s = std::sin(from.heading_rad);
  const double dx_m = to.x_m - from.x_m;
  const double dy_m = to.y_m - from.y_m;
  messages::RelativeMotion motion;
  motion.motion_F[messages::Index(messages::PoseCoordinate::kX)] = c * dx_m + s * dy_m;
  motion.motion_F[messages::Index(messages::PoseCoordinate::kY)] = -s * dx_m + c * dy_m;
  motion.covariance.setZero();
  return motion;
}

void SlipOnset::Observe(const messages::PoseEstimate& odometry, const math::Pose2& truth,
                        double path_m) {
  if (!params_.enabled || path_m_) return;
  ticks_.push_back({odometry, truth});
  // The newest tick from which on the wheels have rolled far enough is the first one.
  while (ticks_.size() > 1 &&
         odometry.distance_m - ticks_[1].odometry.distance_m >= params_.min_way_m) {
    ticks_.pop_front();
  }
  const Tick& first = ticks_.front();
  const auto slip = perception::SlipOf(perception::RolledWay(first.odometry, odometry),
                                       TrueMotion(first.truth, truth), params_);
  if (slip && slip->exceeded) path_m_ = path_m;
}

}  // namespace rockyard::trial

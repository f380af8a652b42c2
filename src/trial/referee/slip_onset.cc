#include "trial/referee/slip_onset.h"

namespace rockyard::trial {

messages::RelativeMotion TrueMotion(const math::Pose2& from, const math::Pose2& to) {
  messages::RelativeMotion motion;
  motion.motion_F.head<2>() = perception::RolledWay({from.x_m, from.y_m, from.heading_rad, 0.0},
                                                    {to.x_m, to.y_m, to.heading_rad, 0.0});
  motion.covariance.setZero();
  return motion;
}

void SlipOnset::Observe(const messages::PoseEstimate& odometry, const math::Pose2& truth,
                        double path_m) {
  if (!params_.enabled || path_m_) return;
  ticks_.push_back({odometry, truth});
  // ticks_ begins with the newest tick since which the wheels have rolled far enough.
  while (ticks_.size() > 1 &&
         odometry.distance_m - ticks_[1].odometry.distance_m >= params_.min_way_m) {
    ticks_.pop_front();
  }
  const Tick& first = ticks_.front();
  const auto slip = perception::SlipOf(perception::RolledWay(first.odometry, odometry),
                                       TrueMotion(first.truth, truth), params_);
  if (slip && slip->exceeded) path_m_ = path_m;
}

bool SlipOnset::TrulyExceeded(const SlipReading& reading) {
  const auto slip = perception::SlipOf(
      reading.rolled_m, TrueMotion(looks_.at(reading.from), looks_.at(reading.to)), params_);
  // Nothing before this look is asked for again; the look itself may be, as a keyframe.
  looks_.erase(looks_.begin(), looks_.find(reading.from));
  return slip->exceeded;
}

}  // namespace rockyard::trial

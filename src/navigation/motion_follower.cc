#include "navigation/motion_follower.h"

#include "core/check.h"

namespace rockyard::navigation {

using messages::MotionCommand;
using messages::MotionKind;

// The end of a plan moves on with each one that confirms it, and a speed changes no path.
bool MotionFollower::Begins(const MotionCommand& command) const {
  return command.kind != last_.kind || command.curvature_per_m != last_.curvature_per_m ||
         command.direction != last_.direction ||
         command.curvature_rate_per_m2 != last_.curvature_rate_per_m2 || command.move != last_.move;
}

MotionCommand MotionFollower::Follow(const MotionCommand& command, double odometer_m,
                                     double tick_s) {
  EXPECT(tick_s > 0.0);
  EXPECT(command.speed_share > 0.0 && command.speed_share <= 1.0);
  if (Begins(command)) began_m_ = odometer_m;
  last_ = command;
  if (command.kind != MotionKind::kArc) return command;
  const double speed_m_s = command.speed_share * full_speed_m_s_;
  if (odometer_m + speed_m_s * (tick_s + 0.5 * ramp_s_) > command.end_m) return {};
  MotionCommand motion = command;
  // Without a rate the curvature keeps its bits, the sign of a zero too.
  if (command.curvature_rate_per_m2 != 0.0) {
    const double middle_m = odometer_m + 0.5 * speed_m_s * tick_s;
    motion.curvature_per_m += command.curvature_rate_per_m2 * (middle_m - began_m_);
  }
  return motion;
}

}  // namespace rockyard::navigation

// From a motion command to the motion of each tick: along a clothoid, and to rest before its end.
#pragma once

#include "messages/commands.h"

namespace rockyard::navigation {

// Follows the command that it is given at each tick, by the odometer:
//   curvature = c + c' s, with s what was driven since the command began,
// at the middle of the tick, where a rover at full speed has driven v tick / 2 more: what is held
// for a tick is off to either side alike. It stops in time: braking takes v T / 2 for a ramp of T
// from v to rest, and what is told now is driven for a tick, so that it stops where
//   odometer + v tick + v T / 2 > end.
// A command begins where it differs from the last one or, with a number of its own (move), where
// its terms (curvature, rate) do. Draws no random numbers.
class MotionFollower {
 public:
  // v at full speed, m/s; T, s.
  MotionFollower(double full_speed_m_s, double ramp_s)
      : full_speed_m_s_(full_speed_m_s), ramp_s_(ramp_s) {}

  // What to do for the next tick_s > 0; kStop where the end is too near.
  messages::MotionCommand Follow(const messages::MotionCommand& command, double odometer_m,
                                 double tick_s);

 private:
  bool Begins(const messages::MotionCommand& command) const;

  double full_speed_m_s_;
  double ramp_s_;
  messages::MotionCommand last_;
  double began_m_ = 0.0;  // odometer then
};

}  // namespace rockyard::navigation

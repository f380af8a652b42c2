// MotionFollower, from a motion command to the motion of each tick, for every navigator; and
// RouteFollower, the navigator `route`, which drives along a route that it was given. Every record
// of a drive depends on the bits of MotionFollower; on RouteFollower those of `route` alone.
#pragma once

#include <cstddef>
#include <optional>

#include "messages/commands.h"
#include "messages/estimates.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"
#include "navigation/route_params.h"

namespace rockyard::navigation {

// Stands between the navigator, whichever it is, and the wheel driver, on board of every drive.
// Follows the command of each tick by the odometer:
//   curvature = c + c' s, with s what was driven since the command began,
// at the middle of the tick, where a rover of speed v has driven v tick / 2 more, so that a
// curvature that is held for a tick is off to either side alike. It stops in time: braking takes v
// T / 2 for a ramp of T from v to rest, and what is told now is driven for a tick. So it stops
// where
//   odometer + v tick + v T / 2 > end.
// A command begins where its kind, direction, curvature, rate or number (move) differ from those of
// the last one (Begins). Draws no random numbers.
class MotionFollower {
 public:
  // Takes the full speed, m/s, and T, s.
  MotionFollower(double full_speed_m_s, double ramp_s)
      : full_speed_m_s_(full_speed_m_s), ramp_s_(ramp_s) {}

  // Returns what to do for the next tick_s > 0; kStop where the end is too near.
  messages::MotionCommand Follow(const messages::MotionCommand& command, double odometer_m,
                                 double tick_s);

 private:
  bool Begins(const messages::MotionCommand& command) const;

  double full_speed_m_s_;
  double ramp_s_;
  messages::MotionCommand last_;
  double began_m_ = 0.0;  // odometer when last_ began
};

// Follows a route by dead reckoning and looks at nothing: what is left of a navigator where path
// selection is perfect. The drive plans the route on the map of course.route_map; the follower
// knows no terrain. The ablation perfect_path_selection chooses it.
//
// Drives from corner to corner: it turns in place where the next corner lies off by more than
// point_turn_bearing, or inside of the tightest circle; otherwise it drives the arc that leads
// there, of curvature 2 sin(bearing) / distance, worked out anew every steer_interval_m. Hazards
// are neither looked for nor, where the rover feels any, heeded. It gives up an empty route at
// once.
class RouteFollower final : public Navigator {
 public:
  RouteFollower(const RouteParams& params, messages::Route route);

  NavigatorDecision Decide(const NavigatorInput& input) override;
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  // Moves the end of the route, where there is one.
  void SetGoal(const messages::Goal& goal, GoalChange change) override;

 private:
  // Where a corner lies, as believed.
  struct Bearing {
    double distance_m = 0.0;
    double angle_rad = 0.0;
  };

  Bearing BearingTo(const messages::Goal& corner, const messages::PoseEstimate& estimate) const;
  void PassCorners(const messages::PoseEstimate& estimate);
  bool NeedsPointTurn(const Bearing& bearing) const;
  NavigatorDecision Steer(const Bearing& bearing, const messages::PoseEstimate& estimate);

  RouteParams params_;
  messages::Route route_;
  std::size_t next_ = 0;  // corner
  std::optional<messages::Goal> leg_from_;
  bool under_way_ = false;
  messages::MotionCommand motion_;
  double steered_at_m_ = 0.0;  // odometer
};

// Describes the navigator `route`, for a set of navigators.
NavigatorDescription<RouteParams> DescribeRouteFollower();

}  // namespace rockyard::navigation

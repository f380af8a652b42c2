// A navigator around any other one, which is driven from waypoint to waypoint: where it says that
// it is at one, it is given the next. The last waypoint is the goal of the drive. Everything else
// that the navigator says passes through. It is the outermost navigator of every drive, also of a
// drive with a single goal. Draws no random numbers. Records depend on the tick at which a waypoint
// is done with; in a drive with a single goal it changes nothing.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "messages/estimates.h"
#include "navigation/navigator.h"

namespace rockyard::navigation {

// Returns whether a rover at `estimate` is done with the corner of a way at the end of the leg that
// began at `from`: the rover is within_m near, or beyond the line through the corner across the
// leg,
//   (p - corner) . (corner - from) > 0,
// so that there is nothing to go back for. RouteFollower passes corners by it, too.
bool HasPassed(const messages::Goal& corner, const messages::Goal& from,
               const messages::PoseEstimate& estimate, double within_m);

class WaypointSequence final : public Navigator {
 public:
  // `goals`, in the world frame, are one at least, in the order of driving. `navigator` is not null
  // and has the first of them for its goal. With `pass_within_m` the waypoints are bends of a way
  // rather than places to be at: the rover is done with one by HasPassed.
  WaypointSequence(std::vector<messages::Goal> goals, std::unique_ptr<Navigator> navigator,
                   std::optional<double> pass_within_m = std::nullopt);

  // Says kArrived at the last goal only. Where the navigator says it of another goal, it is given
  // the next one and asked again, so that no tick is lost.
  NavigatorDecision Decide(const NavigatorInput& input) override;
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  void OnCorrection(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  // Replaces the last goal. The navigator learns it at once if it drives to the last goal, else
  // when its turn comes.
  void SetGoal(const messages::Goal& goal, GoalChange change) override;
  // Leaves out what is left of the sequence: `goal` is the goal that the rover drives to, and its
  // last.
  void DriveTo(const messages::Goal& goal);
  const messages::NavigationView* view() const override { return navigator_->view(); }
  PlanCounts plan_counts() const override { return navigator_->plan_counts(); }
  const messages::Overlay* overlay() const override { return navigator_->overlay(); }
  std::span<const double> own_values() const override { return navigator_->own_values(); }

  // Returns at how many waypoints the navigator said that it had arrived, or that were passed; the
  // last goal is none of them.
  std::size_t reached() const { return reached_; }
  bool IsOnLastLeg() const { return reached_ + 1 == goals_.size(); }
  // Returns the goal that the rover drives to now; and that in the end.
  const messages::Goal& goal() const { return goals_[reached_]; }
  const messages::Goal& last_goal() const { return goals_.back(); }

 private:
  void PassWaypoints(const messages::PoseEstimate& estimate);

  std::vector<messages::Goal> goals_;
  std::unique_ptr<Navigator> navigator_;
  std::optional<double> pass_within_m_;
  std::optional<messages::Goal> leg_from_;
  std::size_t reached_ = 0;
};

}  // namespace rockyard::navigation

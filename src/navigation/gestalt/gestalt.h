// GESTALT, the map-based navigator of Goldberg 2002, section 4, and its continuous driving (Howard
// 2012, section 2). cycle.h says what it does.
#pragma once

#include "math/pose.h"
#include "messages/estimates.h"
#include "navigation/gestalt/cycle.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"

namespace rockyard::navigation {

// The frame O in which a rover's own path is smooth, level as the estimated world W, and W itself
// before the first correction. Corrections of the estimate move the world in it, not the rover:
// what the rover has seen and what it is doing keep their places around it.
class OdometryFrame {
 public:
  // The estimate in W jumps from `before` to `after`, while the rover stays where it is in O.
  void Correct(const messages::PoseEstimate& before, const messages::PoseEstimate& after);

  // Headings stay within [-pi, pi]; the odometer is the same in every frame.
  messages::PoseEstimate FromWorld(const messages::PoseEstimate& estimate_W) const;
  messages::Goal FromWorld(const messages::Goal& goal_W) const;

 private:
  math::Pose2 X_OW_;  // of W in O
};

// The drive cycle as a navigator. Invariant: all that goes on is in O. A correction moves the goal
// there, and neither clears nor smears the map.
class GestaltNavigator final : public Navigator {
 public:
  // `full_speed_m_s` of the fastest rim, which limits how fast splines may bend; by itself that of
  // Athena (Howard 2012, section 3).
  GestaltNavigator(const GestaltParams& params, const messages::Goal& goal,
                   double full_speed_m_s = 0.07);

  NavigatorDecision Decide(const NavigatorInput& input) override;
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  void OnCorrection(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  void SetGoal(const messages::Goal& goal, GoalChange change) override;

  // Returns the last decision with its map and votes.
  const messages::NavigationView* view() const override { return cycle_.view(); }
  PlanCounts plan_counts() const override { return cycle_.plan_counts(); }

 private:
  messages::Goal goal_W_;
  OdometryFrame frame_;
  GestaltCycle cycle_;
};

// For a set of navigators.
NavigatorDescription<GestaltParams> DescribeGestalt();

}  // namespace rockyard::navigation

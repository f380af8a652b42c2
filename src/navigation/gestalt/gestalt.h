// GESTALT, the map-based navigator of Goldberg 2002, section 4, and its continuous driving (Howard
// 2012, section 2): the navigator `gestalt`. cycle.h says what it does.
//
// Words of this folder. The map is a grid of cells; columns run along x, rows along y. A patch is
// the square of cells around a cell that stands for the vehicle at any heading. Goodness says how
// safe a cell or a path is for the rover, certainty how sure that is, both from 0 to 255. A
// candidate is a motion that may be driven; it has a hazard vote (the ground under its path), a
// waypoint vote (how well it leads to the goal) and a merged vote. Felt hazards are those that the
// rover notices by touch, tilt, joint angles, currents or slip.
//
// Frames: W is the world as estimated, O moves with its corrections so that the rover's path is
// smooth (GestaltNavigator), D is that of odometry, R the rover's.
//
// Records of its drives depend on the bits of all that this folder computes but the view
// (tests/determinism pins a scenario of each cycle); others on Touches alone (StuckReaction).
#pragma once

#include "math/pose.h"
#include "messages/estimates.h"
#include "navigation/gestalt/cycle.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"

namespace rockyard::navigation {

// The drive cycle in the frame O, in which the rover's own path is smooth: level as the estimated
// world W, and W itself before the first correction. Invariant: a correction of the estimate moves
// W in O, and with it the goal, but not the rover. So what the rover has seen and what it is doing
// keep their places around it, and a correction neither clears nor smears the map.
class GestaltNavigator final : public Navigator {
 public:
  // `full_speed_m_s` is that of the fastest rim, which limits how fast splines may bend. The
  // default is Athena's (Howard 2012, section 3), as in NavigatorSetup.
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
  // Return an estimate and a goal in O. Headings stay within [-pi, pi]; the odometer is the same in
  // both frames.
  messages::PoseEstimate InO(const messages::PoseEstimate& estimate_W) const;
  messages::Goal InO(const messages::Goal& goal_W) const;

  math::Pose2 X_OW_;
  messages::Goal goal_W_;
  GestaltCycle cycle_;
};

// Describes the navigator `gestalt`, for a set of navigators.
NavigatorDescription<GestaltParams> DescribeGestalt();

}  // namespace rockyard::navigation

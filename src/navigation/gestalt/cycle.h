// The drive cycle of GESTALT (Goldberg 2002, section 4): look, map and vote, choose, drive blindly,
// look again. GestaltNavigator runs it.
//
// A cycle begins at rest:
//   1. At the goal within goal_tolerance: arrived. Out of time, or no progress for long: given up.
//   2. Look ahead; the points go into the map, and every motion is voted on.
//   3. Best forward vote below min_fwd_threshold: look behind, too, and vote again.
//   4. Drive the chosen arc for min(step, distance to the goal), or turn in place.
//   5. After a turn that was better than every arc: the straight drive that it was voted on with
//      (Howard 2012). After one for want of a way: another look.
// The rover gives up where there is nothing to choose after it has turned in place by search_turn.
//
// A hazard that the rover feels on the way (tilt, joint angles, motor current, contact) ends a
// drive: the rover marks an obstacle where it feels it, backs off along the arc unless it touches
// something at that end too, and begins a cycle. The paper names these sensors and not what
// follows, so that all of it is assumed.
//
// With continuous.cycle csod or csad forward drives are replaced on the move (continuous_drive.cc,
// Howard 2012, section 2). The rover comes back to the cycle at rest where it feels a hazard, where
// no plan on the move is safe, and where none is ready in time.
//
// Records depend on the order within a tick: goal, time, then the stage's own questions, of which,
// in drives and turns, a felt hazard comes before the end of the motion.
#pragma once

#include "navigation/gestalt/drift.h"
#include "navigation/gestalt/evaluation.h"
#include "navigation/gestalt/felt.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/manoeuvre.h"
#include "navigation/gestalt/patience.h"
#include "navigation/gestalt/plans.h"
#include "navigation/navigator.h"

namespace rockyard::navigation {

// The stages of the cycle and what leads from one to the next. Invariant: the rover is in one stage
// at a time, and the manoeuvre is the one of that stage; a stage ends by what is measured on board.
// All poses and the goal are in one frame O, in which the rover's path is smooth. Draws no random
// numbers.
class GestaltCycle {
 public:
  GestaltCycle(const GestaltParams& params, const messages::Goal& goal_O, double full_speed_m_s);

  NavigatorDecision Decide(const NavigatorInput& input);

  // Operators have moved the rover: the map is forgotten, as it lies where the rover no longer
  // stands, but for places where a hazard was felt since the last progress. A manoeuvre under way
  // ends as it would have; all ground may be searched again.
  void OnPoseUpdate(const messages::PoseEstimate& before, const messages::PoseEstimate& after);

  // The estimate is corrected: in O the goal moves, and the rover keeps its place but for rounding.
  // The best distance so far changes with the goal, so that what the rover gained stays gained.
  // left_m is how far to the left of where it was believed to be the rover is.
  void OnCorrection(const messages::PoseEstimate& before_O, const messages::PoseEstimate& after_O,
                    const messages::Goal& goal_O, double left_m);

  // Keeps the map and what was felt. With the next goal, progress is counted and a search begun
  // anew.
  void SetGoal(const messages::Goal& goal_O, GoalChange change);

  const messages::NavigationView* view() const { return evaluation_.view(); }
  const PlanCounts& plan_counts() const { return plans_.counts(); }

 private:
  enum class Stage {
    kStarting,
    kLookingAhead,
    kLookingBehind,
    kDriving,
    kBackingOff,
    kTurning,         // for want of a way: a look follows
    kTurningToDrive,  // a straight drive follows
    kTurningToStep,   // a straight drive of step_m follows, which nothing replaces on the move
  };

  NavigatorDecision BeginCycle(const NavigatorInput& input);
  NavigatorDecision Look(Stage stage);
  NavigatorDecision OnCloud(const NavigatorInput& input);
  NavigatorDecision Choose(const NavigatorInput& input);
  NavigatorDecision BeginTurnInstead(const RemedyTurn& turn, const NavigatorInput& input);
  NavigatorDecision BeginStep(const NavigatorInput& input);
  NavigatorDecision BeginDrive(messages::MotionCommand arc, const NavigatorInput& input);
  NavigatorDecision BeginSpline(const messages::Spline& spline, const NavigatorInput& input);
  NavigatorDecision Begin(Stage stage, const messages::MotionCommand& motion, double leg,
                          const NavigatorInput& input);
  NavigatorDecision ContinueDrive(const NavigatorInput& input);
  NavigatorDecision ContinueTurn(const NavigatorInput& input);
  NavigatorDecision ContinueBackOff(const NavigatorInput& input);
  NavigatorDecision OnFelt(const NavigatorInput& input);

  // These drive on the move: continuous_drive.cc.
  NavigatorDecision DriveOn(const NavigatorInput& input);
  NavigatorDecision EndMotion(const NavigatorInput& input);
  NavigatorDecision Replan(const NavigatorInput& input);
  NavigatorDecision ReplaceMotion(const NavigatorInput& input, const PlanOrigin& origin);
  NavigatorDecision StopToTurn();
  NavigatorDecision OnNoSafePlan();

  bool turns() const {
    return stage_ == Stage::kTurning || stage_ == Stage::kTurningToDrive ||
           stage_ == Stage::kTurningToStep;
  }
  bool moves() const {
    return turns() || stage_ == Stage::kDriving || stage_ == Stage::kBackingOff;
  }
  double DistanceToGoal_m(const messages::PoseEstimate& estimate) const;
  bool Progresses(const messages::PoseEstimate& estimate);
  // Returns the origin with the way that the rover makes good there in place of its heading.
  PlanOrigin MadeGood(PlanOrigin origin) const;
  // Returns the turn in place of a remedy that is made before anything is driven.
  RemedyTurn TurnInstead(const PlanOrigin& origin);
  bool AtGoal(const messages::PoseEstimate& estimate) const;
  messages::MotionVote& NextTurn(const messages::PoseEstimate& estimate);
  // Returns kTurningToDrive for a turn after whose end the rover may drive straight on, else
  // kTurning.
  Stage StageOf(const messages::MotionVote& turn) const;

  GestaltParams params_;
  messages::Goal goal_O_;
  Stage stage_ = Stage::kStarting;
  Evaluation evaluation_;
  Manoeuvre manoeuvre_;
  PlansOnTheMove plans_;
  Search search_;
  Progress progress_;
  FeltHazards felt_;
  Drift drift_;
};

}  // namespace rockyard::navigation

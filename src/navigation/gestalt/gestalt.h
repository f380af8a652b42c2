// GESTALT, the map-based navigator of Goldberg 2002, section 4: look, map, vote, drive an arc
// blindly, look again.
//
// A cycle begins at rest:
//   1. At the goal within goal_tolerance: arrived. Out of time, or no progress for long: given up.
//   2. Look ahead; the points go into the map, and every motion is voted on.
//   3. Best forward vote below min_fwd_threshold: look behind, too, and vote again.
//   4. Drive the chosen arc for min(step, distance to the goal), or turn in place.
//   5. After a turn that was better than every arc: the straight drive that it was voted on with
//      (Howard 2012). After one for want of a way: another look.
// Nothing to choose after turning in place by search_turn: given up.
//
// Drives and turns end by what is measured on board. A hazard that the rover feels on the way
// (tilt, joint angles, motor current, contact) ends a drive: the rover marks an obstacle where it
// feels it (FeltPlaces), backs off along the arc unless it touches something at that end too, and
// begins a cycle. The paper names these safeguards, not what follows; all of it is assumed. Draws
// no random numbers.
//
// That is the cycle at rest. With continuous.cycle csod or csad forward drives are replaced on the
// move (continuous_drive.cc, Howard 2012, section 2); the rover comes back to the cycle at rest
// where it feels a hazard, where no plan on the move is safe, and where none is ready in time.
//
// All of this goes on in the frame O of odometry_frame.h, which is the world until the estimate is
// corrected. A correction moves the goal, and neither clears nor smears the map.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "navigation/gestalt/felt.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/map.h"
#include "navigation/gestalt/splines.h"
#include "navigation/gestalt/votes.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"
#include "navigation/odometry_frame.h"

namespace rockyard::navigation {

// The drive cycle; map_ and voter_ do the rest.
class GestaltNavigator final : public Navigator {
 public:
  // `full_speed_m_s` of the fastest rim, which limits how fast splines may bend; by itself that of
  // Athena (Howard 2012, section 3).
  GestaltNavigator(const GestaltParams& params, const messages::Goal& goal,
                   double full_speed_m_s = 0.07);

  NavigatorDecision Decide(const NavigatorInput& input) override;

  // Forgets the map, which lies where the rover no longer stands, but for what it felt since its
  // last progress: no look would find that again. A manoeuvre under way ends as it would have; a
  // search begins anew.
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;

  // Moves the goal. Progress towards it is counted from here.
  void OnCorrection(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;

  // Keeps the map and what was felt. With the next goal, progress is counted and a search begun
  // anew.
  void SetGoal(const messages::Goal& goal, GoalChange change) override;

  // Returns the last decision with its map and votes.
  const messages::NavigationView* view() const override;

  PlanCounts plan_counts() const override { return counts_; }

 private:
  enum class Mode { kStarting, kLookingAhead, kLookingBehind, kDriving, kBackingOff, kTurning };

  // Where a plan begins: a pose in O, and the curvature that the rover steers there.
  struct PlanOrigin {
    messages::PoseEstimate pose;
    double curvature_per_m = 0.0;
  };

  NavigatorDecision DecideInO(const NavigatorInput& input);
  NavigatorDecision BeginCycle(const NavigatorInput& input);
  NavigatorDecision OnCloud(const NavigatorInput& input);
  NavigatorDecision Choose(const NavigatorInput& input);
  NavigatorDecision ContinueDrive(const NavigatorInput& input);
  NavigatorDecision ContinueBackOff(const NavigatorInput& input);
  NavigatorDecision ContinueTurn(const NavigatorInput& input);
  NavigatorDecision OnFelt(const NavigatorInput& input);

  // On the move: continuous_drive.cc. `driven_m` of the motion under way.
  NavigatorDecision DriveOn(const NavigatorInput& input, double driven_m);
  NavigatorDecision EndMotion(const NavigatorInput& input);
  NavigatorDecision Replan(const NavigatorInput& input, double driven_m);
  NavigatorDecision ReplaceMotion(const NavigatorInput& input, const PlanOrigin& origin);
  NavigatorDecision OnNoSafePlan(double driven_m);
  NavigatorDecision BeginSpline(const messages::Spline& spline, const NavigatorInput& input);
  PlanOrigin OriginOfNextPlan(const NavigatorInput& input, const messages::PoseEstimate& seen,
                              double driven_m) const;
  // Where the motion under way leads from `from`, which lies on it.
  messages::PoseEstimate PlaceOnMotion(const messages::PoseEstimate& from, double from_m,
                                       double to_m) const;
  messages::MotionCommand MotionAt(double driven_m) const;
  void Judge(const PlanOrigin& origin);
  const messages::Spline* TakeSafeSpline();

  NavigatorDecision Look(Mode mode);
  NavigatorDecision BeginDrive(const messages::MotionCommand& arc, const NavigatorInput& input);
  NavigatorDecision Begin(Mode mode, const messages::MotionCommand& motion, double leg,
                          const NavigatorInput& input);
  messages::MotionVote& NextTurn(const messages::PoseEstimate& estimate);
  void MarkVetoes();
  void FillView(const PlanOrigin& origin, const messages::AttitudeEstimate& attitude);

  bool Progresses(const messages::PoseEstimate& estimate);
  bool Feels(const NavigatorInput& input) const;
  bool TimedOut(const NavigatorInput& input) const;
  bool AtGoal(const messages::PoseEstimate& estimate) const;

  GestaltParams params_;
  messages::Goal goal_W_;
  OdometryFrame frame_;
  messages::Goal goal_;  // in O, as all that follows
  GestaltMap map_;
  ArcVoter voter_;
  std::optional<SplineVoter> spline_voter_;  // with csad

  Mode mode_ = Mode::kStarting;
  messages::MotionCommand motion_;
  messages::PoseEstimate anchor_;  // estimate when the running manoeuvre began
  double began_s_ = 0.0;           // on-board clock then
  double leg_ = 0.0;               // length of the running drive, m, or angle of the turn, rad
  double turned_rad_ = 0.0;        // of the running turn, the way that it was told
  bool drives_after_turn_ = false;
  double last_heading_rad_ = 0.0;  // at the last tick of it
  bool felt_since_start_ = false;  // a hazard without a break since the manoeuvre began

  double searched_rad_ = 0.0;  // turned in place since the last drive
  int search_direction_ = 0;   // kept during a search; 0: none yet

  double best_goal_distance_m_ = std::numeric_limits<double>::infinity();
  std::int64_t fruitless_cycles_ = 0;
  std::int64_t felt_hazards_ = 0;                // in a row without progress
  FeltPlaces felt_places_;                       // of these
  std::vector<messages::MotionCommand> vetoed_;  // felt on since the last manoeuvre that was ended

  // Of the drive under way.
  bool replans_ = false;                    // it is replaced on the move
  std::optional<messages::Spline> spline_;  // that it follows, instead of motion_'s arc
  bool awaits_look_ = false;                // one was asked for on the move
  bool late_ = false;                       // it ended before that was answered
  double speed_m_s_ = 0.0;                  // as measured, when that was asked for
  double last_driven_m_ = 0.0;              // at the last tick
  double last_time_s_ = 0.0;
  double steered_per_m_ = 0.0;  // the curvature for which the wheels stand
  std::int64_t moves_ = 0;      // numbers motions that are replaced on the move
  PlanCounts counts_;

  MotionVotes votes_;  // after the last look
  SplineVotes spline_votes_;
  bool looked_behind_ = false;
  std::int64_t decisions_ = 0;
  messages::NavigationView view_;
};

// For a set of navigators.
NavigatorDescription<GestaltParams> DescribeGestalt();

}  // namespace rockyard::navigation

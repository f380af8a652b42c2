// The part of GestaltCycle on the move (Howard 2012, section 2). Once a fraction of the motion
// under way is driven the rover looks; where the plan that follows is ready, it replaces that
// motion. Motions are arcs (CSOD), for whose change the rover stands to steer, or clothoid splines
// (CSAD), which begin with the curvature that it steers.
#include <cmath>

#include "core/check.h"
#include "math/pose.h"
#include "navigation/gestalt/cycle.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {
namespace {

using messages::PoseEstimate;

// Returns where the rover looked from, in O. Odometry, whose frame is D, says how the rover moved
// since: X_OL = X_OR (X_DR)^-1 X_DL.
PoseEstimate LookedFrom(const NavigatorInput& input) {
  const PoseEstimate& looked_D = input.look->odometry;
  const math::Pose2 looked_O =
      math::Carried(Planar(input.estimate), Planar(input.odometry), Planar(looked_D));
  return {looked_O.x_m, looked_O.y_m, looked_O.heading_rad, looked_D.distance_m};
}

}  // namespace

NavigatorDecision GestaltCycle::DriveOn(const NavigatorInput& input) {
  plans_.Measure(manoeuvre_.measured(), input.time_s);
  manoeuvre_.Steer();
  if (plans_.awaits_look() && input.cloud != nullptr) return Replan(input);
  if (manoeuvre_.Ends(input)) return EndMotion(input);
  NavigatorDecision decision = Move(manoeuvre_.Command());
  if (!plans_.Asks(manoeuvre_.leg())) return decision;
  decision.look = messages::LookDirection::kAhead;
  decision.looks_on_the_move = true;
  return decision;
}

// The motion is driven, and nothing has replaced it.
NavigatorDecision GestaltCycle::EndMotion(const NavigatorInput& input) {
  if (plans_.WaitsAtEnd() && !manoeuvre_.TimedOut(input)) return Move({});
  plans_.Drop();
  felt_.ForgetVetoes();
  return BeginCycle(input);
}

// A look on the move has answered.
NavigatorDecision GestaltCycle::Replan(const NavigatorInput& input) {
  EXPECT(input.look != nullptr);
  plans_.Answer();
  if (AtGoal(input.estimate)) return Finish(NavigatorStatus::kArrived);
  if (!Progresses(input.estimate)) return Finish(NavigatorStatus::kGaveUp);
  const PoseEstimate seen = LookedFrom(input);
  const messages::AttitudeEstimate& attitude = input.look->attitude;
  evaluation_.See(*input.cloud,
                  math::MakePose({seen.x_m, seen.y_m, attitude.z_m}, seen.heading_rad,
                                 attitude.pitch_rad, attitude.roll_rad),
                  input.estimate);
  // A predicted plan begins on the motion under way, s = s_look + v (t - t_look) along it.
  const bool predicts = params_.continuous.plan_start == PlanStart::kPredicted;
  const PlanOrigin origin =
      MadeGood(predicts ? manoeuvre_.Ahead(seen, plans_.WaySince(*input.look, input.time_s))
                        : PlanOrigin{input.estimate, manoeuvre_.steered_per_m()});
  evaluation_.Vote(origin, goal_O_, felt_);
  const bool turns = TurnInstead(origin).any();
  const NavigatorDecision next = turns ? StopToTurn() : ReplaceMotion(input, origin);
  evaluation_.Show(origin, attitude, goal_O_);
  return next;
}

NavigatorDecision GestaltCycle::ReplaceMotion(const NavigatorInput& input,
                                              const PlanOrigin& origin) {
  if (evaluation_.votes_on_splines()) {
    const messages::Spline* safe = evaluation_.TakeSafeSpline();
    if (safe == nullptr) return OnNoSafePlan();
    plans_.Start(origin.pose, input.estimate);
    felt_.ForgetVetoes();
    return BeginSpline(*safe, input);
  }
  MotionVotes& votes = evaluation_.votes();
  messages::MotionVote* arc = ChooseArc(votes, params_);
  // Backward arcs, rear cameras and searches are for a rover at rest.
  const bool safe =
      arc != nullptr && arc->motion.direction > 0 && arc->merged >= params_.votes.min_vote_goodness;
  if (!safe) return OnNoSafePlan();
  messages::MotionVote& turn = NextTurn(origin.pose);
  const bool turns = TurnsInPlace(turn, arc, params_);
  MarkChoice(votes, turns ? turn : *arc, params_);
  plans_.Start(origin.pose, input.estimate);
  felt_.ForgetVetoes();
  if (!turns) return BeginDrive(arc->motion, input);
  return Begin(StageOf(turn), turn.motion, std::abs(turn.turn_rad), input);
}

// At rest the rover votes anew, and turns by what its remedies make of that.
NavigatorDecision GestaltCycle::StopToTurn() {
  felt_.ForgetVetoes();
  return Look(Stage::kLookingAhead);
}

NavigatorDecision GestaltCycle::OnNoSafePlan() {
  plans_.Refuse();
  const bool finishes = params_.continuous.no_safe_plan == NoSafePlan::kFinish;
  if (finishes && !manoeuvre_.Completed()) return Move(manoeuvre_.Command());
  felt_.ForgetVetoes();
  return Look(Stage::kLookingAhead);
}

}  // namespace rockyard::navigation

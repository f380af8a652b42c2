#include "navigation/gestalt/cycle.h"

#include <algorithm>
#include <cmath>

#include "math/angles.h"
#include "math/pose.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {
namespace {

using messages::LookDirection;
using messages::MotionCommand;
using messages::MotionKind;
using messages::MotionVote;
using messages::PoseEstimate;

math::Transform BelievedPose(const NavigatorInput& input) {
  const PoseEstimate& e = input.estimate;
  return math::MakePose({e.x_m, e.y_m, input.attitude.z_m}, e.heading_rad, input.attitude.pitch_rad,
                        input.attitude.roll_rad);
}

}  // namespace

GestaltCycle::GestaltCycle(const GestaltParams& params, const messages::Goal& goal_O,
                           double full_speed_m_s)
    : params_(params),
      goal_O_(goal_O),
      evaluation_(params, full_speed_m_s),
      manoeuvre_(params),
      plans_(params.continuous),
      search_(params),
      progress_(params.drive),
      felt_(params),
      drift_(params.remedies.against_drift) {}

NavigatorDecision GestaltCycle::Decide(const NavigatorInput& input) {
  // The goal is asked for between steps, or at every tick where the parameters say so.
  const bool asks = !moves() || params_.drive.arrival_check == ArrivalCheck::kWhileDriving;
  if (asks && AtGoal(input.estimate)) return Finish(NavigatorStatus::kArrived);
  if (params_.drive.time_out_s > 0.0 && input.time_s >= params_.drive.time_out_s) {
    return Finish(NavigatorStatus::kGaveUp);
  }
  if (moves()) manoeuvre_.Follow(input);
  switch (stage_) {
    case Stage::kStarting:
      return BeginCycle(input);
    case Stage::kLookingAhead:
    case Stage::kLookingBehind:
      return input.cloud != nullptr ? OnCloud(input) : Look(stage_);
    case Stage::kDriving:
      return ContinueDrive(input);
    case Stage::kBackingOff:
      return ContinueBackOff(input);
    case Stage::kTurning:
    case Stage::kTurningToDrive:
    case Stage::kTurningToStep:
      return ContinueTurn(input);
  }
  return BeginCycle(input);
}

void GestaltCycle::OnPoseUpdate(const PoseEstimate& before, const PoseEstimate& after) {
  evaluation_.Forget(after);
  felt_.Move(before, after, evaluation_.map());
  felt_.ForgetVetoes();
  search_.ForgetGround();
  manoeuvre_.OnPoseUpdate(before, after);
  progress_.CountFrom(DistanceToGoal_m(after));
  // What was seen from where the rover stood is no longer told: it is asked for again.
  plans_.Drop();
  // What was seen ahead is forgotten with the map.
  if (stage_ == Stage::kLookingBehind) stage_ = Stage::kLookingAhead;
}

void GestaltCycle::OnCorrection(const PoseEstimate& before_O, const PoseEstimate& after_O,
                                const messages::Goal& goal_O, double left_m) {
  drift_.Correct(after_O, left_m);
  const double before_m = DistanceToGoal_m(before_O);
  goal_O_ = goal_O;
  progress_.Shift(DistanceToGoal_m(after_O) - before_m);
}

void GestaltCycle::SetGoal(const messages::Goal& goal_O, GoalChange change) {
  goal_O_ = goal_O;
  if (change == GoalChange::kMoved) return;
  progress_.Restart();
  search_.Restart();
}

NavigatorDecision GestaltCycle::BeginCycle(const NavigatorInput& input) {
  if (AtGoal(input.estimate)) return Finish(NavigatorStatus::kArrived);
  if (!Progresses(input.estimate)) return Finish(NavigatorStatus::kGaveUp);
  return Look(Stage::kLookingAhead);
}

NavigatorDecision GestaltCycle::Look(Stage stage) {
  stage_ = stage;
  const bool ahead = stage == Stage::kLookingAhead;
  return {NavigatorStatus::kDriving, ahead ? LookDirection::kAhead : LookDirection::kBehind, {}};
}

// A look has answered: points into the map, votes, and either a look behind or a choice.
NavigatorDecision GestaltCycle::OnCloud(const NavigatorInput& input) {
  const bool ahead = input.cloud->direction == LookDirection::kAhead;
  // An answer to a look that a pose update has overtaken.
  if (!ahead && stage_ == Stage::kLookingAhead) return Look(stage_);
  const PlanOrigin origin = MadeGood({input.estimate, manoeuvre_.steered_per_m()});
  evaluation_.See(*input.cloud, BelievedPose(input), input.estimate);
  evaluation_.Vote(origin, goal_O_, felt_);
  const RemedyTurn turn = TurnInstead(origin);
  progress_.Rest();
  if (turn.any()) {
    evaluation_.Show(origin, input.attitude, goal_O_);
    return BeginTurnInstead(turn, input);
  }
  if (const messages::Spline* safe = evaluation_.TakeSafeSpline()) {
    evaluation_.Show(origin, input.attitude, goal_O_);
    return BeginSpline(*safe, input);
  }
  // Step 3 of the cycle: where forward arcs look bad, the rear cameras are asked, too.
  const bool looks_behind = ahead && params_.drive.rear_cameras &&
                            BestVote(evaluation_.votes().forward) < params_.votes.min_fwd_threshold;
  return looks_behind ? Look(Stage::kLookingBehind) : Choose(input);
}

// Chooses by step 7 of the paper and what it leaves open: an arc, a turn in place, or giving up
// after a search all round.
NavigatorDecision GestaltCycle::Choose(const NavigatorInput& input) {
  MotionVotes& votes = evaluation_.votes();
  MotionVote* chosen = ChooseArc(votes, params_);
  MotionVote& turn = NextTurn(input.estimate);
  const bool turns = !search_.HasTurnedAround() && TurnsInPlace(turn, chosen, params_);
  const bool searches = chosen == nullptr || chosen->merged < params_.votes.min_vote_goodness;
  if (turns) chosen = &turn;
  if (chosen != nullptr) MarkChoice(votes, *chosen, params_);
  evaluation_.Show({input.estimate, manoeuvre_.steered_per_m()}, input.attitude, goal_O_);
  if (chosen == nullptr) return Finish(NavigatorStatus::kGaveUp);
  search_.KeepTo(turns && searches ? turn.motion.direction : 0);
  if (!turns) return BeginDrive(chosen->motion, input);
  return Begin(searches ? Stage::kTurning : StageOf(turn), turn.motion, std::abs(turn.turn_rad),
               input);
}

NavigatorDecision GestaltCycle::BeginTurnInstead(const RemedyTurn& turn,
                                                 const NavigatorInput& input) {
  if (turn.angle_rad == 0.0) return BeginStep(input);
  return Begin(turn.drives ? Stage::kTurningToStep : Stage::kTurning,
               {MotionKind::kTurnInPlace, 0.0, turn.angle_rad < 0.0 ? -1 : +1},
               std::abs(turn.angle_rad), input);
}

NavigatorDecision GestaltCycle::BeginStep(const NavigatorInput& input) {
  plans_.Stop();
  search_.ForgetGround();
  return Begin(Stage::kDriving, {MotionKind::kArc, 0.0, +1},
               std::min(params_.drive.step_m, DistanceToGoal_m(input.estimate)), input);
}

NavigatorDecision GestaltCycle::BeginDrive(MotionCommand arc, const NavigatorInput& input) {
  const bool replaced = params_.continuous.cycle == DriveCycle::kCsod && arc.direction > 0;
  if (replaced) {
    arc.move = plans_.Begin(input.time_s);
  } else {
    plans_.Stop();
  }
  const double length_m = replaced ? params_.continuous.motion_m : params_.drive.step_m;
  search_.ForgetGround();
  return Begin(Stage::kDriving, arc, std::min(length_m, DistanceToGoal_m(input.estimate)), input);
}

NavigatorDecision GestaltCycle::BeginSpline(const messages::Spline& spline,
                                            const NavigatorInput& input) {
  search_.ForgetGround();
  stage_ = Stage::kDriving;
  manoeuvre_.Begin(spline, plans_.Begin(input.time_s),
                   std::min(params_.continuous.motion_m, DistanceToGoal_m(input.estimate)), input);
  return Move(manoeuvre_.Command());
}

NavigatorDecision GestaltCycle::Begin(Stage stage, const MotionCommand& motion, double leg,
                                      const NavigatorInput& input) {
  stage_ = stage;
  manoeuvre_.Begin(motion, leg, input);
  return Move(manoeuvre_.Command());
}

// Blind driving along the arc; only its length, a felt hazard or its time limit ends it.
NavigatorDecision GestaltCycle::ContinueDrive(const NavigatorInput& input) {
  if (manoeuvre_.FeelsAnew(input)) return OnFelt(input);
  if (plans_.on()) return DriveOn(input);
  if (!manoeuvre_.Ends(input)) return Move(manoeuvre_.Command());
  felt_.ForgetVetoes();
  return BeginCycle(input);
}

NavigatorDecision GestaltCycle::ContinueTurn(const NavigatorInput& input) {
  const bool stops = manoeuvre_.FeelsAnew(input);
  if (!stops && !manoeuvre_.Ends(input)) return Move(manoeuvre_.Command());
  search_.Count(manoeuvre_.measured());
  if (stops) return OnFelt(input);
  felt_.ForgetVetoes();
  // A turn that ran out of time leads elsewhere.
  if (stage_ == Stage::kTurning || !manoeuvre_.Completed()) return BeginCycle(input);
  if (stage_ == Stage::kTurningToStep) return BeginStep(input);
  return BeginDrive({MotionKind::kArc, 0.0, +1}, input);
}

NavigatorDecision GestaltCycle::ContinueBackOff(const NavigatorInput& input) {
  const MotionCommand back = manoeuvre_.Command();
  const bool ends = manoeuvre_.Ends(input) || Touches(input, back.direction);
  return ends ? BeginCycle(input) : Move(back);
}

// A felt hazard: mark it, back off by what was driven, look again.
NavigatorDecision GestaltCycle::OnFelt(const NavigatorInput& input) {
  if (!progress_.GoesOnAfterFelt()) return Finish(NavigatorStatus::kGaveUp);
  const MotionCommand motion = manoeuvre_.Command();
  if (turns()) {
    search_.Feel(motion.direction);
    return BeginCycle(input);
  }
  plans_.Drop();
  felt_.Feel(input, motion, evaluation_.map());
  // Back along the same arc, no farther than it came.
  const double leg_m = std::min(manoeuvre_.measured(), params_.drive.back_off_m);
  if (leg_m <= 0.0 || Touches(input, -motion.direction)) return BeginCycle(input);
  const MotionCommand back{motion.kind, motion.curvature_per_m, -motion.direction};
  return Begin(Stage::kBackingOff, back, leg_m, input);
}

double GestaltCycle::DistanceToGoal_m(const PoseEstimate& estimate) const {
  return TowardsGoal(estimate, goal_O_).distance_m;
}

// Counts a cycle; too many of them without progress end the drive.
bool GestaltCycle::Progresses(const PoseEstimate& estimate) {
  const Progress::Cycle cycle = progress_.BeginCycle(DistanceToGoal_m(estimate));
  if (cycle == Progress::Cycle::kGains) felt_.ForgetPlaces();
  return cycle != Progress::Cycle::kGivesUp;
}

PlanOrigin GestaltCycle::MadeGood(PlanOrigin origin) const {
  double& heading_rad = origin.pose.heading_rad;
  const double drift_rad = drift_.Angle_rad(heading_rad);
  if (drift_rad != 0.0) heading_rad = math::WrapAngle(heading_rad + drift_rad);
  return origin;
}

RemedyTurn GestaltCycle::TurnInstead(const PlanOrigin& origin) {
  progress_.CountTurn(origin.pose.heading_rad);
  RemedyTurn turn = evaluation_.TurnInstead(origin, goal_O_, progress_.turned_rad());
  if (turn.angle_rad != 0.0) {
    turn.angle_rad = search_.Round_rad(turn.angle_rad);
    if (turn.angle_rad == 0.0) return {};
  }
  // A rover that has looked all round drives by what it saw.
  turn.drives = turn.drives || (turn.any() && search_.HasTurnedAround());
  return turn;
}

bool GestaltCycle::AtGoal(const PoseEstimate& estimate) const {
  return DistanceToGoal_m(estimate) <= params_.waypoints.goal_tolerance_m;
}

MotionVote& GestaltCycle::NextTurn(const PoseEstimate& estimate) {
  return search_.NextTurn(evaluation_.votes(), TowardsGoal(estimate, goal_O_).bearing_rad);
}

GestaltCycle::Stage GestaltCycle::StageOf(const MotionVote& turn) const {
  return turn.hazard > params_.drive.min_drive_goodness ? Stage::kTurningToDrive : Stage::kTurning;
}

}  // namespace rockyard::navigation

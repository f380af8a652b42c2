// GESTALT on the move (Howard 2012, section 2): once a fraction of the motion under way is driven
// the rover looks; where the plan that follows is ready, it replaces that motion. Arcs (CSOD), for
// whose change the rover stands to steer, or clothoid splines (CSAD), which begin with the
// curvature that it steers.
#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "math/angles.h"
#include "math/pose.h"
#include "navigation/gestalt/choice.h"
#include "navigation/gestalt/curvature_law.h"
#include "navigation/gestalt/gestalt.h"

namespace rockyard::navigation {
namespace {

using messages::MotionCommand;
using messages::MotionKind;
using messages::PoseEstimate;

// X_OL = X_OR (X_DR)^-1 X_DL, of planar poses: where L lies in O, if R and L lie in D.
PoseEstimate SeenFrom(const PoseEstimate& X_OR, const PoseEstimate& X_DR,
                      const PoseEstimate& X_DL) {
  const double turn_rad = X_OR.heading_rad - X_DR.heading_rad;
  const double cosine = std::cos(turn_rad);
  const double sine = std::sin(turn_rad);
  const double dx_m = X_DL.x_m - X_DR.x_m;
  const double dy_m = X_DL.y_m - X_DR.y_m;
  return {X_OR.x_m + cosine * dx_m - sine * dy_m, X_OR.y_m + sine * dx_m + cosine * dy_m,
          math::WrapAngle(X_DL.heading_rad + turn_rad), X_DL.distance_m};
}

}  // namespace

NavigatorDecision GestaltNavigator::DriveOn(const NavigatorInput& input, double driven_m) {
  const double tick_s = input.time_s - last_time_s_;
  const double speed_m_s = tick_s > 0.0 ? (driven_m - last_driven_m_) / tick_s : 0.0;
  last_driven_m_ = driven_m;
  last_time_s_ = input.time_s;
  steered_per_m_ = MotionAt(driven_m).curvature_per_m;
  if (awaits_look_ && input.cloud != nullptr) return Replan(input, driven_m);
  if (driven_m >= leg_ || TimedOut(input)) return EndMotion(input);
  NavigatorDecision decision{NavigatorStatus::kDriving, {}, MotionAt(driven_m)};
  if (awaits_look_ || driven_m < params_.continuous.replan_fraction * leg_) return decision;
  decision.look = messages::LookDirection::kAhead;
  decision.looks_on_the_move = true;
  awaits_look_ = true;
  speed_m_s_ = speed_m_s;
  return decision;
}

// The motion is driven, and nothing has replaced it.
NavigatorDecision GestaltNavigator::EndMotion(const NavigatorInput& input) {
  if (awaits_look_ && !late_) {
    late_ = true;
    ++counts_.late;
  }
  const bool waits = awaits_look_ && params_.continuous.late_plan == LatePlan::kWait;
  if (waits && !TimedOut(input)) return {NavigatorStatus::kDriving, {}, {}};
  awaits_look_ = false;
  vetoed_.clear();
  return BeginCycle(input);
}

// A look on the move has answered.
NavigatorDecision GestaltNavigator::Replan(const NavigatorInput& input, double driven_m) {
  EXPECT(input.look != nullptr);
  awaits_look_ = false;
  ++counts_.plans;
  if (AtGoal(input.estimate)) return {NavigatorStatus::kArrived, {}, {}};
  if (!Progresses(input.estimate)) return {NavigatorStatus::kGaveUp, {}, {}};
  // Odometry says how the rover moved since it looked.
  const PoseEstimate seen = SeenFrom(input.estimate, input.odometry, input.look->odometry);
  map_.BeginCycle(input.estimate.x_m, input.estimate.y_m);
  map_.Add(*input.cloud,
           math::MakePose({seen.x_m, seen.y_m, input.look->attitude.z_m}, seen.heading_rad,
                          input.look->attitude.pitch_rad, input.look->attitude.roll_rad));
  const PlanOrigin origin = OriginOfNextPlan(input, seen, driven_m);
  Judge(origin);
  looked_behind_ = false;
  const NavigatorDecision next = ReplaceMotion(input, origin);
  FillView(origin, input.look->attitude);
  return next;
}

NavigatorDecision GestaltNavigator::ReplaceMotion(const NavigatorInput& input,
                                                  const PlanOrigin& origin) {
  const double driven_m = last_driven_m_;
  const auto replace = [&] {
    ++counts_.started;
    const double dx_m = origin.pose.x_m - input.estimate.x_m;
    const double dy_m = origin.pose.y_m - input.estimate.y_m;
    counts_.start_error_squared_m2 += dx_m * dx_m + dy_m * dy_m;
    vetoed_.clear();
  };
  if (spline_voter_) {
    const messages::Spline* safe = TakeSafeSpline();
    if (safe == nullptr) return OnNoSafePlan(driven_m);
    replace();
    return BeginSpline(*safe, input);
  }
  messages::MotionVote* arc = ChooseArc(votes_, params_);
  const bool safe =
      arc != nullptr && arc->motion.direction > 0 && arc->merged >= params_.votes.min_vote_goodness;
  if (!safe) return OnNoSafePlan(driven_m);
  messages::MotionVote& turn = NextTurn(origin.pose);
  const bool turns = TurnsInPlace(turn, arc, params_);
  MarkChoice(votes_, turns ? turn : *arc, params_);
  replace();
  if (!turns) return BeginDrive(arc->motion, input);
  drives_after_turn_ = turn.hazard > params_.drive.min_drive_goodness;
  return Begin(Mode::kTurning, turn.motion, std::abs(turn.turn_rad), input);
}

NavigatorDecision GestaltNavigator::OnNoSafePlan(double driven_m) {
  ++counts_.unsafe;
  if (params_.continuous.no_safe_plan == NoSafePlan::kFinish && driven_m < leg_) {
    return {NavigatorStatus::kDriving, {}, MotionAt(driven_m)};
  }
  vetoed_.clear();
  return Look(Mode::kLookingAhead);
}

NavigatorDecision GestaltNavigator::BeginSpline(const messages::Spline& spline,
                                                const NavigatorInput& input) {
  searched_rad_ = 0.0;
  spline_ = spline;
  replans_ = true;
  const double left_m = TowardsGoal(input.estimate, goal_).distance_m;
  const MotionCommand start{MotionKind::kArc, spline.start_per_m, +1};
  const NavigatorDecision begun =
      Begin(Mode::kDriving, start, std::min(params_.continuous.motion_m, left_m), input);
  return {begun.status, {}, MotionAt(0.0)};
}

GestaltNavigator::PlanOrigin GestaltNavigator::OriginOfNextPlan(const NavigatorInput& input,
                                                                const PoseEstimate& seen,
                                                                double driven_m) const {
  if (params_.continuous.plan_start == PlanStart::kEstimated) {
    return {input.estimate, MotionAt(driven_m).curvature_per_m};
  }
  // Along the motion under way from where it looked, s = s_look + v (t - t_look), to its end at
  // most.
  const double look_m = seen.distance_m - anchor_.distance_m;
  const double since_s = input.time_s - input.look->time_s;
  const double start_m = std::clamp(look_m + speed_m_s_ * since_s, look_m, std::max(look_m, leg_));
  return {PlaceOnMotion(seen, look_m, start_m), MotionAt(start_m).curvature_per_m};
}

MotionCommand GestaltNavigator::MotionAt(double driven_m) const {
  MotionCommand motion = motion_;
  if (!spline_) return motion;
  const CurvatureLaw& law = spline_voter_->law();
  motion.curvature_per_m = CurvatureAt(*spline_, driven_m, law);
  motion.curvature_rate_per_m2 = CurvatureRateAt(*spline_, driven_m, law);
  motion.speed_share = SpeedShare(params_.speed, motion.curvature_per_m);
  return motion;
}

PoseEstimate GestaltNavigator::PlaceOnMotion(const PoseEstimate& from, double from_m,
                                             double to_m) const {
  const ClothoidPoint start{from.x_m, from.y_m, from.heading_rad};
  const ClothoidPoint place =
      spline_ ? AlongSpline(start, *spline_, from_m, to_m, spline_voter_->law())
              : AlongClothoid(start, motion_.curvature_per_m, 0.0, to_m - from_m);
  return {place.x_m, place.y_m, math::WrapAngle(place.heading_rad),
          from.distance_m + to_m - from_m};
}

void GestaltNavigator::Judge(const PlanOrigin& origin) {
  const GoodnessGrid& grid = map_.Evaluate();
  votes_ = voter_.Vote(grid, origin.pose, goal_);
  MarkVetoes();
  if (!spline_voter_) return;
  spline_votes_ = spline_voter_->Vote(grid, origin.pose, origin.curvature_per_m, goal_);
}

const messages::Spline* GestaltNavigator::TakeSafeSpline() {
  const messages::SplineVote* best = ChooseSpline(spline_votes_, params_);
  if (best == nullptr || best->merged < params_.votes.min_vote_goodness) return nullptr;
  messages::SplineVote& chosen =
      spline_votes_[static_cast<std::size_t>(best - spline_votes_.data())];
  chosen.chosen = true;
  return &chosen.spline;
}

}  // namespace rockyard::navigation

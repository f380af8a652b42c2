#include "navigation/gestalt/gestalt.h"

#include <algorithm>
#include <cmath>

#include "math/angles.h"
#include "math/pose.h"
#include "navigation/gestalt/choice.h"
#include "navigation/gestalt/curvature_law.h"

namespace rockyard::navigation {
namespace {

CostOfMap CostOf(const GestaltGridParams& grid) {
  return {.cell_m = std::sqrt(grid.xstep_m * grid.ystep_m),
          .area_m2 = (grid.xN_m - grid.x0_m) * (grid.yN_m - grid.y0_m)};
}

using messages::LookDirection;
using messages::MotionCommand;
using messages::MotionKind;
using messages::MotionVote;
using messages::PoseEstimate;

// Angles that add up to a full turn may miss it by rounding.
constexpr double kRounding_rad = 1e-9;

math::Transform BelievedPose(const NavigatorInput& input) {
  const PoseEstimate& e = input.estimate;
  return math::MakePose({e.x_m, e.y_m, input.attitude.z_m}, e.heading_rad, input.attitude.pitch_rad,
                        input.attitude.roll_rad);
}

// Whether something presses on the end of the vehicle that leads in the direction.
bool Touches(const NavigatorInput& input, int direction) {
  if (direction < 0) return input.touches_behind;
  return input.vehicle_hazard != nullptr &&
         input.vehicle_hazard->kind == messages::VehicleHazardKind::kContact;
}

// Of a motion that is replaced on the move a step ends where the next plan is made.
GestaltParams ForArcVotes(const GestaltParams& params) {
  GestaltParams voting = params;
  if (params.continuous.cycle == DriveCycle::kStopAndLook) return voting;
  voting.drive.step_m = std::max(params.drive.step_m, params.continuous.ReplanDistance_m());
  return voting;
}

}  // namespace

GestaltNavigator::GestaltNavigator(const GestaltParams& params, const messages::Goal& goal,
                                   double full_speed_m_s)
    : params_(params), goal_W_(goal), goal_(goal), map_(params.map), voter_(ForArcVotes(params)) {
  if (params_.continuous.cycle == DriveCycle::kCsad) {
    spline_voter_.emplace(params_, full_speed_m_s);
  }
}

NavigatorDecision GestaltNavigator::Decide(const NavigatorInput& input) {
  NavigatorInput input_O = input;
  input_O.estimate = frame_.FromWorld(input.estimate);
  return DecideInO(input_O);
}

NavigatorDecision GestaltNavigator::DecideInO(const NavigatorInput& input) {
  const bool moves =
      mode_ == Mode::kDriving || mode_ == Mode::kBackingOff || mode_ == Mode::kTurning;
  // The goal is asked for between steps, or at every tick where the parameters say so.
  const bool asks = !moves || params_.drive.arrival_check == ArrivalCheck::kWhileDriving;
  if (asks && AtGoal(input.estimate)) return Finish(NavigatorStatus::kArrived);
  if (params_.drive.time_out_s > 0.0 && input.time_s >= params_.drive.time_out_s) {
    return Finish(NavigatorStatus::kGaveUp);
  }
  switch (mode_) {
    case Mode::kStarting:
      return BeginCycle(input);
    case Mode::kLookingAhead:
    case Mode::kLookingBehind:
      return input.cloud != nullptr ? OnCloud(input) : Look(mode_);
    case Mode::kDriving:
      return ContinueDrive(input);
    case Mode::kBackingOff:
      return ContinueBackOff(input);
    case Mode::kTurning:
      return ContinueTurn(input);
  }
  return BeginCycle(input);
}

void GestaltNavigator::OnPoseUpdate(const PoseEstimate& before_W, const PoseEstimate& after_W) {
  const PoseEstimate before = frame_.FromWorld(before_W);
  const PoseEstimate after = frame_.FromWorld(after_W);
  map_.Clear();
  map_.BeginCycle(after.x_m, after.y_m);
  felt_places_.Move(before, after, params_.drive.felt_radius_m, map_);
  // The ground that a search has seen is forgotten: it is searched again.
  searched_rad_ = 0.0;
  // Turned angles are differences of heading: the jump is none of them.
  last_heading_rad_ += after.heading_rad - before.heading_rad;
  vetoed_.clear();
  // Progress is counted from where the rover now believes to be.
  best_goal_distance_m_ = TowardsGoal(after, goal_).distance_m;
  // What was seen from where it stood is told no more: it is asked for again.
  awaits_look_ = false;
  // What was seen ahead is forgotten with the map.
  if (mode_ == Mode::kLookingBehind) mode_ = Mode::kLookingAhead;
}

void GestaltNavigator::OnCorrection(const PoseEstimate& before, const PoseEstimate& after) {
  const double before_m = TowardsGoal(frame_.FromWorld(before), goal_).distance_m;
  frame_.Correct(before, after);
  goal_ = frame_.FromWorld(goal_W_);
  // The best distance so far moves with the goal, so that what the rover gained stays gained.
  best_goal_distance_m_ += TowardsGoal(frame_.FromWorld(after), goal_).distance_m - before_m;
}

void GestaltNavigator::SetGoal(const messages::Goal& goal, GoalChange change) {
  goal_W_ = goal;
  goal_ = frame_.FromWorld(goal_W_);
  if (change == GoalChange::kMoved) return;
  // The next cycle counts from its distance on.
  best_goal_distance_m_ = std::numeric_limits<double>::infinity();
  felt_hazards_ = 0;
  searched_rad_ = 0.0;
  search_direction_ = 0;
}

const messages::NavigationView* GestaltNavigator::view() const {
  return decisions_ > 0 ? &view_ : nullptr;
}

NavigatorDecision GestaltNavigator::BeginCycle(const NavigatorInput& input) {
  if (AtGoal(input.estimate)) return Finish(NavigatorStatus::kArrived);
  if (!Progresses(input.estimate)) return Finish(NavigatorStatus::kGaveUp);
  return Look(Mode::kLookingAhead);
}

// A look has answered: points into the map, votes, and either a look behind or a choice.
NavigatorDecision GestaltNavigator::OnCloud(const NavigatorInput& input) {
  const bool ahead = input.cloud->direction == LookDirection::kAhead;
  // An answer to a look that a pose update has overtaken.
  if (!ahead && mode_ == Mode::kLookingAhead) return Look(mode_);
  if (ahead) map_.BeginCycle(input.estimate.x_m, input.estimate.y_m);
  map_.Add(*input.cloud, BelievedPose(input));
  const PlanOrigin origin{input.estimate, steered_per_m_};
  Judge(origin);
  looked_behind_ = !ahead;
  if (const messages::Spline* safe = TakeSafeSpline()) {
    FillView(origin, input.attitude);
    return BeginSpline(*safe, input);
  }
  // Step 3 of the cycle in gestalt.h: forward arcs look bad, so the rear cameras are asked, too.
  const bool looks_behind = ahead && params_.drive.rear_cameras &&
                            BestVote(votes_.forward) < params_.votes.min_fwd_threshold;
  return looks_behind ? Look(Mode::kLookingBehind) : Choose(input);
}

// Step 7 and what the paper leaves open: an arc, a point turn, or giving up after a search all
// round.
NavigatorDecision GestaltNavigator::Choose(const NavigatorInput& input) {
  MotionVote* chosen = ChooseArc(votes_, params_);
  // A search that has gone all the way round turns no further.
  const bool searched = searched_rad_ >= params_.drive.search_turn_rad - kRounding_rad;
  MotionVote& turn = NextTurn(input.estimate);
  const bool turns = !searched && TurnsInPlace(turn, chosen, params_);
  // A turn that leads better than every arc is a move like them; one for want of a way is a search.
  const bool searches = chosen == nullptr || chosen->merged < params_.votes.min_vote_goodness;
  if (turns) chosen = &turn;
  if (chosen != nullptr) MarkChoice(votes_, *chosen, params_);
  FillView({input.estimate, steered_per_m_}, input.attitude);
  if (chosen == nullptr) return Finish(NavigatorStatus::kGaveUp);
  search_direction_ = turns && searches ? turn.motion.direction : 0;
  drives_after_turn_ = turns && !searches && turn.hazard > params_.drive.min_drive_goodness;
  if (turns) return Begin(Mode::kTurning, turn.motion, std::abs(turn.turn_rad), input);
  return BeginDrive(chosen->motion, input);
}

NavigatorDecision GestaltNavigator::BeginDrive(const MotionCommand& arc,
                                               const NavigatorInput& input) {
  searched_rad_ = 0.0;
  spline_.reset();
  replans_ = params_.continuous.cycle == DriveCycle::kCsod && arc.direction > 0;
  const double length_m = replans_ ? params_.continuous.motion_m : params_.drive.step_m;
  const double left_m = TowardsGoal(input.estimate, goal_).distance_m;
  return Begin(Mode::kDriving, arc, std::min(length_m, left_m), input);
}

// A search turns one way only, by the amount of table 1: the other way lies what it has just seen.
MotionVote& GestaltNavigator::NextTurn(const PoseEstimate& estimate) {
  if (search_direction_ == 0) {
    return *ChoosePointTurn(votes_, TowardsGoal(estimate, goal_).bearing_rad);
  }
  return *PointTurnTo(votes_, search_direction_, params_.arcs.point_turn_amount_rad);
}

void GestaltNavigator::MarkVetoes() {
  for (auto* row : {&votes_.forward, &votes_.backward}) {
    for (MotionVote& vote : *row) {
      vote.vetoed = std::any_of(vetoed_.begin(), vetoed_.end(), [&](const MotionCommand& felt_on) {
        return felt_on.direction == vote.motion.direction &&
               felt_on.curvature_per_m == vote.motion.curvature_per_m;
      });
    }
  }
}

// Blind driving along the arc; only its length, a felt hazard or its time limit ends it.
NavigatorDecision GestaltNavigator::ContinueDrive(const NavigatorInput& input) {
  const double driven_m = input.estimate.distance_m - anchor_.distance_m;
  const bool feels = Feels(input);
  if (!feels) felt_since_start_ = false;
  // What was felt before the drive began counts again only after some way.
  const bool counts = !felt_since_start_ || driven_m >= params_.drive.felt_again_m;
  if (feels && counts) return OnFelt(input);
  if (replans_) return DriveOn(input, driven_m);
  if (driven_m < leg_ && !TimedOut(input)) return Move(motion_);
  vetoed_.clear();
  return BeginCycle(input);
}

NavigatorDecision GestaltNavigator::ContinueTurn(const NavigatorInput& input) {
  turned_rad_ +=
      motion_.direction * math::WrapAngle(input.estimate.heading_rad - last_heading_rad_);
  last_heading_rad_ = input.estimate.heading_rad;
  const bool feels = Feels(input);
  if (!feels) felt_since_start_ = false;
  // What was felt before the turn began does not stop it.
  const bool stops = feels && !felt_since_start_;
  if (!stops && turned_rad_ < leg_ && !TimedOut(input)) return Move(motion_);
  searched_rad_ += std::abs(turned_rad_);
  if (stops) return OnFelt(input);
  vetoed_.clear();
  const bool timed_out = turned_rad_ < leg_;
  if (drives_after_turn_ && !timed_out) return BeginDrive({MotionKind::kArc, 0.0, +1}, input);
  return BeginCycle(input);
}

NavigatorDecision GestaltNavigator::ContinueBackOff(const NavigatorInput& input) {
  const double driven_m = input.estimate.distance_m - anchor_.distance_m;
  const bool ends = driven_m >= leg_ || Touches(input, motion_.direction) || TimedOut(input);
  return ends ? BeginCycle(input) : Move(motion_);
}

// A felt hazard: mark it, back off by what was driven, look again.
NavigatorDecision GestaltNavigator::OnFelt(const NavigatorInput& input) {
  if (++felt_hazards_ > params_.drive.max_felt) return Finish(NavigatorStatus::kGaveUp);
  if (mode_ == Mode::kTurning) {
    // Something blocks the turn: the search goes on the other way round.
    search_direction_ = -motion_.direction;
    return BeginCycle(input);
  }
  awaits_look_ = false;
  const double driven_m = input.estimate.distance_m - anchor_.distance_m;
  motion_ = MotionAt(driven_m);
  if (params_.drive.veto_felt) vetoed_.push_back(motion_);
  felt_places_.Feel(input, motion_.direction, params_.map.rover, params_.drive.felt_radius_m, map_);
  // Back along the same arc, no farther than it came.
  const double leg_m = std::min(driven_m, params_.drive.back_off_m);
  if (leg_m <= 0.0 || Touches(input, -motion_.direction)) return BeginCycle(input);
  const MotionCommand back{motion_.kind, motion_.curvature_per_m, -motion_.direction};
  return Begin(Mode::kBackingOff, back, leg_m, input);
}

NavigatorDecision GestaltNavigator::Look(Mode mode) {
  mode_ = mode;
  const bool ahead = mode == Mode::kLookingAhead;
  return {NavigatorStatus::kDriving, ahead ? LookDirection::kAhead : LookDirection::kBehind, {}};
}

NavigatorDecision GestaltNavigator::Begin(Mode mode, const MotionCommand& motion, double leg,
                                          const NavigatorInput& input) {
  mode_ = mode;
  motion_ = motion;
  motion_.speed_share = SpeedShare(params_.speed, motion.curvature_per_m);
  motion_.move = replans_ && mode == Mode::kDriving ? ++moves_ : 0;
  leg_ = leg;
  late_ = false;
  last_driven_m_ = 0.0;
  last_time_s_ = input.time_s;
  steered_per_m_ = motion.kind == MotionKind::kArc ? motion.curvature_per_m : 0.0;
  turned_rad_ = 0.0;
  last_heading_rad_ = input.estimate.heading_rad;
  anchor_ = input.estimate;
  began_s_ = input.time_s;
  // A hazard that lasts from before counts as old until it has gone once.
  felt_since_start_ = Feels(input);
  return Move(motion_);
}

void GestaltNavigator::FillView(const PlanOrigin& origin,
                                const messages::AttitudeEstimate& attitude) {
  view_.step = decisions_++;
  view_.estimate = origin.pose;
  view_.attitude = attitude;
  view_.goal = goal_;
  view_.looked_behind = looked_behind_;
  view_.map = map_.View();
  view_.forward = votes_.forward;
  view_.backward = votes_.backward;
  view_.point_turns = votes_.point_turns;
  view_.splines = spline_votes_;
  view_.spline_start = origin.pose;
}

// Counts cycles without progress; too many of them end the drive.
bool GestaltNavigator::Progresses(const PoseEstimate& estimate) {
  const double distance_m = TowardsGoal(estimate, goal_).distance_m;
  // A gain of progress_m on the best distance so far ends a fruitless run.
  if (distance_m <= best_goal_distance_m_ - params_.drive.progress_m) {
    // The first distance to a goal is what progress is counted from, and none itself.
    const bool gained = std::isfinite(best_goal_distance_m_);
    best_goal_distance_m_ = distance_m;
    fruitless_cycles_ = 0;
    if (!gained) return true;
    felt_hazards_ = 0;
    felt_places_.Forget();
    return true;
  }
  return ++fruitless_cycles_ <= params_.drive.max_fruitless_cycles;
}

bool GestaltNavigator::Feels(const NavigatorInput& input) const {
  const bool backward = motion_.kind == MotionKind::kArc && motion_.direction < 0;
  return input.vehicle_hazard != nullptr || (backward && Touches(input, -1));
}

bool GestaltNavigator::TimedOut(const NavigatorInput& input) const {
  return input.time_s - began_s_ >= params_.drive.step_time_out_s;
}

bool GestaltNavigator::AtGoal(const PoseEstimate& estimate) const {
  return TowardsGoal(estimate, goal_).distance_m <= params_.waypoints.goal_tolerance_m;
}

NavigatorDescription<GestaltParams> DescribeGestalt() {
  return {
      .name = "gestalt",
      .doc = "map-based navigator",
      .traits = [](const GestaltParams& params) -> NavigatorTraits {
        const GestaltRoverParams& rover = params.map.rover;
        NavigatorTraits traits(LookReading::kPoints, CostOf(params.map.grid),
                               {"waypoints.goal_tolerance_m", params.waypoints.goal_tolerance_m});
        traits.looks_on_the_move = params.continuous.cycle != DriveCycle::kStopAndLook;
        traits.steers_on_the_move = params.continuous.cycle == DriveCycle::kCsad;
        if (traits.steers_on_the_move) {
          traits.curvature_rates = {.path = "splines.max_curvature_rate_per_m_s",
                                    .limit_per_m_s = params.splines.max_curvature_rate_per_m_s,
                                    .least_per_m2 = params.splines.LeastRate_per_m2()};
        }
        if (!rover.modelled) return traits;
        traits.size =
            BelievedSize{"map.rover.length_m", rover.length_m, "map.rover.width_m", rover.width_m,
                         "use the size of the rover, e.g. \"extends\": "
                         "scenarios/navigation/gestalt_rocky_3_2.json in navigation.gestalt"};
        return traits;
      },
      .make = [](const GestaltParams& params,
                 const NavigatorSetup& setup) -> std::unique_ptr<Navigator> {
        return std::make_unique<GestaltNavigator>(params, setup.goal, setup.full_speed_m_s);
      }};
}

}  // namespace rockyard::navigation

#include "navigation/pathfinder/pathfinder.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::navigation {
namespace {

using messages::HazardReport;
using messages::MotionCommand;
using messages::MotionKind;
using messages::PoseEstimate;

// The finest aim of a turn towards the goal. A turn in place cannot end more exactly than one
// control tick, 1.3 deg at 26 deg/s and 20 Hz.
constexpr double kFinestAim_rad = math::DegToRad(2.0);

// How much earlier than the end of a manoeuvre the controller is asked again, m and rad: whoever
// watches for it adds the way up by other sums. A tick's way is some thousand times as long.
constexpr double kEarly = 1e-6;

bool OnlyOutermostStripes(const HazardReport& report) {
  for (std::size_t i = 1; i + 1 < report.stripe_hazard.size(); ++i) {
    if (report.stripe_hazard[i]) return false;
  }
  return report.stripe_hazard.front() && report.stripe_hazard.back();
}

int CountHazards(const HazardReport& report, const std::vector<std::int64_t>& stripes) {
  return static_cast<int>(std::count_if(stripes.begin(), stripes.end(), [&](std::int64_t stripe) {
    return report.stripe_hazard[static_cast<std::size_t>(stripe)];
  }));
}

// Stripes run from left to right: the last one is the outermost on the right.
bool RightIsClearFor(const HazardReport& report, const PathfinderParams& params) {
  if (params.right_is_clear == RightIsClear::kNoRightHazard) {
    return CountHazards(report, params.right_stripes) == 0;
  }
  return !report.stripe_hazard.back();
}

// The answer to hazards on both sides: the printed order of the rules turns right, the other
// choices are assumptions.
int TurnFromBothSides(const HazardReport& report, double goal_bearing_rad,
                      const PathfinderParams& params) {
  switch (params.both_sides) {
    case BothSidesReaction::kRuleOrder:
      return kRight;
    case BothSidesReaction::kTowardGoal:
      return goal_bearing_rad > 0.0 ? kLeft : kRight;
    case BothSidesReaction::kFewerHazards:
      return CountHazards(report, params.left_stripes) < CountHazards(report, params.right_stripes)
                 ? kLeft
                 : kRight;
  }
  return kRight;
}

}  // namespace

HazardSides ClassifySides(const HazardReport& report, const PathfinderParams& params) {
  return {CountHazards(report, params.left_stripes) > 0,
          CountHazards(report, params.centre_stripes) > 0,
          CountHazards(report, params.right_stripes) > 0};
}

// The rules in the order in which Matthies 1995, section 7, prints them.
int ChooseTurn(const HazardReport& report, double goal_bearing_rad,
               const PathfinderParams& params) {
  const HazardSides sides = ClassifySides(report, params);
  EXPECT(sides.any());
  if (sides.left && sides.right) return TurnFromBothSides(report, goal_bearing_rad, params);
  // "IF hazard on the left: turn in place to the right".
  if (sides.left) return kRight;
  if (sides.centre) return RightIsClearFor(report, params) ? kRight : kLeft;
  return kLeft;
}

double CurvatureToGoal(double goal_bearing_rad, const PathfinderParams& params) {
  const double size = std::abs(goal_bearing_rad);
  if (size <= params.heading_deadband_rad) return 0.0;
  const double radius =
      size > params.tight_arc_bearing_rad ? params.tight_arc_radius_m : params.wide_arc_radius_m;
  // Positive to the left, as the bearing.
  return std::copysign(1.0 / radius, goal_bearing_rad);
}

PathfinderNavigator::PathfinderNavigator(const PathfinderParams& params, const messages::Goal& goal,
                                         bool uses_hazard_sensor)
    : params_(params),
      goal_(goal),
      uses_hazard_sensor_(uses_hazard_sensor),
      reaction_(params.vehicle_reaction) {}

NavigatorDecision PathfinderNavigator::Decide(const NavigatorInput& input) {
  // A rover at its goal stops whatever it does, sees or feels.
  if (AtGoal(input.estimate)) return Finish(NavigatorStatus::kArrived);
  if (params_.time_out_s > 0.0 && input.time_s >= params_.time_out_s) {
    return Finish(NavigatorStatus::kGaveUp);
  }
  // What the rover feels goes before what it sees.
  if (const auto reaction = reaction_.Decide(input, GoalDistance(input.estimate))) {
    reacting_ = true;
    return *reaction;
  }
  if (reacting_) return AfterReaction(input);
  if (!started_) {
    started_ = true;
    odometer_at_scan_m_ = input.estimate.distance_m;
    return ScanOrGoOn(input);
  }
  // Where there is a report, the rover stands: it answers a scan.
  if (input.report != nullptr) return OnReport(input);
  return Continue(input);
}

void PathfinderNavigator::OnPoseUpdate(const PoseEstimate& before, const PoseEstimate& after) {
  // Turned angles are differences of heading: keep what was already turned.
  anchor_.heading_rad += after.heading_rad - before.heading_rad;
  reaction_.OnPoseUpdate(before, after);
}

void PathfinderNavigator::SetGoal(const messages::Goal& goal, GoalChange change) {
  goal_ = goal;
  if (change == GoalChange::kMoved) return;
  facing_goal_ = false;
  reaction_.OnNextGoal();
}

// What was under way is forgotten: the rover stands elsewhere and faces another way.
NavigatorDecision PathfinderNavigator::AfterReaction(const NavigatorInput& input) {
  reacting_ = false;
  started_ = true;
  facing_goal_ = false;
  avoid_direction_.reset();
  odometer_at_scan_m_ = input.estimate.distance_m;
  odometer_at_avoiding_m_ = input.estimate.distance_m;
  clearing_left_m_ = params_.vehicle_reaction.straight_m;
  return uses_hazard_sensor_ ? BeginScan() : OnClear(input);
}

NavigatorDecision PathfinderNavigator::OnReport(const NavigatorInput& input) {
  odometer_at_scan_m_ = input.estimate.distance_m;
  return ClassifySides(*input.report, params_).any() ? OnHazard(input) : OnClear(input);
}

// Rules 2 and 3: turn in place until no hazard is detected, with the extras that parameters switch
// on.
NavigatorDecision PathfinderNavigator::OnHazard(const NavigatorInput& input) {
  // Hazards on the outermost stripes alone leave a gap between them.
  if (params_.threading_m > 0.0 && OnlyOutermostStripes(*input.report)) {
    return BeginStraight(Mode::kThreading, params_.threading_m, input);
  }
  const bool newly_seen = !avoid_direction_.has_value();
  if (newly_seen || params_.turn_direction == TurnDirection::kEachScan) {
    avoid_direction_ = ChooseTurn(*input.report, GoalBearing(input.estimate), params_);
  }
  // The turn from a new hazard is counted from here, and its side latched where the parameters say
  // so.
  if (newly_seen) avoided_turn_rad_ = 0.0;
  clearing_left_m_ = 0.0;
  facing_goal_ = false;
  if (avoided_turn_rad_ >= params_.turn_give_up_rad) return Finish(NavigatorStatus::kGaveUp);
  const HazardSides sides = ClassifySides(*input.report, params_);
  // Enclosed on both sides: back off before turning, where the parameters ask for it.
  if (newly_seen && params_.back_off_m > 0.0 && sides.left && sides.right) {
    return BeginStraight(Mode::kBackingOff, params_.back_off_m, input);
  }
  return BeginTurn(Mode::kAvoiding, *avoid_direction_, input);
}

// Rule 1, after the straight drive that follows a turn.
NavigatorDecision PathfinderNavigator::OnClear(const NavigatorInput& input) {
  if (avoid_direction_.has_value()) {
    avoid_direction_.reset();
    clearing_left_m_ = params_.clear_distance_m;
  }
  if (clearing_left_m_ > 0.0) return BeginStraight(Mode::kClearing, clearing_left_m_, input);
  return BeginForward(input);
}

NavigatorDecision PathfinderNavigator::Continue(const NavigatorInput& input) {
  switch (mode_) {
    case Mode::kScanning:
      return BeginScan();
    case Mode::kAvoiding:
    case Mode::kFacingGoal:
      return ContinueTurn(input);
    case Mode::kForward:
    case Mode::kClearing:
    case Mode::kThreading:
    case Mode::kBackingOff:
      return ContinueDrive(input);
  }
  return BeginScan();
}

// A turn goes on for turn_increment, or until the rover faces the goal, and ends with a scan.
NavigatorDecision PathfinderNavigator::ContinueTurn(const NavigatorInput& input) {
  // Positive along the turn; WrapAngle, since headings stay within [-pi, pi].
  const double turned =
      motion_.direction * math::WrapAngle(input.estimate.heading_rad - anchor_.heading_rad);
  const bool faces_goal = mode_ == Mode::kFacingGoal && !NeedsPointTurn(input.estimate);
  if (turned < params_.turn_increment_rad && !faces_goal) return GoOn(input);
  if (mode_ == Mode::kAvoiding) {
    avoided_turn_rad_ += turned;
    odometer_at_avoiding_m_ = input.estimate.distance_m;
  }
  return ScanOrGoOn(input);
}

// A drive goes on until its length or the scan interval is reached.
NavigatorDecision PathfinderNavigator::ContinueDrive(const NavigatorInput& input) {
  const double driven = input.estimate.distance_m - anchor_.distance_m;
  if (mode_ == Mode::kBackingOff) {
    return driven < leg_m_ ? GoOn(input) : BeginTurn(Mode::kAvoiding, *avoid_direction_, input);
  }
  if (mode_ == Mode::kThreading && driven < leg_m_) return GoOn(input);
  // A scan may interrupt the straight drive; what is left of it is driven afterwards.
  if (mode_ == Mode::kClearing) clearing_left_m_ = std::max(0.0, leg_m_ - driven);
  const double since_scan = input.estimate.distance_m - odometer_at_scan_m_;
  if (uses_hazard_sensor_ && since_scan >= params_.scan_interval_m) return BeginScan();
  if (driven < leg_m_) return GoOn(input);
  return mode_ == Mode::kThreading ? ScanOrGoOn(input) : BeginForward(input);
}

// Until the manoeuvre may end, each answer would be this one. At every tick it is asked where that
// hangs on more than the way: on the bearing of the goal, and on a felt hazard that is overlooked
// for a while.
NavigatorDecision PathfinderNavigator::GoOn(const NavigatorInput& input) const {
  if (mode_ == Mode::kFacingGoal || input.vehicle_hazard != nullptr) return Move(motion_);
  Until until = AtEvents();
  until.near_goal_m = params_.goal_tolerance_m;
  if (params_.time_out_s > 0.0) until.period_s = params_.time_out_s - input.time_s;
  if (mode_ == Mode::kAvoiding) {
    const double turned = math::WrapAngle(input.estimate.heading_rad - anchor_.heading_rad);
    until.turn_rad = std::max(0.0, params_.turn_increment_rad - std::abs(turned) - kEarly);
    return Move(motion_, until);
  }
  double left_m = leg_m_ - (input.estimate.distance_m - anchor_.distance_m);
  if (uses_hazard_sensor_ && (mode_ == Mode::kForward || mode_ == Mode::kClearing)) {
    const double since_scan_m = input.estimate.distance_m - odometer_at_scan_m_;
    left_m = std::min(left_m, params_.scan_interval_m - since_scan_m);
  }
  until.distance_m = std::max(0.0, left_m - kEarly);
  return Move(motion_, until);
}

NavigatorDecision PathfinderNavigator::BeginScan() {
  mode_ = Mode::kScanning;
  return {NavigatorStatus::kDriving, messages::LookDirection::kAhead, {}};
}

NavigatorDecision PathfinderNavigator::ScanOrGoOn(const NavigatorInput& input) {
  return uses_hazard_sensor_ ? BeginScan() : BeginForward(input);
}

NavigatorDecision PathfinderNavigator::BeginForward(const NavigatorInput& input) {
  const double bearing = GoalBearing(input.estimate);
  facing_goal_ = NeedsPointTurn(input.estimate);
  if (facing_goal_) return BeginTurn(Mode::kFacingGoal, bearing > 0.0 ? kLeft : kRight, input);
  mode_ = Mode::kForward;
  anchor_ = input.estimate;
  leg_m_ = params_.scan_interval_m;  // the bearing is looked at anew as often as the terrain
  motion_ = {MotionKind::kArc, CurvatureToGoal(bearing, params_), +1};
  return GoOn(input);
}

NavigatorDecision PathfinderNavigator::BeginStraight(Mode mode, double distance_m,
                                                     const NavigatorInput& input) {
  mode_ = mode;
  anchor_ = input.estimate;
  leg_m_ = distance_m;
  motion_ = {MotionKind::kArc, 0.0, mode == Mode::kBackingOff ? -1 : +1};
  return GoOn(input);
}

NavigatorDecision PathfinderNavigator::BeginTurn(Mode mode, int direction,
                                                 const NavigatorInput& input) {
  mode_ = mode;
  anchor_ = input.estimate;
  motion_ = {MotionKind::kTurnInPlace, 0.0, direction};
  return GoOn(input);
}

double PathfinderNavigator::GoalBearing(const PoseEstimate& estimate) const {
  const double direction = math::Atan2(goal_.y_m - estimate.y_m, goal_.x_m - estimate.x_m);
  return math::WrapAngle(direction - estimate.heading_rad);
}

// A turn towards the goal, once begun, goes on until the rover faces it. It begins where the goal
// lies far behind, or inside the tightest turning circle, which the rover would drive round for
// ever: the arc that leads to a goal at distance d and bearing b has the radius d / (2 sin b).
bool PathfinderNavigator::NeedsPointTurn(const PoseEstimate& estimate) const {
  const double bearing_rad = std::abs(GoalBearing(estimate));
  if (facing_goal_) return bearing_rad > std::max(params_.heading_deadband_rad, kFinestAim_rad);
  // Without this distance a hazard beside the goal would turn the rover away and back for ever.
  if (estimate.distance_m - odometer_at_avoiding_m_ < params_.point_turn_after_m) return false;
  if (bearing_rad > params_.point_turn_bearing_rad) return true;
  return bearing_rad > params_.tight_arc_bearing_rad &&
         GoalDistance(estimate) < 2.0 * params_.tight_arc_radius_m * math::Sin(bearing_rad);
}

double PathfinderNavigator::GoalDistance(const PoseEstimate& estimate) const {
  return math::Hypot(goal_.x_m - estimate.x_m, goal_.y_m - estimate.y_m);
}

bool PathfinderNavigator::AtGoal(const PoseEstimate& estimate) const {
  return GoalDistance(estimate) <= params_.goal_tolerance_m;
}

NavigatorDescription<PathfinderParams> DescribePathfinder() {
  return {.name = "pathfinder",
          .doc = "behaviour controller",
          .traits = [](const PathfinderParams& params) -> NavigatorTraits {
            NavigatorTraits traits(LookReading::kHazardReport, CostOfJudgement{},
                                   {"goal_tolerance_m", params.goal_tolerance_m});
            traits.stripes =
                StripeNames{"left_stripes", "names with centre_stripes and right_stripes",
                            params.stripe_count()};
            return traits;
          },
          .make = [](const PathfinderParams& params,
                     const NavigatorSetup& setup) -> std::unique_ptr<Navigator> {
            return std::make_unique<PathfinderNavigator>(params, setup.goal, setup.judges_hazards);
          }};
}

}  // namespace rockyard::navigation

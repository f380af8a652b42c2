#include "navigation/enav/enav.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "core/check.h"
#include "math/functions.h"
#include "navigation/gestalt/curvature_law.h"
#include "navigation/gestalt/manoeuvre.h"

namespace rockyard::navigation {
namespace {

using messages::Goal;
using messages::LookDirection;
using messages::MotionCommand;
using messages::MotionKind;
using messages::PoseEstimate;

constexpr double kRad750_ops_per_s = 266e6;

double Wheelbase_m(const messages::RoverBelief& rover) {
  const auto [rear, front] =
      std::minmax_element(rover.drive.wheel_x_m.begin(), rover.drive.wheel_x_m.end());
  return *front - *rear;
}

math::Transform Standing(const PoseEstimate& pose, const messages::AttitudeEstimate& attitude) {
  return math::MakePose({pose.x_m, pose.y_m, attitude.z_m}, pose.heading_rad, attitude.pitch_rad,
                        attitude.roll_rad);
}

double Distance_m(const PoseEstimate& pose, const Goal& goal) {
  return math::Hypot(goal.x_m - pose.x_m, goal.y_m - pose.y_m);
}

}  // namespace

EnavNavigator::EnavNavigator(const EnavParams& params, const Goal& goal,
                             const messages::RoverBelief& rover, double full_speed_m_s)
    : params_(ScaledTo(params, Wheelbase_m(rover))),
      goal_(goal),
      length_m_(rover.length_m),
      width_m_(rover.width_m),
      planner_(params_, rover, full_speed_m_s) {}

NavigatorDecision EnavNavigator::Decide(const NavigatorInput& input) {
  if (Distance_m(input.estimate, goal_) <= params_.drive.goal_tolerance_m) {
    return Finish(NavigatorStatus::kArrived);
  }
  if (params_.drive.time_out_s > 0.0 && input.time_s >= params_.drive.time_out_s) {
    return Finish(NavigatorStatus::kGaveUp);
  }
  NavigatorDecision decision = stage_ != Stage::kLooking ? GoOn(input)
                               : input.cloud != nullptr  ? PlanAtRest(input)
                                                         : LookAtRest();
  decision.work_ops = WorkSince();
  return decision;
}

void EnavNavigator::OnPoseUpdate(const PoseEstimate&, const PoseEstimate&) {
  planner_.Forget();
  LookAtRest();
}

void EnavNavigator::SetGoal(const Goal& goal, GoalChange change) {
  goal_ = goal;
  if (change == GoalChange::kMoved) return;
  best_m_ = std::numeric_limits<double>::infinity();
  fruitless_ = retries_ = felt_ = 0;
}

NavigatorDecision EnavNavigator::LookAtRest() {
  stage_ = Stage::kLooking;
  asked_ = false;
  next_.reset();
  return LookAt(LookDirection::kAhead);
}

NavigatorDecision EnavNavigator::PlanAtRest(const NavigatorInput& input) {
  See(input);
  planner_.StandOn(Standing(input.odometry, input.attitude));
  if (!MakePlan(Planar(input.odometry), input)) return Finish(NavigatorStatus::kGaveUp);
  if (plan_.found) return Execute(plan_, input);
  // On to one side until there is a path: the goal's, at first.
  if (retry_side_ == 0) {
    const Goal goal = GoalInD(input);
    const math::Pose2 at = math::SeenFrom(Planar(input.odometry), {goal.x_m, goal.y_m, 0.0});
    retry_side_ = at.y_m > 0.0 ? 1 : -1;
  }
  if (params_.drive.retry_turn_rad == 0.0) return LookAtRest();
  return Begin(Stage::kTurning, {MotionKind::kTurnInPlace, 0.0, retry_side_},
               params_.drive.retry_turn_rad, input);
}

bool EnavNavigator::MakePlan(const math::Pose2& from, const NavigatorInput& input) {
  const double distance_m = Distance_m(input.estimate, goal_);
  if (distance_m <= best_m_ - params_.drive.progress_m) {
    best_m_ = distance_m;
    fruitless_ = felt_ = 0;
    planner_.ForgetFelt();
  } else if (++fruitless_ > params_.drive.max_fruitless_cycles) {
    return false;
  }
  plan_ = planner_.Plan(from, GoalInD(input));
  ++cycles_;
  checks_ += plan_.checks;
  if (plan_.found) {
    retries_ = 0;
    retry_side_ = 0;
    Show(input);
    return true;
  }
  ++without_path_;
  return ++retries_ <= params_.drive.max_retries;
}

NavigatorDecision EnavNavigator::Execute(const EnavPlan& plan, const NavigatorInput& input) {
  if (plan.turn_rad != 0.0) {
    return Begin(Stage::kTurning, {MotionKind::kTurnInPlace, 0.0, plan.turn_rad > 0.0 ? 1 : -1},
                 std::min(std::abs(plan.turn_rad), params_.drive.execute_turn_rad), input);
  }
  return Begin(Stage::kDriving, {MotionKind::kArc, plan.curvature_per_m, +1},
               std::min(plan.length_m, params_.drive.execute_arc_m), input);
}

NavigatorDecision EnavNavigator::Begin(Stage stage, const MotionCommand& motion, double leg,
                                       const NavigatorInput& input) {
  stage_ = stage;
  motion_ = motion;
  motion_.move = ++moves_;
  leg_ = leg;
  measured_ = 0.0;
  began_m_ = input.odometry.distance_m;
  heading_rad_ = input.odometry.heading_rad;
  feels_old_ = input.vehicle_hazard != nullptr;
  asked_ = late_ = false;
  next_.reset();
  return Move(motion_);
}

// A motion is under way; only what is measured ends it, or a hazard that is felt anew.
NavigatorDecision EnavNavigator::GoOn(const NavigatorInput& input) {
  if (stage_ == Stage::kTurning) {
    measured_ += motion_.direction * math::WrapAngle(input.odometry.heading_rad - heading_rad_);
    heading_rad_ = input.odometry.heading_rad;
  } else {
    measured_ = input.odometry.distance_m - began_m_;
  }
  if (input.vehicle_hazard == nullptr) feels_old_ = false;
  if (stage_ == Stage::kBackingOff) {
    const bool ends = measured_ >= leg_ || Touches(input, -1);
    return ends ? LookAtRest() : Move(motion_);
  }
  if (input.vehicle_hazard != nullptr && !feels_old_) return OnFelt(input);
  if (stage_ == Stage::kDriving && plans_on_the_move()) return DriveOnTheMove(input);
  return measured_ >= leg_ ? LookAtRest() : Move(motion_);
}

NavigatorDecision EnavNavigator::DriveOnTheMove(const NavigatorInput& input) {
  if (asked_ && input.cloud != nullptr) {
    asked_ = false;
    See(input);
    const double rest_m = std::max(0.0, leg_ - measured_);
    const math::Pose2 end = Planar(input.odometry) * AlongArc(motion_.curvature_per_m, rest_m);
    ++counts_.plans;
    if (!MakePlan(end, input)) return Finish(NavigatorStatus::kGaveUp);
    if (!plan_.found) ++counts_.unsafe;
    next_ = plan_;
  }
  if (measured_ >= leg_) {
    if (asked_) {
      if (!late_) ++counts_.late;
      late_ = true;
      return Move({});
    }
    if (!next_ || !next_->found) return LookAtRest();
    ++counts_.started;
    const EnavPlan next = *next_;
    return Execute(next, input);
  }
  NavigatorDecision decision = Move(motion_);
  if (asked_ || next_ || measured_ < params_.continuous.look_fraction * leg_) return decision;
  asked_ = true;
  decision.look = LookDirection::kAhead;
  decision.looks_on_the_move = true;
  return decision;
}

// Where a hazard lies that is felt: half a length to where the rover drives, aside if a side is
// named.
NavigatorDecision EnavNavigator::OnFelt(const NavigatorInput& input) {
  if (++felt_ > params_.drive.max_felt) return Finish(NavigatorStatus::kGaveUp);
  if (stage_ == Stage::kTurning) return LookAtRest();
  const messages::HazardSide side = input.vehicle_hazard->side;
  const double aside_m = side == messages::HazardSide::kLeft    ? 0.5 * width_m_
                         : side == messages::HazardSide::kRight ? -0.5 * width_m_
                                                                : 0.0;
  const math::Pose2 place = Planar(input.odometry) * math::Pose2{0.5 * length_m_, aside_m, 0.0};
  planner_.Avoid({place.x_m, place.y_m});
  if (measured_ <= 0.0 || Touches(input, -1)) return LookAtRest();
  return Begin(Stage::kBackingOff, {MotionKind::kArc, motion_.curvature_per_m, -1}, measured_,
               input);
}

void EnavNavigator::See(const NavigatorInput& input) {
  EXPECT(input.look != nullptr);
  planner_.See(*input.cloud, Standing(input.look->odometry, input.look->attitude));
}

Goal EnavNavigator::GoalInD(const NavigatorInput& input) const {
  const math::Pose2 goal =
      math::Carried(Planar(input.odometry), Planar(input.estimate), {goal_.x_m, goal_.y_m, 0.0});
  return {goal.x_m, goal.y_m};
}

// The path that was chosen, in the frame in which goals are told.
void EnavNavigator::Show(const NavigatorInput& input) {
  messages::OverlayLine line{"path", {}};
  for (const math::Pose2& pose : plan_.way) {
    const math::Pose2 told = math::Carried(Planar(input.estimate), Planar(input.odometry), pose);
    line.points.push_back({told.x_m, told.y_m});
  }
  overlay_.lines = {std::move(line)};
}

std::span<const double> EnavNavigator::own_values() const {
  const auto checks = static_cast<double>(checks_);
  const auto cycles = static_cast<double>(cycles_);
  own_values_ = {cycles, cycles > 0.0 ? checks / cycles : 0.0, static_cast<double>(without_path_),
                 checks * 1e-3 * params_.drive.check_ms};
  return own_values_;
}

// Returns the operations of the checks since it was last asked.
double EnavNavigator::WorkSince() {
  const auto checks = static_cast<double>(checks_ - worked_);
  worked_ = checks_;
  return checks * 1e-3 * params_.drive.check_ms * kRad750_ops_per_s;
}

NavigatorDescription<EnavParams> DescribeEnav() {
  return {.name = "enav",
          .doc = "ENav/ACE from its published description",
          .traits = [](const EnavParams& params) -> NavigatorTraits {
            NavigatorTraits traits(LookReading::kPoints, CostOfLook{},
                                   {"drive.goal_tolerance_m", params.drive.goal_tolerance_m});
            traits.looks_on_the_move = params.continuous.cycle != EnavCycle::kStopAndLook;
            return traits;
          },
          .make = [](const EnavParams& params,
                     const NavigatorSetup& setup) -> std::unique_ptr<Navigator> {
            return std::make_unique<EnavNavigator>(params, setup.goal, setup.rover,
                                                   setup.full_speed_m_s);
          },
          .own_values = {{"cycles", "1", "how often it planned"},
                         {"checks_per_cycle", "1", "checks by ACE, over cycles"},
                         {"cycles_without_path", "1", "cycles in which no path passed"},
                         {"planning_s", "s", "time of all checks on a RAD750, by check_ms"}}};
}

}  // namespace rockyard::navigation

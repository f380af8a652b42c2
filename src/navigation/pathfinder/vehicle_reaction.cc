#include "navigation/pathfinder/vehicle_reaction.h"

#include "core/check.h"
#include "math/angles.h"

namespace rockyard::navigation {
namespace {

using messages::HazardSide;
using messages::MotionCommand;
using messages::MotionKind;
using messages::VehicleHazardKind;

}  // namespace

std::optional<NavigatorDecision> VehicleReaction::Decide(const NavigatorInput& input,
                                                         double goal_distance_m) {
  EXPECT(input.vehicle_hazard == nullptr || input.vehicle_hazard->side != HazardSide::kBehind);
  const bool touches =
      input.vehicle_hazard != nullptr && input.vehicle_hazard->kind == VehicleHazardKind::kContact;
  // A hazard that had gone for a tick may come again as a new one (Appeared).
  if (input.vehicle_hazard == nullptr) was_clear_ = true;
  if (!touches) was_released_ = true;
  switch (stage_) {
    case Stage::kNone:
      return Begin(input, goal_distance_m);
    case Stage::kBackingOff:
      return BackOff(input);
    case Stage::kTurning:
      return Turn(input, goal_distance_m);
  }
  return std::nullopt;
}

std::optional<NavigatorDecision> VehicleReaction::Begin(const NavigatorInput& input,
                                                        double goal_distance_m) {
  const messages::VehicleHazard* hazard = input.vehicle_hazard;
  if (hazard == nullptr) return std::nullopt;
  if (input.estimate.distance_m < ignored_until_m_) return std::nullopt;
  // Reactions count from the last gain of progress_m towards the goal.
  if (goal_distance_m <= best_goal_distance_m_ - params_.progress_m) {
    best_goal_distance_m_ = goal_distance_m;
    repeats_ = 0;
  }
  if (++repeats_ > params_.max_repeats) {
    if (params_.on_exhausted == ReactionsExhausted::kGiveUp) {
      return NavigatorDecision{NavigatorStatus::kGaveUp, {}, {}};
    }
    repeats_ = 0;
    ignored_until_m_ = input.estimate.distance_m + params_.ignore_m;
    return std::nullopt;
  }
  cause_ = hazard->kind;
  was_clear_ = false;
  was_released_ = cause_ != VehicleHazardKind::kContact;
  // Away from the hazard's side: left (+1) for a hazard on the right, right for all others.
  turn_direction_ = hazard->side == HazardSide::kRight ? +1 : -1;
  return Start(Stage::kBackingOff, {MotionKind::kArc, 0.0, -1}, input.estimate);
}

// Straight back by back_off_m, or until something is touched there.
std::optional<NavigatorDecision> VehicleReaction::BackOff(const NavigatorInput& input) {
  const double driven_m = input.estimate.distance_m - anchor_.distance_m;
  if (driven_m < params_.back_off_m && !input.touches_behind) return GoOn();
  return Start(Stage::kTurning, {MotionKind::kTurnInPlace, 0.0, turn_direction_}, input.estimate);
}

// Turns in place by turn_rad; what appears meanwhile starts the reaction again.
std::optional<NavigatorDecision> VehicleReaction::Turn(const NavigatorInput& input,
                                                       double goal_distance_m) {
  const double turned_rad =
      turn_direction_ * math::WrapAngle(input.estimate.heading_rad - anchor_.heading_rad);
  const bool appeared = input.vehicle_hazard != nullptr && Appeared(*input.vehicle_hazard);
  if (!appeared && turned_rad < params_.turn_rad) return GoOn();
  stage_ = Stage::kNone;
  return appeared ? Begin(input, goal_distance_m) : std::nullopt;
}

bool VehicleReaction::Appeared(const messages::VehicleHazard& hazard) const {
  if (hazard.kind == VehicleHazardKind::kContact) return was_released_;
  return was_clear_ && hazard.kind != cause_;
}

NavigatorDecision VehicleReaction::Start(Stage stage, const MotionCommand& motion,
                                         const messages::PoseEstimate& estimate) {
  stage_ = stage;
  motion_ = motion;
  anchor_ = estimate;
  return GoOn();
}

void VehicleReaction::OnPoseUpdate(const messages::PoseEstimate& before,
                                   const messages::PoseEstimate& after) {
  // Turned angles are differences of heading: what has been turned stays turned.
  anchor_.heading_rad += after.heading_rad - before.heading_rad;
}

void VehicleReaction::OnNextGoal() {
  best_goal_distance_m_ = std::numeric_limits<double>::infinity();
  repeats_ = 0;
}

}  // namespace rockyard::navigation

#include "navigation/stuck_reaction.h"

#include <utility>

#include "core/check.h"

namespace rockyard::navigation {

StuckReaction::StuckReaction(const StuckReactionParams& params,
                             std::unique_ptr<Navigator> navigator)
    : params_(params), navigator_(std::move(navigator)) {
  EXPECT(params_.reaction != StuckResponse::kOff);
  EXPECT(navigator_ != nullptr);
}

NavigatorDecision StuckReaction::Decide(const NavigatorInput& input) {
  if (input.notices_stuck) {
    const bool may_back_off =
        params_.reaction == StuckResponse::kBackOff && stage_ == Stage::kNavigating;
    if (!may_back_off) return {NavigatorStatus::kStuck, {}, {}};
    BeginBackOff(input.estimate);
  }
  if (stage_ == Stage::kBackingOff) {
    if (!HasBackedOff(input)) return {NavigatorStatus::kDriving, {}, back_off_};
    stage_ = Stage::kBackedOff;
    NavigatorInput after = input;
    after.events.Add(Event::kStuck);
    return Ask(after);
  }
  return Ask(input);
}

NavigatorDecision StuckReaction::Ask(const NavigatorInput& input) {
  NavigatorDecision decision = navigator_->Decide(input);
  // A turn in place cannot be driven back: the arc before it can.
  if (decision.motion.kind == messages::MotionKind::kArc) last_arc_ = decision.motion;
  return decision;
}

void StuckReaction::OnPoseUpdate(const messages::PoseEstimate& before,
                                 const messages::PoseEstimate& after) {
  navigator_->OnPoseUpdate(before, after);
}

void StuckReaction::OnCorrection(const messages::PoseEstimate& before,
                                 const messages::PoseEstimate& after) {
  navigator_->OnCorrection(before, after);
}

void StuckReaction::BeginBackOff(const messages::PoseEstimate& estimate) {
  stage_ = Stage::kBackingOff;
  back_off_ = last_arc_;
  back_off_.direction = -last_arc_.direction;
  odometer_at_back_off_m_ = estimate.distance_m;
}

bool StuckReaction::HasBackedOff(const NavigatorInput& input) const {
  if (input.estimate.distance_m - odometer_at_back_off_m_ >= params_.back_off_m) return true;
  if (back_off_.direction < 0) return input.touches_behind;
  return input.vehicle_hazard != nullptr &&
         input.vehicle_hazard->kind == messages::VehicleHazardKind::kContact;
}

}  // namespace rockyard::navigation

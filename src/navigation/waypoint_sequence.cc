#include "navigation/waypoint_sequence.h"

#include <utility>

#include "core/check.h"

namespace rockyard::navigation {

WaypointSequence::WaypointSequence(std::vector<messages::Goal> goals,
                                   std::unique_ptr<Navigator> navigator)
    : goals_(std::move(goals)), navigator_(std::move(navigator)) {
  EXPECT(!goals_.empty());
  EXPECT(navigator_ != nullptr);
}

NavigatorDecision WaypointSequence::Decide(const NavigatorInput& input) {
  NavigatorDecision decision = navigator_->Decide(input);
  NavigatorInput again = input;
  // The first answer was one to this, too.
  again.notices_stuck = false;
  while (decision.status == NavigatorStatus::kArrived && !IsOnLastLeg()) {
    ++reached_;
    navigator_->SetGoal(goal(), GoalChange::kNext);
    decision = navigator_->Decide(again);
  }
  return decision;
}

void WaypointSequence::OnPoseUpdate(const messages::PoseEstimate& before,
                                    const messages::PoseEstimate& after) {
  navigator_->OnPoseUpdate(before, after);
}

void WaypointSequence::OnCorrection(const messages::PoseEstimate& before,
                                    const messages::PoseEstimate& after) {
  navigator_->OnCorrection(before, after);
}

void WaypointSequence::SetGoal(const messages::Goal& goal, GoalChange change) {
  goals_.back() = goal;
  if (IsOnLastLeg()) navigator_->SetGoal(goal, change);
}

void WaypointSequence::DriveTo(const messages::Goal& goal) {
  goals_.resize(reached_ + 1);
  goals_.back() = goal;
  navigator_->SetGoal(goal, GoalChange::kMoved);
}

}  // namespace rockyard::navigation

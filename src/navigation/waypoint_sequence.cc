#include "navigation/waypoint_sequence.h"

#include <utility>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::navigation {

bool HasPassed(const messages::Goal& corner, const messages::Goal& from,
               const messages::PoseEstimate& estimate, double within_m) {
  const double dx = estimate.x_m - corner.x_m;
  const double dy = estimate.y_m - corner.y_m;
  const double beyond = dx * (corner.x_m - from.x_m) + dy * (corner.y_m - from.y_m);
  return beyond > 0.0 || math::Hypot(dx, dy) <= within_m;
}

WaypointSequence::WaypointSequence(std::vector<messages::Goal> goals,
                                   std::unique_ptr<Navigator> navigator,
                                   std::optional<double> pass_within_m)
    : goals_(std::move(goals)), navigator_(std::move(navigator)), pass_within_m_(pass_within_m) {
  EXPECT(!goals_.empty());
  EXPECT(navigator_ != nullptr);
}

NavigatorDecision WaypointSequence::Decide(const NavigatorInput& input) {
  if (pass_within_m_) PassWaypoints(input.estimate);
  NavigatorDecision decision = navigator_->Decide(input);
  NavigatorInput again = input;
  // The first answer has dealt with it.
  again.notices_stuck = false;
  while (decision.status == NavigatorStatus::kArrived && !IsOnLastLeg()) {
    leg_from_ = goal();
    ++reached_;
    navigator_->SetGoal(goal(), GoalChange::kNext);
    decision = navigator_->Decide(again);
  }
  return decision;
}

void WaypointSequence::PassWaypoints(const messages::PoseEstimate& estimate) {
  // The first leg begins where the rover stands when it first decides.
  if (!leg_from_) leg_from_ = messages::Goal{estimate.x_m, estimate.y_m};
  const std::size_t before = reached_;
  while (!IsOnLastLeg() && HasPassed(goal(), *leg_from_, estimate, *pass_within_m_)) {
    leg_from_ = goal();
    ++reached_;
  }
  if (reached_ != before) navigator_->SetGoal(goal(), GoalChange::kNext);
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

#include "navigation/gestalt.h"

namespace rockyard::navigation {

GestaltNavigator::GestaltNavigator(const GestaltParams& params, const messages::Goal& goal)
    : params_(params), goal_(goal) {}

// The drive cycle follows; until then no way is found.
NavigatorDecision GestaltNavigator::Decide(const NavigatorInput& input) {
  if (input.cloud == nullptr) {
    return {NavigatorStatus::kDriving, messages::LookDirection::kAhead, {}};
  }
  return {NavigatorStatus::kGaveUp, {}, {}};
}

void GestaltNavigator::OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) {}

const messages::NavigationView* GestaltNavigator::view() const { return nullptr; }

}  // namespace rockyard::navigation

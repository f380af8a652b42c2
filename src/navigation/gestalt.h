// GESTALT, the map-based navigator of Goldberg 2002, section 4: look, map, vote, drive an arc
// blindly, look again.
#pragma once

#include "navigation/gestalt_params.h"
#include "navigation/navigator.h"

namespace rockyard::navigation {

class GestaltNavigator final : public Navigator {
 public:
  GestaltNavigator(const GestaltParams& params, const messages::Goal& goal);

  NavigatorDecision Decide(const NavigatorInput& input) override;
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  const messages::NavigationView* view() const override;

 private:
  GestaltParams params_;
  messages::Goal goal_;
  messages::NavigationView view_;
};

}  // namespace rockyard::navigation

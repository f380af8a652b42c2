// A navigator that keeps the truth firewall: with an include of the truth it must not compile.
#include "navigation/navigator.h"

namespace rockyard::navigation {
namespace {

class StraightAhead final : public Navigator {
 public:
  NavigatorDecision Decide(const NavigatorInput&) override { return {}; }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, GoalChange) override {}
};

}  // namespace

Navigator& HonestNavigator() {
  static StraightAhead navigator;
  return navigator;
}

}  // namespace rockyard::navigation

// A navigator that keeps the truth firewall. CHEAT_HEADER names a header that it must not reach:
// with it this file must not compile.
#include "navigation/navigator.h"

#ifdef CHEAT_HEADER
#include CHEAT_HEADER
#endif

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

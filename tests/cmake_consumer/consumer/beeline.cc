#include "beeline.h"

#include <cmath>
#include <memory>

#include "navigation/navigator.h"

using namespace rockyard;

namespace {

// Drives straight ahead, sees nothing, and stops at the goal.
class Beeline final : public navigation::Navigator {
 public:
  Beeline(const BeelineParams& params, const messages::Goal& goal) : params_(params), goal_(goal) {}

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    const double distance_m =
        std::hypot(goal_.x_m - input.estimate.x_m, goal_.y_m - input.estimate.y_m);
    if (distance_m <= params_.tolerance_m) {
      return {.status = navigation::NavigatorStatus::kArrived};
    }
    return {.motion = {.kind = messages::MotionKind::kArc}};
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal& goal, navigation::GoalChange) override { goal_ = goal; }

 private:
  BeelineParams params_;
  messages::Goal goal_;
};

}  // namespace

void BeelineParams::Visit(core::FieldVisitor& v) {
  v.Real("tolerance_m", tolerance_m,
         core::Assumed("believed distance from the goal at which it has arrived", {}, {0, 1}));
}

navigation::NavigatorDescription<BeelineParams> DescribeBeeline() {
  return {.name = "beeline",
          .doc = "drives straight ahead",
          .traits = [](const BeelineParams& params) -> navigation::NavigatorTraits {
            return {navigation::LookReading::kNothing,
                    navigation::CostOfLook{},
                    {"tolerance_m", params.tolerance_m}};
          },
          .make = [](const BeelineParams& params, const navigation::NavigatorSetup& setup)
              -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<Beeline>(params, setup.goal);
          }};
}

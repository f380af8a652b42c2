// The trivial policy: looks, drives a quarter of a metre straight ahead, and so on.
#include <cmath>
#include <memory>

#include "plugin/navigator_plugin.h"

namespace {

namespace messages = rockyard::messages;
namespace navigation = rockyard::navigation;

struct Params {
  double goal_tolerance_m = 0.3;
  void Visit(rockyard::core::FieldVisitor& v) {
    v.Real("goal_tolerance_m", goal_tolerance_m,
           {.doc = "arrives within", .min = 0.0, .max = 10.0});
  }
};

class StraightAhead final : public navigation::Navigator {
 public:
  StraightAhead(const Params& params, const navigation::NavigatorSetup& setup)
      : params_(params), goal_(setup.goal) {}

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    const double dx_m = goal_.x_m - input.estimate.x_m;
    const double dy_m = goal_.y_m - input.estimate.y_m;
    if (std::sqrt(dx_m * dx_m + dy_m * dy_m) < params_.goal_tolerance_m) {
      return navigation::Finish(navigation::NavigatorStatus::kArrived);
    }
    if (input.look == nullptr) return navigation::LookAt(messages::LookDirection::kAhead);
    navigation::Until until = navigation::AtEvents();
    until.distance_m = 0.25;
    return navigation::Move({.kind = messages::MotionKind::kArc}, until);
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal& goal, navigation::GoalChange) override { goal_ = goal; }

 private:
  Params params_;
  messages::Goal goal_;
};

navigation::NavigatorDescription<Params> Describe() {
  return {.name = "straight_ahead",
          .doc = "looks and drives straight ahead",
          .traits = [](const Params& params) -> navigation::NavigatorTraits {
            return {navigation::LookReading::kHazardReport,
                    navigation::CostOfLook{},
                    {.path = "goal_tolerance_m", .tolerance_m = params.goal_tolerance_m}};
          },
          .make = [](const Params& params, const navigation::NavigatorSetup& setup)
              -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<StraightAhead>(params, setup);
          },
          .own_values = {}};
}

}  // namespace

ROCKYARD_NAVIGATORS(Describe)

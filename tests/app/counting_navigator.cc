// A plugin for tests of what is told of runs: it drives straight to the goal, asks again every half
// metre, and counts how often it decided and when it did last.

#include <array>
#include <cmath>
#include <memory>
#include <span>

#include "plugin/navigator_plugin.h"

namespace {

using rockyard::messages::Goal;
using rockyard::messages::MotionKind;
using rockyard::messages::PoseEstimate;
namespace core = rockyard::core;
namespace navigation = rockyard::navigation;

struct CounterParams {
  double goal_tolerance_m = 0.3;
  double stretch_m = 0.5;

  void Visit(core::FieldVisitor& v) {
    v.Real("goal_tolerance_m", goal_tolerance_m, core::Setting("radius of arrival", {0.0, 5.0}));
    v.Real("stretch_m", stretch_m, core::Setting("driven between decisions", {0.01, 10.0}));
  }
};

class Counter final : public navigation::Navigator {
 public:
  Counter(const CounterParams& params, const navigation::NavigatorSetup& setup)
      : params_(params), goal_(setup.goal) {}

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    counts_ = {counts_[0] + 1.0, input.time_s};
    const double left_m =
        std::hypot(goal_.x_m - input.estimate.x_m, goal_.y_m - input.estimate.y_m);
    if (left_m <= params_.goal_tolerance_m) {
      return navigation::Finish(navigation::NavigatorStatus::kArrived);
    }
    navigation::Until until = navigation::AtEvents();
    until.distance_m = params_.stretch_m;
    return navigation::Move({.kind = MotionKind::kArc}, until);
  }
  void OnPoseUpdate(const PoseEstimate&, const PoseEstimate&) override {}
  void SetGoal(const Goal& goal, navigation::GoalChange) override { goal_ = goal; }
  std::span<const double> own_values() const override { return counts_; }

 private:
  CounterParams params_;
  Goal goal_;
  std::array<double, 2> counts_{};
};

navigation::NavigatorDescription<CounterParams> DescribeCounter() {
  return {.name = "counter",
          .doc = "straight to the goal",
          .traits = [](const CounterParams& params) -> navigation::NavigatorTraits {
            return {navigation::LookReading::kNothing,
                    navigation::CostOfLook{},
                    {"goal_tolerance_m", params.goal_tolerance_m}};
          },
          .make = [](const CounterParams& params, const navigation::NavigatorSetup& setup)
              -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<Counter>(params, setup);
          },
          .own_values = {{"decisions", "1", "times that it decided"},
                         {"last_s", "s", "time of the last decision"}}};
}

}  // namespace

ROCKYARD_NAVIGATORS(DescribeCounter)

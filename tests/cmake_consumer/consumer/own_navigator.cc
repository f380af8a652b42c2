// A navigator that rockyard does not know drives a trial of a scenario that names it.
#include <cmath>
#include <cstdio>
#include <memory>

#include "experiments/experiment.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"
#include "scenario/load.h"
#include "truth/record.h"

namespace {

using core::Assumed;

using namespace rockyard;

struct BeelineParams {
  double tolerance_m = 0.1;

  void Visit(core::FieldVisitor& v) {
    v.Real("tolerance_m", tolerance_m,
           Assumed("believed distance from the goal at which it has arrived", {}, {0, 1}));
  }
};

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

constexpr const char* kScenario = R"({
  "navigation": {"navigator": "beeline", "beeline": {"tolerance_m": 0.05}},
  "localization": {"estimator": "oracle"},
  "rover": {"fidelity": "quasi_static"},
  "terrain": {"rocks": {"kind": "none"}},
  "course": {"start_x_m": 1.0, "goal_x_m": 3.0}
})";

}  // namespace

int main() {
  scenario::Scenario defaults;
  defaults.drive.navigation.navigators.Add(DescribeBeeline());
  const scenario::Scenario scenario = scenario::ParseScenario(kScenario, {}, ".", defaults);
  const auto experiment = experiments::MakeExperiment(scenario.experiment, scenario.drive);
  const bool arrived = experiment->Run(1, 0).outcome == truth::TrialOutcome::kGoalReached;
  std::puts(arrived ? "own_navigator: ok" : "own_navigator: did not arrive");
  return arrived ? 0 : 1;
}

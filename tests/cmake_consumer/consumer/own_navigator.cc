// A navigator that rockyard does not know drives a trial of a scenario that names it.
#include <cstdio>

#include "api/scenario.h"
#include "beeline.h"
#include "navigation/navigator.h"

namespace {

constexpr const char* kScenario = R"({
  "navigation": {"navigator": "beeline", "beeline": {"tolerance_m": 0.05}},
  "localization": {"estimator": "oracle"},
  "rover": {"fidelity": "quasi_static"},
  "terrain": {"rocks": {"kind": "none"}},
  "course": {"start_x_m": 1.0, "goal_x_m": 3.0}
})";

}  // namespace

int main() {
  using namespace rockyard;
  api::Scenario defaults;
  defaults.navigators().Add(DescribeBeeline());
  const auto experiment = api::Scenario::Parse(kScenario, {}, ".", defaults).MakeExperiment();
  const bool arrived = experiment->Run(1, 0).outcome == truth::TrialOutcome::kGoalReached;
  std::puts(arrived ? "own_navigator: ok" : "own_navigator: did not arrive");
  return arrived ? 0 : 1;
}

#include "campaign/doubts/setting_doubts.h"

#include <initializer_list>
#include <utility>

#include "campaign/doubts/setting_values.h"

namespace rockyard::campaign {

std::vector<core::Problem> DoubtsOfSettings(const scenario::Scenario& scenario) {
  Values s(scenario);
  // What another program brings has rules of its own (its parameters' bounds).
  const bool known = s.Uses("pathfinder") || s.Uses("gestalt") || s.Uses("route");
  if (!known || !(s.SeesBy("light_stripe") || s.SeesBy("stereo"))) return {};
  const auto ask = [&](std::initializer_list<void (*)(Values&)> rules) {
    for (const auto rule : rules) rule(s);
  };
  switch (scenario.experiment.kind) {
    case experiments::ExperimentKind::kDrive:
      ask({DoubtTask, DoubtRover, DoubtSensing, DoubtGestalt, DoubtBelief, DoubtUnusual});
      break;
    // Its sols have courses of their own, and aids that come when operators look.
    case experiments::ExperimentKind::kMission:
      ask({DoubtMission, DoubtRover, DoubtSensing, DoubtGestalt, DoubtUnusual});
      break;
    case experiments::ExperimentKind::kHazardDetection:
      ask({DoubtScenes, DoubtUnusual});
      break;
    default:  // without rules of their own
      break;
  }
  return std::move(s.doubts);
}

}  // namespace rockyard::campaign

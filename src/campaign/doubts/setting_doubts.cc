#include "campaign/doubts/setting_doubts.h"

#include <utility>

#include "campaign/doubts/setting_values.h"

namespace rockyard::campaign {

std::vector<core::Problem> DoubtsOfSettings(const scenario::Scenario& scenario) {
  Values s(scenario);
  // What another program brings has rules of its own (its parameters' bounds).
  const bool known = s.Uses("pathfinder") || s.Uses("gestalt") || s.Uses("route");
  if (!known || !(s.SeesBy("light_stripe") || s.SeesBy("stereo"))) return {};
  for (const auto rule :
       {DoubtTask, DoubtRover, DoubtSensing, DoubtGestalt, DoubtBelief, DoubtUnusual}) {
    rule(s);
  }
  return std::move(s.doubts);
}

}  // namespace rockyard::campaign

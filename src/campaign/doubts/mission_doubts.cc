#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "campaign/doubts/setting_values.h"
#include "experiments/mission/command_cycle.h"
#include "experiments/mission/mission_params.h"

namespace rockyard::campaign {
namespace {

// Of the lander, of all goals.
double Farthest_m(const experiments::MissionParams& mission) {
  double farthest_m = 0.0;
  for (const messages::Goal& goal : mission.goals.Places()) {
    farthest_m = std::max(farthest_m,
                          std::hypot(goal.x_m - mission.lander_x_m, goal.y_m - mission.lander_y_m));
  }
  return farthest_m;
}

}  // namespace

void DoubtMission(Values& s) {
  const experiments::MissionParams& mission = s.whole.experiment.mission;
  const double far_m = Farthest_m(mission);
  const std::string goals = fmt::format("goals up to {:.3g} m from the lander", far_m);
  s.AtLeast("mission.radio_range_m", far_m, goals, "let the rover hear its commands there");
  if (mission.lander_update != experiments::LanderUpdate::kNone) {
    s.AtLeast("sensors.aids.lander_fix.range_m", 0.5 * far_m, goals,
              "let the lander find the rover there, or set mission.lander_update=none");
  }
  const double needed_bits = experiments::NeededBits(mission.day);
  constexpr double kMostSols = 3.0;  // published rates take one
  const double sols = needed_bits / experiments::SolBits(mission.day);
  s.Doubt(sols > kMostSols, "mission.day.downlink_bit_s",
          fmt::format("{:.3g} Mbit that a command needs take {:.3g} sols to reach the Earth",
                      1e-6 * needed_bits, sols),
          "use a faster link, more hours, or fewer images");
}

}  // namespace rockyard::campaign

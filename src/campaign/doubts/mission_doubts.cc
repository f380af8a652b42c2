#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "campaign/doubts/setting_values.h"
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

void DoubtLander(Values& s, const experiments::MissionParams& mission) {
  const double far_m = Farthest_m(mission);
  const std::string goals = fmt::format("goals up to {:.3g} m from the lander", far_m);
  s.AtLeast("mission.radio_range_m", far_m, goals, "let the rover hear its commands there");
  if (mission.lander_update != experiments::LanderUpdate::kNone) {
    s.AtLeast("sensors.aids.lander_fix.range_m", 0.5 * far_m, goals,
              "let the lander find the rover there, or set mission.lander_update=none");
  }
  const experiments::MissionDayParams& day = mission.day;
  const double bits =
      static_cast<double>(day.lander_images) * day.lander_image_bits / day.compression +
      day.RoverBits();
  constexpr double kMostSols = 3.0;  // published rates take one
  const double sols = bits / (day.downlink_bit_s * 3600.0 * day.downlink_h);
  s.Doubt(sols > kMostSols, "mission.day.downlink_bit_s",
          fmt::format("{:.3g} Mbit that a command needs take {:.3g} sols to reach the Earth",
                      1e-6 * bits, sols),
          "use a faster link, more hours, or fewer images");
}

void DoubtPower(Values& s, const experiments::MissionParams& mission) {
  constexpr double kSol_h = 24.66;
  constexpr double kNoonHours = 7.8;  // half a sol under a half wave
  const double sun_wh = kNoonHours * mission.power.noon_W;
  const double asleep_wh = (kSol_h - mission.day.window_h) * mission.power.sleep_W;
  s.Doubt(sun_wh > 0.0 && asleep_wh > sun_wh, "mission.power.sleep_W",
          fmt::format("asleep it draws {:.3g} Wh a sol, and the sun gives {:.3g} Wh", asleep_wh,
                      sun_wh),
          "check the unit: it is the power of clock and heaters");
}

}  // namespace

void DoubtMission(Values& s) {
  const experiments::MissionParams& mission = s.whole.experiment.mission;
  DoubtLander(s, mission);
  DoubtPower(s, mission);
}

}  // namespace rockyard::campaign

#include "campaign/setup_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/fields.h"

namespace rockyard::campaign {
namespace {

// "dead_reckoning" to "dead reckoning".
std::string Words(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

template <typename Enum>
std::string Words(Enum value) {
  return Words(core::EnumNames<Enum>::kNames[static_cast<std::size_t>(value)]);
}

}  // namespace

std::vector<std::string> SetupInWords(const scenario::Scenario& scenario) {
  if (scenario.experiment.kind != experiments::ExperimentKind::kDrive) return {};
  const trial::DriveParams& drive = scenario.drive;
  const rover::RoverParams& rover = drive.rover;
  return {fmt::format("rover {:g} m long, {:g} kg, wheels of {:g} cm; {:g} m/s2, {}; {} physics",
                      rover.geometry.length_m, rover.mass.total_kg,
                      200.0 * rover.geometry.wheel_radius_m, rover.physics.gravity_m_s2,
                      Words(drive.terrain.ground.soil.preset), Words(rover.fidelity)),
          fmt::format("looks by {}, drives by {}, localizes by {}",
                      Words(drive.sensors.terrain_sensors.chosen().name()),
                      Words(drive.navigation.navigators.chosen().name()),
                      Words(drive.localization.estimators.chosen().name()))};
}

}  // namespace rockyard::campaign

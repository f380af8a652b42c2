#include "scenario/ablations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/json_file.h"
#include "core/text.h"
#include "scenario/load.h"

namespace rockyard::scenario {
namespace {

using Settings = std::string_view;

constexpr std::array<Settings, 1> kPerfectDesignation{"course.designation.enabled=false"};

constexpr std::array<Settings, 1> kPerfectLocalization{"localization.estimator=oracle"};

// Whole groups are emptied, so that their defaults hold, which are no errors. Must list every error
// of a terrain sensor that stands outside of these groups.
constexpr std::array<Settings, 13> kPerfectSensing{
    "sensors.light_stripe.fidelity=geometric",    "sensors.light_stripe.columns=16384",
    "sensors.light_stripe.column_noise_px=0",     "sensors.light_stripe.missed_probability=0",
    "sensors.light_stripe.missed_at=[]",          "sensors.light_stripe.wrong_place_probability=0",
    "sensors.light_stripe.outlier_persistence=0", "sensors.stereo.fidelity=ideal",
    "perception.calibration.left_camera={}",      "perception.calibration.right_camera={}",
    "perception.calibration.lasers={}",           "perception.calibration.stereo_front={}",
    "perception.calibration.stereo_rear={}"};

constexpr std::array<Settings, 1> kPerfectPathSelection{"navigation.navigator=route"};

constexpr std::array<Settings, 6> kNoAvoidance{"navigation.navigator=pathfinder",
                                               "perception.hazard.enabled=false",
                                               "sensors.vehicle.articulation.enabled=false",
                                               "sensors.vehicle.accelerometers.enabled=false",
                                               "sensors.vehicle.motor_current.enabled=false",
                                               "sensors.vehicle.contact.enabled=false"};

// Without slip nothing is left of what the odometer's scale is calibrated for, nor of the scatter
// of distance on level sand that encoder noise stands for, nor of what slip adds to noise.
constexpr std::array<Settings, 6> kNoSlip{
    R"(terrain.ground.soil={"preset": "hard_ground", "friction_angle_deg": 60})",
    "perception.dead_reckoning.distance_scale=1",
    "sensors.encoders.distance_variance_m2_per_m=0",
    "sensors.encoders.physics_variance_m2_per_m=0",
    "sensors.encoders.level_sand_gain=1",
    "sensors.gyro.level_sand_gain=1"};

constexpr std::array kAblations{
    Ablation{"perfect_designation", "the rover is told the true goal", kPerfectDesignation},
    Ablation{"perfect_localization",
             "the rover knows its true pose: an oracle in place of encoders and gyro",
             kPerfectLocalization},
    Ablation{"perfect_sensing",
             "the terrain sensor shows what lies where it looks: no noise, misses, misplaced "
             "points, quantisation or errors of calibration; it sees no more ground than before",
             kPerfectSensing},
    Ablation{"perfect_path_selection",
             "an oracle that knows every rock plans the route, which the rover follows blindly",
             kPerfectPathSelection},
    Ablation{"no_avoidance",
             "the behaviour controller drives to the goal and neither looks for hazards nor feels "
             "any, whichever navigator there was",
             kNoAvoidance},
    Ablation{"no_slip",
             "hard ground on which wheels roll without slip, an odometer that is right on it, and "
             "encoders without scatter",
             kNoSlip},
};

// Adds to a default set the kinds that another one has beyond it, with their parameters.
template <typename Set>
void AddUnknown(const Set& other, Set& known) {
  const std::size_t own = known.kinds().size();
  for (std::size_t i = own; i < other.kinds().size(); ++i) known.Add(other.kinds()[i]->Clone());
}

// Returns a default scenario that knows the navigators, estimators and readers of another one, for
// a document that is made of it: what the document leaves out has its default.
Scenario DefaultsKnowing(const Scenario& scenario) {
  Scenario defaults;
  defaults.plugins = scenario.plugins;
  AddUnknown(scenario.drive.navigation.navigators, defaults.drive.navigation.navigators);
  AddUnknown(scenario.drive.localization.estimators, defaults.drive.localization.estimators);
  AddUnknown(scenario.drive.perception.readers, defaults.drive.perception.readers);
  return defaults;
}

// Returns whether the ablation would change nothing. A document that the experiment refuses (it may
// measure the errors that are taken away) is another scenario.
bool IsInForce(const Scenario& scenario, const Ablation& ablation) {
  core::JsonValue document = WriteScenario(scenario);
  ApplyAblation(document, ablation.name);
  try {
    return Fingerprint(ReadScenario(document, DefaultsKnowing(scenario))) == Fingerprint(scenario);
  } catch (const core::UserError&) {
    return false;
  }
}

void RequireEachOnce(std::span<const std::string> names, std::vector<core::Problem>& problems) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    try {
      FindAblation(names[i]);
    } catch (const core::UserError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
    const auto end = names.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(names.begin(), end, names[i]) != end) {
      problems.push_back(
          {"ablation", fmt::format("\"{}\" is given twice", names[i]), "give each once"});
    }
  }
}

}  // namespace

std::span<const Ablation> Ablations() { return kAblations; }

const Ablation& FindAblation(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Ablation& ablation : kAblations) {
    if (ablation.name == name) return ablation;
    names.push_back(ablation.name);
  }
  throw core::UserError("ablation", fmt::format("there is no \"{}\"", name),
                        core::Suggest(name, names));
}

void ApplyAblation(core::JsonValue& document, std::string_view name) {
  for (const std::string_view setting : FindAblation(name).settings) {
    core::ApplyOverride(document, setting);
  }
}

AblatedScenario WithAblations(const Scenario& scenario, std::span<const std::string> names) {
  std::vector<core::Problem> problems;
  RequireEachOnce(names, problems);
  if (!problems.empty()) throw core::UserError(std::move(problems));
  AblatedScenario ablated{scenario, {}};
  for (const std::string& name : names) {
    if (IsInForce(scenario, FindAblation(name))) ablated.idle.push_back(name);
    core::JsonValue document = WriteScenario(ablated.scenario);
    ApplyAblation(document, name);
    ablated.scenario = ReadScenario(document, DefaultsKnowing(scenario));
  }
  for (const std::string& name : names) {
    if (IsInForce(ablated.scenario, FindAblation(name))) continue;
    problems.push_back({"ablation", fmt::format("\"{}\" is undone by another one", name),
                        "leave one of the two out"});
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
  return ablated;
}

std::vector<std::string> AblationsInForce(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const Ablation& ablation : kAblations) {
    if (IsInForce(scenario, ablation)) names.emplace_back(ablation.name);
  }
  return names;
}

}  // namespace rockyard::scenario

#include "campaign/scenario_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <string_view>
#include <utility>

#include "campaign/doubts/setting_doubts.h"
#include "campaign/run_source.h"
#include "core/archive.h"
#include "core/json_text.h"
#include "rover/rover.h"
#include "scenario/load.h"
#include "terrain/terrain.h"
#include "trial/open_values_params.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;
using core::Problem;

// A limit that is doubted below `least`. A `value` of 0 means that there is no limit, and is not
// doubted.
struct LimitRule {
  std::string_view path;
  double value;
  double least;
  std::string_view unit;
  std::string suggestion;
};

void DoubtLimits(const trial::DriveParams& drive, std::vector<Problem>& doubts) {
  const double course_m = trial::CourseLength_m(drive.course);
  const trial::RefereeParams& referee = drive.referee;
  constexpr std::string_view kTimeLimit = "referee.time_limit_s";
  const std::string follow = "state it, or null to have it follow the course";
  // Limits of the referee: less than half of what PatienceFor (trial/open_values_params.h) gives
  // where the value is left open; task_doubts.cc has the bound of the time limit, too. Batteries: a
  // drive of Rocky 3.2 takes 2 Wh and more a metre among rocks.
  const LimitRule rules[] = {
      {"referee.no_path_distance_m", referee.no_path_distance_m, 0.25 * course_m, "m", follow},
      {"referee.no_path_time_s", referee.no_path_time_s, 200.0 * course_m, "s", follow},
      {kTimeLimit, referee.time_limit_s, 800.0 * course_m, "s", follow},
      {"energy.battery_wh", drive.energy.battery_wh, 2.0 * course_m, "Wh",
       "state what the rover carries, or 0 for no limit"},
  };
  // A time limit too short to arrive at full speed is meant as a duration, and is not doubted.
  const double fastest_s = course_m / drive.rover.drive.speed_m_s;
  for (const LimitRule& rule : rules) {
    const bool is_duration = rule.path == kTimeLimit && rule.value < fastest_s;
    if (rule.value <= 0.0 || rule.value >= rule.least || is_duration) continue;
    doubts.push_back({std::string(rule.path),
                      fmt::format("{:g} {} are little for a course of {:.3g} m", rule.value,
                                  rule.unit, course_m),
                      rule.suggestion});
  }
}

// Doubts the mass over the box that the rover fills: Rocky 3.2 has 210 kg/m3, the MFEX rover 110,
// the Athena SDM 60.
void DoubtMass(const trial::DriveParams& drive, std::vector<Problem>& doubts) {
  constexpr double kLeast_kg_m3 = 30.0;
  constexpr double kMost_kg_m3 = 500.0;
  const rover::RoverGeometryParams& box = drive.rover.geometry;
  const double mass_kg = drive.rover.mass.total_kg;
  const double density_kg_m3 = mass_kg / (box.length_m * box.width_m * box.height_m);
  if (density_kg_m3 > kLeast_kg_m3 && density_kg_m3 < kMost_kg_m3) return;
  doubts.push_back({"rover.mass",
                    fmt::format("{:g} kg are {} for a rover of {:g} x {:g} x {:g} m", mass_kg,
                                density_kg_m3 < kLeast_kg_m3 ? "little" : "much", box.length_m,
                                box.width_m, box.height_m),
                    "state its masses, and what its motors can do (rover.drive)"});
}

void DoubtSizes(const trial::DriveParams& drive, std::vector<Problem>& doubts) {
  const rover::RoverGeometryParams& rover = drive.rover.geometry;
  if (drive.course.goal_radius_m < 0.4 * rover.length_m) {
    doubts.push_back({"course.goal_radius_m",
                      fmt::format("{:g} m is less than half of the rover, which is {:g} m long",
                                  drive.course.goal_radius_m, rover.length_m),
                      "state how near its middle has to come"});
  }
}

// Returns the true way over the way of the rims on level sand, measured with the quasi-static
// rover.
double MeasuredLevelScale(const trial::DriveParams& drive) {
  constexpr double kRolled_m = 1.0;
  rover::RoverParams params = drive.rover;
  params.fidelity = rover::Fidelity::kQuasiStatic;
  terrain::GroundParams level;
  level.soil = drive.terrain.ground.soil;
  const terrain::Terrain sand(terrain::Ground(level, {}), {}, {});
  const std::unique_ptr<rover::Rover> rover = rover::MakeRover(params, sand);
  rover->Place({});
  const double start_m = rover->state().X_WR.translation().x();
  messages::WheelCommand ahead;
  ahead.rate_rad_s.fill(params.drive.speed_m_s / params.geometry.wheel_radius_m);
  double rolled_m = 0.0;
  while (rolled_m < kRolled_m) {
    rover->Step(ahead);
    const auto& angles = rover->state().wheel_angle_rad;
    rolled_m = params.geometry.wheel_radius_m * std::accumulate(angles.begin(), angles.end(), 0.0) /
               static_cast<double>(angles.size());
  }
  return (rover->state().X_WR.translation().x() - start_m) / rolled_m;
}

// Measured scales by rover and soil: the cells of a sweep share a few of them.
class LevelScales {
 public:
  double Of(const trial::DriveParams& drive) {
    const std::string key = core::DumpJson(core::WriteParams(drive.rover)) +
                            core::DumpJson(core::WriteParams(drive.terrain.ground.soil));
    const auto [known, is_new] = scales_.try_emplace(key);
    if (is_new) known->second = MeasuredLevelScale(drive);
    return known->second;
  }

 private:
  std::map<std::string, double> scales_;
};

// Returns what terrain makes of the scale of level sand, since rims go a longer way over rocks:
// 16.3 % less in Viking Lander 2 terrain (results/gestalt.md), nothing without rocks, in proportion
// between. On slopes, rough ground and listed rocks nobody knows it; the 16.3 % are taken there.
double ShareOfTerrain(const terrain::TerrainParams& terrain) {
  constexpr double kLess = 0.163;
  constexpr double kVikingLander2_per_m2 = 0.013;
  constexpr double kVikingLander2_cover = 0.176;
  const terrain::RockFieldKind rocks = terrain.rocks.kind;
  if (!terrain.ground.IsLevel() || rocks == terrain::RockFieldKind::kListed) return 1.0 - kLess;
  if (rocks == terrain::RockFieldKind::kNone) return 1.0;
  const double abundance = rocks == terrain::RockFieldKind::kGolombek
                               ? terrain.rocks.cover / kVikingLander2_cover
                               : terrain.rocks.k_per_m2 / kVikingLander2_per_m2;
  return 1.0 - kLess * std::min(1.0, abundance);
}

// Doubts the scale of the odometer; 1 is the wheels' own distance. Navigators that keep away from
// rocks need the scale of level sand.
void DoubtOdometer(const trial::DriveParams& drive, LevelScales& scales,
                   std::vector<Problem>& doubts) {
  constexpr double kMore = 0.015;  // a tenth of a metre over the Pathfinder course
  constexpr double kLess = 0.05;
  constexpr double kStuck = 0.5;
  const double scale = drive.perception.dead_reckoning.distance_scale;
  if (scale == 1.0) return;
  const double level = scales.Of(drive);
  const double share = ShareOfTerrain(drive.terrain);
  const double least = level * share * (1.0 - (share == 1.0 ? kMore : kLess));
  if (scale >= least && scale <= level * (1.0 + kMore)) return;
  if (level < kStuck) {
    doubts.push_back(
        {"rover.drive",
         fmt::format("wheels spin: on level ground it goes {:.3f} of what they roll", level),
         "check soil, mass and motors"});
    return;
  }
  doubts.push_back({"perception.dead_reckoning.distance_scale",
                    fmt::format("{:g} does not suit these wheels: {:.3f} does on level ground, and "
                                "{:.3f} where they roll over its rocks",
                                scale, level, level * share),
                    "divide it by 1 + e / 100, where e is the median distance error of a run"});
}

// Returns whether "Mars" is a word of the name; "marsupial" is none.
bool SaysMars(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::size_t at = name.find("mars");
  const auto ends = [&](std::size_t i) {
    return i >= name.size() || std::isalpha(static_cast<unsigned char>(name[i])) == 0;
  };
  return at != std::string::npos && (at == 0 || ends(at - 1)) && ends(at + 4);
}

void DoubtGravity(const scenario::Scenario& scenario, std::vector<Problem>& doubts) {
  // The bound must agree with kBetween_m_s2 in doubts/sensing_doubts.cc.
  constexpr double kBetweenMarsAndEarth_m_s2 = 6.0;  // 3.72 and 9.81
  constexpr std::string_view kPath = "rover.physics.gravity_m_s2";
  const double gravity_m_s2 = scenario.drive.rover.physics.gravity_m_s2;
  if (!SaysMars(scenario.name) || gravity_m_s2 < kBetweenMarsAndEarth_m_s2) return;
  doubts.push_back({std::string(kPath),
                    fmt::format("{:g} m/s2 are not those of Mars", gravity_m_s2), "write 3.72"});
}

void DoubtSoil(const scenario::Scenario& scenario, std::vector<Problem>& doubts) {
  if (!SaysMars(scenario.name)) return;
  if (scenario.drive.terrain.ground.soil.preset != terrain::SoilPreset::kLandscapingSand) return;
  doubts.push_back({"terrain.ground.soil", "is the sand of an arena on Earth",
                    "write {\"preset\": \"mars_drift\"}, or state this one"});
}

// Returns what `accepted` of a scenario quotes, and TextOf begins with. Must stay: its form.
std::string WhatOf(const Problem& doubt) { return fmt::format("{}: {}", doubt.path, doubt.reason); }

std::vector<Problem> DoubtsWith(const scenario::Scenario& scenario, LevelScales& scales) {
  std::vector<Problem> doubts;
  if (scenario.experiment.chosen().name() == "drive") {
    DoubtLimits(scenario.drive, doubts);
    DoubtMass(scenario.drive, doubts);
    DoubtSizes(scenario.drive, doubts);
    DoubtOdometer(scenario.drive, scales, doubts);
    DoubtGravity(scenario, doubts);
    DoubtSoil(scenario, doubts);
  }
  std::ranges::move(DoubtsOfSettings(scenario), std::back_inserter(doubts));
  std::erase_if(doubts, [&](const Problem& doubt) {
    return scenario.accepted.find(WhatOf(doubt)) != std::string::npos;
  });
  return doubts;
}

}  // namespace

std::vector<Problem> Doubts(const scenario::Scenario& scenario) {
  LevelScales scales;
  return DoubtsWith(scenario, scales);
}

std::vector<Problem> DoubtsOf(const std::filesystem::path& source,
                              std::span<const std::string> overrides,
                              const scenario::Scenario& defaults) {
  return Doubts(LoadScenarioFrom(source, overrides, "", defaults));
}

std::vector<Problem> DoubtsOf(const scenario::Sweep& sweep) {
  LevelScales scales;
  std::map<std::string, std::pair<Problem, int>> found;  // by path: the first, and how many
  for (const scenario::SweepCell& cell : sweep.cells) {
    for (Problem& doubt : DoubtsWith(cell.scenario, scales)) {
      const std::string path = doubt.path;
      doubt.path = fmt::format("cell {}: {}", cell.name, path);
      ++found.try_emplace(path, std::move(doubt), 0).first->second.second;
    }
  }
  std::vector<Problem> doubts;
  for (auto& [path, first] : found) {
    auto& [doubt, cells] = first;
    if (cells > 1)
      doubt.reason += fmt::format(" (and so in {} more cell{})", cells - 1, cells > 2 ? "s" : "");
    doubts.push_back(std::move(doubt));
  }
  return doubts;
}

std::string TextOf(const Problem& doubt) {
  return fmt::format("{}; {}", WhatOf(doubt), doubt.suggestion);
}

}  // namespace rockyard::campaign

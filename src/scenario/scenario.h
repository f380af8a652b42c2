// Everything that an experiment needs to know, composed of every module's parameters.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/fields.h"
#include "experiments/hazard_detection_params.h"
#include "rover/rover_params.h"
#include "scenario/suite.h"
#include "terrain/terrain_params.h"
#include "trial/clock_params.h"
#include "trial/course_params.h"
#include "trial/energy_params.h"
#include "trial/referee_params.h"

namespace rockyard::scenario {

// What one run of the experiment is.
enum class ExperimentKind {
  kDrive,            // the closed-loop drive to a goal
  kHazardDetection,  // what the light stripe sensor sees and misses
};

struct Scenario {
  std::int64_t schema_version = 1;
  std::string name = "unnamed";
  std::string description;
  ExperimentKind experiment = ExperimentKind::kDrive;
  std::int64_t trials = 300;
  std::int64_t seed = 1;
  terrain::TerrainParams terrain;
  rover::RoverParams rover;
  SensorParams sensors;
  PerceptionParams perception;
  NavigationParams navigation;
  trial::CourseParams course;
  trial::RefereeParams referee;
  trial::ClockParams clock;
  trial::EnergyParams energy;
  experiments::HazardDetectionParams hazard_detection;

  // Lists every field and the conditions across modules.
  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::scenario

template <>
struct rockyard::core::EnumNames<rockyard::scenario::ExperimentKind> {
  static constexpr std::array<std::string_view, 2> kNames{"drive", "hazard_detection"};
};

// What a scenario file holds: which experiment, how often, from which seed, on what drive.
// Campaigns, commands and sweeps hold scenarios as this struct; `api` hides it. A default decides
// the records of files that leave it out, and the order in Visit every fingerprint (scenario.cc).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/fields.h"
#include "experiments/experiment_set_params.h"
#include "plugin/plugin_use.h"
#include "trial/drive_params.h"

namespace rockyard::scenario {

struct Scenario {
  std::int64_t schema_version = 1;
  std::string name = "unnamed";
  std::string description;
  std::string accepted;  // doubts (campaign/scenario_doubts.h) that are meant so, by their words
  experiments::ExperimentSet experiment = experiments::StandardExperiments();
  std::int64_t trials = 300;
  std::int64_t seed = 1;
  trial::DriveParams drive;
  // Whose navigators are among those of `drive`. No field of Visit: load.cc reads and writes it.
  std::vector<plugin::PluginUse> plugins;

  // Lists every field and the conditions across modules. The groups of `drive` and of `experiment`
  // stand at the top level of a file.
  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::scenario

// From the levels of a cell to its scenario. Only LoadSweep uses it. Fingerprint and records of a
// cell depend on which setting lies over which.
#pragma once

#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/json_value.h"
#include "scenario/scenario.h"
#include "scenario/sweep_spec.h"

namespace rockyard::scenario {

struct ResolvedCell {
  Scenario scenario;
  core::JsonValue document;             // WriteScenario of it
  std::vector<core::Problem> problems;  // settings that are not there in the end
};

// Returns the value at a dotted path; nullptr where there is none.
const core::JsonValue* FindPath(const core::JsonValue& document, std::string_view path);

// Lays base, "set" of the file and levels over each other (sweep.h), reads the result, and reads
// every setting back from it; ablations go over all of that. Throws core::UserError where the
// result is no valid scenario.
ResolvedCell ResolveCell(const SweepSpec& spec, const std::vector<LevelSpec>& levels);

}  // namespace rockyard::scenario

// Runs against a baseline of results/baselines.
#pragma once

#include <string>
#include <vector>

#include "app/exit_code.h"
#include "core/json_value.h"
#include "statistics/regression.h"

namespace rockyard::app {

// What a run in another scenario than the baseline's is.
enum class ScenarioChange {
  kRefuse,  // a mistake: exit code 2
  kAllow,   // what is to be examined: noted
};

struct RegressionRequest {
  std::vector<std::string> runs;
  std::string cell;  // of each run only that one, by name or number; empty: all
  std::string junit;
  std::string csv;
  ScenarioChange scenario_change = ScenarioChange::kRefuse;
  bool json = false;  // for programs; else text
  bool all_rows = false;
  statistics::RegressionOptions options;
};

// Prints the report and writes the files. Each cell of the baseline needs one of the runs, found by
// its name (a run of one scenario goes by the scenario's; where both are one cell, by nothing).
// Exit code 1 where a metric changed, or where the baseline's own build gave other records; 4 where
// something is inconclusive, lacking or unknown; else 0.
// Throws core::UserError: a cell is missing, a setting that the baseline knows differs, or a
// younger one is not at its default (all of them are named), trials share rocks, nothing is
// finished.
ExitCode CheckAgainstBaseline(const core::JsonValue& baseline, const RegressionRequest& request);

}  // namespace rockyard::app

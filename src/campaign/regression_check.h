// Runs against a baseline of results/baselines.
#pragma once

#include <string>
#include <vector>

#include "campaign/outcome.h"
#include "core/json_value.h"
#include "report/regression_report.h"
#include "statistics/regression.h"

namespace rockyard::campaign {

// What a run in another scenario than the baseline's is.
enum class ScenarioChange {
  kRefuse,  // a mistake, and bad input
  kAllow,   // what is to be examined: noted
};

// What changed records are, apart from what they say.
enum class RecordChange {
  kTell,    // a finding, which decides nothing
  kRefuse,  // a difference; and where trials are no pairs, nothing that could be decided
};

struct RegressionRequest {
  std::vector<std::string> runs;
  std::string cell;  // of each run only that one, by name or number; empty: all
  ScenarioChange scenario_change = ScenarioChange::kRefuse;
  RecordChange record_change = RecordChange::kTell;
  statistics::RegressionOptions options;
};

struct BaselineCheck {
  report::RegressionReport report;
  Outcome outcome = Outcome::kDone;
};

// Each cell of the baseline needs one of the runs, found by
// its name (a run of one scenario goes by the scenario's; where both are one cell, by nothing).
// kDiffers where a metric changed, or where the baseline's own build gave other records, or any
// build where records may not change; kInconclusive where a primary metric is inconclusive, or a
// metric is lacking or unknown, or records may not change and cannot be compared; else kDone.
// Throws core::UserError: a cell is missing, a setting that the baseline knows differs, or a
// younger one is not at its default (all of them are named), trials share rocks, nothing is
// finished.
BaselineCheck CheckAgainstBaseline(const core::JsonValue& baseline,
                                   const RegressionRequest& request);

}  // namespace rockyard::campaign

// Runs against published values or against a baseline.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "campaign/work.h"
#include "core/json_value.h"
#include "core/result.h"
#include "report/regression_report.h"
#include "statistics/published_comparison.h"
#include "statistics/published_values.h"
#include "statistics/regression.h"

namespace rockyard::campaign {

// Runs against a baseline of results/baselines.

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

struct BaselineCheck {
  report::RegressionReport report;
  Outcome outcome = Outcome::kDone;
};

struct CheckRequest {
  std::vector<std::string> runs;    // folders of runs, or of such folders
  std::filesystem::path reference;  // file with published values, or with a baseline
  std::string cell = {};            // of each campaign: its name or number; empty: see below
  // Of published values.
  statistics::ComparisonOptions comparison = {};
  // Of a baseline.
  statistics::RegressionOptions regression = {};
  ScenarioChange scenario_change = ScenarioChange::kRefuse;
  RecordChange record_change = RecordChange::kTell;
};

struct PublishedCheck {
  statistics::PublishedReference reference;
  statistics::ComparisonResult result;
  Outcome outcome = Outcome::kDone;  // kDiffers, kInconclusive or kDone
};

using CheckResult = std::variant<PublishedCheck, BaselineCheck>;

// Published values need one run of each scenario, a baseline one of each cell. Without a cell
// published values take campaigns of one cell alone, a baseline all cells. Cost: that of the
// resampling, some seconds.
//
// Each cell of a baseline needs one of the runs, found by its name (a run of one scenario goes by
// the scenario's; where both are one cell, by nothing). kDiffers where a metric changed, or where
// the baseline's own build gave other records, or any build where records may not change;
// kInconclusive where a primary metric is inconclusive, or a metric is lacking or unknown, or
// records may not change and cannot be compared; else kDone. An error: a cell is missing, a setting
// that the baseline knows differs, or a younger one is not at its default (all of them are named),
// trials share rocks, nothing is finished.
core::Result<CheckResult> Check(const CheckRequest& request, const Observer& observer = {});

// One object, as report/README.md describes it.
std::string CheckJson(const PublishedCheck& check);
std::string CheckJson(const BaselineCheck& check);

}  // namespace rockyard::campaign

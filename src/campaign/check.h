// Runs against published values or against a baseline. The command `check` and programs ask it. No
// record depends on it; outcomes are exit codes. Its resampling has a seed of its own.
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

// What a run in another scenario than that of the baseline is.
enum class ScenarioChange {
  kRefuse,  // a mistake, and bad input
  kAllow,   // what is to be examined: noted
};

// What records are that changed, apart from what metrics say of them.
enum class RecordChange {
  kTell,    // a finding, which decides nothing
  kRefuse,  // a difference; and where trials are no pairs, nothing that could be decided
};

// What came of a check against a baseline of results/baselines.
struct BaselineCheck {
  report::RegressionReport report;
  Outcome outcome = Outcome::kDone;
};

struct CheckRequest {
  std::vector<std::string> runs;    // folders of runs, or of such folders
  std::filesystem::path reference;  // file with published values, or with a baseline
  std::string cell = {};            // of each campaign: its name or number; empty: see below
  // For published values.
  statistics::ComparisonOptions comparison = {};
  // For a baseline.
  statistics::RegressionOptions regression = {};
  ScenarioChange scenario_change = ScenarioChange::kRefuse;
  RecordChange record_change = RecordChange::kTell;
};

// What came of a check against published values.
struct PublishedCheck {
  statistics::PublishedReference reference;
  statistics::ComparisonResult result;
  Outcome outcome = Outcome::kDone;  // kDiffers, kInconclusive or kDone
};

using CheckResult = std::variant<PublishedCheck, BaselineCheck>;

// Compares the runs with the reference, which says whether it holds published values or a baseline.
// Published values need one run of each scenario, a baseline one of each cell. Without a cell in
// the request, published values take campaigns of one cell alone, a baseline all cells. Cost: that
// of the resampling, some seconds.
//
// Each cell of a baseline needs one of the runs, found by its name (a run of one scenario goes by
// the name of the scenario; where both sides are one cell, names do not count). The outcome is
// kDiffers where a metric changed, where the baseline's own build gave other records, or where
// records may not change and any build gave others. It is kInconclusive where a primary metric is
// inconclusive, a metric is lacking or unknown, or records may not change and cannot be compared;
// else kDone. Problems come instead of a result where a cell is missing, a setting that the
// baseline knows differs, or a younger one is not at its default (all of them are named), trials
// share rocks, or nothing is finished.
core::Result<CheckResult> Check(const CheckRequest& request, const Observer& observer = {});

// Returns one JSON object, as report/README.md describes it.
std::string CheckJson(const PublishedCheck& check);
std::string CheckJson(const BaselineCheck& check);

}  // namespace rockyard::campaign

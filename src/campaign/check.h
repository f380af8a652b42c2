// Runs against published values or against a baseline.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "campaign/observer.h"
#include "campaign/outcome.h"
#include "campaign/regression_check.h"
#include "core/result.h"
#include "statistics/published_comparison.h"
#include "statistics/published_values.h"

namespace rockyard::campaign {

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
core::Result<CheckResult> Check(const CheckRequest& request, const Observer& observer = {});

// One object, as report/README.md describes it.
std::string CheckJson(const PublishedCheck& check);
std::string CheckJson(const BaselineCheck& check);

}  // namespace rockyard::campaign

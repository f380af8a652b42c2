// What runs gave, kept for later builds to be held against it.
#pragma once

#include <string>
#include <vector>

#include "batch/scenario_difference.h"
#include "core/error.h"
#include "core/result.h"
#include "report/baseline.h"

namespace rockyard::campaign {

struct BaselineRequest {
  std::vector<std::string> runs;  // folders of runs of drives, or of such folders
  std::string name;
  std::string reason;  // why its numbers may be what they are
};

// Of finished runs with independent trials and names of their own. Memory: the records of one
// campaign.
core::Result<report::Baseline> MakeBaseline(const BaselineRequest& request);

// The scenario of a baseline's cell beside that of a run.

struct BaselineScenario {
  // Settings that the baseline knows, and younger ones that are not at their default: what makes it
  // another scenario. The seed is none: another seed is another sample of the same.
  std::vector<batch::ScenarioDifference> differences;
  // Settings that only the run has, at their default: whether it changes anything is what a check
  // is for.
  std::vector<std::string> younger;
  bool same_fields = true;  // those that decide rocks, start and goal are the same
};

// Both are JSON texts of resolved scenarios. Throws core::UserError on what is none.
BaselineScenario CompareWithBaseline(const std::string& baseline, const std::string& run);

// Trials that share rocks are not independent, so that neither intervals nor p-values hold: a
// problem of `label` where course.trials_per_layout is above 1.
std::vector<core::Problem> SharedLayoutProblems(const std::string& label,
                                                const std::string& resolved);

}  // namespace rockyard::campaign

// What a report is about: the folders that were named, what each run goes by, and what is told of
// it beside its trials. BuildReport asks it, the replays of a report too. No record depends on it.
// Readers of a page and of messages know a run by its label alone, so that no two may be equal;
// wording is free. Must stay: members of PageCourse as web/report/payload.ts has them, and
// "{trial}".
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "batch/result_store.h"
#include "campaign/run_source.h"
#include "core/field_table.h"
#include "report/page_data.h"
#include "scenario/scenario.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {

// A run, one cell of a campaign, or a sweep with all its cells.
struct ReportInput {
  std::filesystem::path folder;
  std::string cell;                      // as the user chose it; "" for all there is
  bool sweep = false;                    // all cells of a sweep
  std::vector<std::string> cells;        // names; one, "", of a run
  std::string label;                     // unique among all labels of the report
  std::vector<std::string> cell_labels;  // of a sweep, unique too
};

// Returns the inputs in run folders, sweep folders, and folders of such folders. `cell`: name or
// number of the cell that is taken of every one of them; "" for all cells. Throws core::UserError
// with what is wrong first in each of the paths: no run, a damaged one, a shard, no such cell, one
// folder named twice.
std::vector<ReportInput> FindReportInputs(const std::vector<std::string>& paths,
                                          const std::string& cell);

// Returns a label for each list of candidates, which go from short to long (a cell of a sweep goes
// by its name first). Labels that are used twice grow, all of them, until none is or no longer name
// is there; then all but the first get a number.
std::vector<std::string> UniqueLabels(const std::vector<std::vector<std::string>>& candidates);

// Returns the scenario of a run; nothing where it is of another version of the program.
std::optional<scenario::Scenario> ScenarioOf(const StoredRun& run);

// Returns every parameter of a run; none where its scenario is of another version of the program.
std::vector<core::ParameterInfo> ParametersOf(const StoredRun& run);

// Returns where the course of a run lies and what drives it; nothing for a measurement, or where
// the scenario is of another version of the program.
std::optional<report::PageCourse> CourseOf(const StoredRun& run);

// Returns the trial of median distance of each outcome (report/trial_outcomes.h); none for a
// measurement.
std::vector<std::uint64_t> ExamplesOf(const StoredRun& run);

// Returns the command that writes a replay of any trial, with {trial} for the number.
std::string ReplayCommand(const StoredRun& run);

// Returns the sweep that a store was made of. Throws core::UserError where this program cannot
// read it, or finds another number of cells in it.
scenario::Sweep SweepOf(const batch::ResultStore& store, const std::filesystem::path& folder);

}  // namespace rockyard::campaign

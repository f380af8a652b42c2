// What a report is about: the folders that were named, what each run goes by, and what is
// told of it beside its trials.
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

// Of run folders, sweep folders, and folders of such folders. `cell`: its name or number, of every
// one of them; "" for all cells. Throws core::UserError with everything that is wrong: no run, a
// damaged one, a shard, no such cell, one folder named twice.
std::vector<ReportInput> FindReportInputs(const std::vector<std::string>& paths,
                                          const std::string& cell);

// A label for each list of candidates, which go from short to long: the shortest that no other one
// shares; the last with a number where none is.
std::vector<std::string> UniqueLabels(const std::vector<std::vector<std::string>>& candidates);

// Nothing where the scenario is of another version of the program.
std::optional<scenario::Scenario> ScenarioOf(const StoredRun& run);

// Every parameter; none where the scenario is of another version of the program.
std::vector<core::ParameterInfo> ParametersOf(const StoredRun& run);

// Where the course of its drives lies and what drives it; nothing of a measurement, or where the
// scenario is of another version of the program.
std::optional<report::PageCourse> CourseOf(const StoredRun& run);

// Of each outcome the trial of median distance (report/trial_outcomes.h); none of a measurement.
std::vector<std::uint64_t> ExamplesOf(const StoredRun& run);

// The command that writes a replay of any trial, with {trial} for the number.
std::string ReplayCommand(const StoredRun& run);

// The sweep that a store was made of. Throws core::UserError where this program reads it
// differently.
scenario::Sweep SweepOf(const batch::ResultStore& store, const std::filesystem::path& folder);

}  // namespace rockyard::campaign

// What a report tells of a stored run beside its trials.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "batch/result_store.h"
#include "campaign/run_source.h"
#include "core/field_table.h"
#include "report/page_tracks.h"
#include "scenario/scenario.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {

// Nothing where the scenario is of another version of the program.
std::optional<scenario::Scenario> ScenarioOf(const StoredRun& run);

// Every parameter; none where the scenario is of another version of the program.
std::vector<core::ParameterInfo> ParametersOf(const StoredRun& run);

// Where the course of its drives lies and what drives it; nothing of a measurement, or where the
// scenario is of another version of the program.
std::optional<report::PageCourse> CourseOf(const StoredRun& run);

// Of each outcome the trial of median distance (report/example_trials.h); none of a measurement.
std::vector<std::uint64_t> ExamplesOf(const StoredRun& run);

// The command that writes a replay of any trial, with {trial} for the number.
std::string ReplayCommand(const StoredRun& run);

// The sweep that a store was made of. Throws core::UserError where this program reads it
// differently.
scenario::Sweep SweepOf(const batch::ResultStore& store, const std::filesystem::path& folder);

}  // namespace rockyard::campaign

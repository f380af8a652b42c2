// Where scenarios and finished runs come from.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "batch/result_store.h"
#include "report/run_description.h"
#include "scenario/scenario.h"
#include "truth/record.h"

namespace rockyard::app {

// The scenario in a scenario file, in a scenario.resolved.json, or of the run in a folder, with
// "PATH=VALUE" overrides. Throws core::UserError.
scenario::Scenario LoadScenarioFrom(const std::filesystem::path& path,
                                    std::span<const std::string> overrides = {});

// A run read back from its folder.
struct StoredRun {
  std::filesystem::path folder;
  batch::RunIdentity identity;
  std::int64_t planned = 0;
  std::vector<std::string> builds;
  std::vector<truth::Record> records;  // by trial index

  std::span<const truth::Record> prefix() const { return batch::ContiguousPrefix(records); }
};

StoredRun ReadRun(const std::filesystem::path& folder);

// The program, its compiler and the CPU level that records may depend on.
std::string BuildName();

// What a report says of a run, with the provenance of this program.
report::RunDescription Describe(const StoredRun& run, int threads);

}  // namespace rockyard::app

// Where scenarios and finished runs come from, and what there is to know of stores before their
// results are believed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "batch/result_store.h"
#include "batch/work_plan.h"
#include "report/paired_comparison.h"
#include "report/run_description.h"
#include "report/sweep_summary.h"
#include "scenario/scenario.h"
#include "statistics/published_comparison.h"
#include "truth/record.h"

namespace rockyard::campaign {

// The scenario in a scenario file, in a scenario.resolved.json, or of the run (and its cell, as
// ReadRun takes it) in a folder, with "PATH=VALUE" overrides. Absent keys keep the values of
// `defaults`. Throws core::UserError.
scenario::Scenario LoadScenarioFrom(const std::filesystem::path& path,
                                    std::span<const std::string> overrides = {},
                                    const std::string& cell = "",
                                    const scenario::Scenario& defaults = {});

// What the scenario of that source was changed by before: of a run its settings
// (CampaignIdentity::settings), of a scenario file nothing. Throws core::UserError.
std::optional<std::vector<std::string>> SettingsOf(const std::filesystem::path& path);

// What of the records of a run is read.
enum class StoredValues {
  kAll,
  kNone,  // outcomes alone: 96 bytes a trial instead of 500; the values are checked all the same
};

// One cell of a campaign, read back from its folder; of a run, the only one.
struct StoredRun {
  std::filesystem::path folder;
  int cell = 0;
  batch::CellIdentity identity;
  truth::RecordSchema schema;
  batch::Shard shard;
  std::optional<std::vector<std::string>> settings;  // CampaignIdentity::settings
  std::int64_t planned = 0;
  std::vector<std::string> builds;
  std::vector<truth::Record> records;  // by trial index
  std::int64_t infrastructure_faults = 0;
  std::optional<batch::StoppingRule> rule;
  batch::CellState state;  // where the rule ended it

  std::span<const truth::Record> prefix() const { return batch::ContiguousPrefix(records); }
  // For people: the folder, and the cell where it has a name.
  std::string Label() const;
};

// Reads cells of one store, one after the other. The store must outlive it.
class CellReader {
 public:
  CellReader(std::filesystem::path folder, const batch::ResultStore& store);
  StoredRun Load(int cell, StoredValues values = StoredValues::kAll) const;

 private:
  std::filesystem::path folder_;
  const batch::ResultStore& store_;
  std::vector<batch::CellState> ends_;
  std::vector<std::int64_t> faults_;
};

// planned = completed + faulted + pending, which is checked.
report::Accounting AccountingOf(const StoredRun& run);

// Where the rule ended the cell; nothing without a rule.
std::optional<report::StoppingReport> StoppingOf(const StoredRun& run);

// `cell`: the name of a cell, or its number from 0; may be left out where the store has only one.
// Throws core::UserError, which lists the cells where it must not be left out or is none of them.
StoredRun ReadRun(const std::filesystem::path& folder, const std::string& cell = "",
                  StoredValues values = StoredValues::kAll);

// Every cell. Memory: all records of the campaign.
std::vector<StoredRun> ReadCampaign(const std::filesystem::path& folder);

// What the cell goes by in a campaign: its name, or that of its scenario where it has none.
std::string CellName(const StoredRun& run);

// Throws core::UserError where the run is one shard of a campaign, whose trials are no contiguous
// prefix: no rate can be told from it alone.
void RequireWhole(const StoredRun& run);

// The program, its compiler and the CPU level that records may depend on. Stores and baselines keep
// it, and rank 0 tells it the others, to be compared as text.
std::string BuildName();

// What a report says of a run, with the provenance of this program.
report::RunDescription Describe(const StoredRun& run, int threads);

// The sentence for people about a store without checksums (batch::HasChecksums).
std::string NoChecksumsNote(const std::filesystem::path& folder);

// One sentence for each such store in these folders of runs, or folders of such folders. Other
// paths, and stores that cannot be read, are for whoever reads them to judge.
std::vector<std::string> StoreNotes(std::span<const std::string> paths);

// A stored run in the shapes that comparing takes; two runs of drives against each other.

// For report::CompareRuns. `run` must outlive it. Throws core::UserError where no trial is
// finished.
report::ComparedRun ComparedView(const StoredRun& run);

// For statistics::Compare. `run` must outlive it.
statistics::ScenarioRun ScenarioView(const StoredRun& run);

// For report::SummarizeSweep.
report::SweepCellTrials SweepCellView(StoredRun run);

// report::CompareRuns of the two, whose records need no values here (StoredValues::kNone): they are
// read again from the stores, some columns of both at a time. Memory: so many values, 130 MB, or
// one column of each where that is more; and 200 bytes a trial of each. Throws core::UserError
// where no trial of a run is finished.
report::RunComparison CompareDrives(const StoredRun& first, const StoredRun& second,
                                    std::size_t values_at_once = std::size_t{1} << 24);

}  // namespace rockyard::campaign

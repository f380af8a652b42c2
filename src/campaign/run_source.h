// Where scenarios and finished runs come from, and what there is to know of stores before their
// results are believed; stored runs in the shapes that comparing takes. All work on stored runs
// reads them here, and most commands their scenario.
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
#include "scenario/sweep.h"
#include "statistics/published_comparison.h"
#include "truth/record.h"

namespace rockyard::campaign {

// Returns the scenario in a scenario file, in a scenario.resolved.json, or of the run in a folder
// (and of its cell, as ReadRun takes it), with "PATH=VALUE" overrides. Absent keys keep the values
// of `defaults`. Throws core::UserError.
scenario::Scenario LoadScenarioFrom(const std::filesystem::path& path,
                                    std::span<const std::string> overrides = {},
                                    const std::string& cell = "",
                                    const scenario::Scenario& defaults = {});

// Returns the columns of the records that runs of the scenario have: those of its experiment, and
// what its navigators count for themselves.
truth::RecordSchema ColumnsOf(const scenario::Scenario& scenario);

// Returns what the scenario of that source was changed by before: for a run its settings
// (CampaignIdentity::settings), for a scenario file an empty list. Absent where it is not known.
// Throws core::UserError.
std::optional<std::vector<std::string>> SettingsOf(const std::filesystem::path& path);

// Return whether a plugin decides in the trials of a resolved scenario, and the scenario by which
// they are driven again: its plugins are opened where one decides, and else they may be gone.
// `source` names it in messages. Throws core::UserError.
bool PluginDecides(const std::string& resolved);
scenario::Scenario ScenarioToDrive(const std::string& resolved, const std::string& source);

// Returns the sweep whose campaign the store holds; opens no plugins. Throws core::UserError.
scenario::Sweep StoredSweep(const batch::ResultStore& store);

// Which values of the records of a run are read.
enum class StoredValues {
  kAll,
  kNone,  // outcomes alone: 96 bytes a trial instead of 500; the values are checked all the same
};

// One cell of a campaign, read back from its folder. A run has one cell.
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
  // Returns the folder, and the cell where it has a name, for people.
  std::string Label() const;
};

// Reads cells of one store, one after the other. The store must outlive the reader.
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

// Returns the counts of a run. They must add up: planned = completed + faulted + pending.
report::Accounting AccountingOf(const StoredRun& run);

// Returns where the rule ended the cell; nothing without a rule.
std::optional<report::StoppingReport> StoppingOf(const StoredRun& run);

// Returns the number of the cell that `wanted` names, by its name or its number from 0; may be
// empty where there is only one. Throws core::UserError, which lists the cells.
int FindCell(const std::filesystem::path& folder, const std::vector<batch::CellIdentity>& cells,
             const std::string& wanted);

// Reads one cell of the run in a folder. `cell`: its name, or its number from 0; may be left out
// where the store has only one. Throws core::UserError, which lists the cells where `cell` must not
// be left out or is none of them.
StoredRun ReadRun(const std::filesystem::path& folder, const std::string& cell = "",
                  StoredValues values = StoredValues::kAll);

// Reads every cell. Memory: all records of the campaign.
std::vector<StoredRun> ReadCampaign(const std::filesystem::path& folder);

// Returns what the cell goes by in a campaign: its name, or that of its scenario where it has none.
std::string CellName(const StoredRun& run);

// Throws core::UserError where the run is one shard of a campaign, whose trials are no contiguous
// prefix: no rate can be told from it alone.
void RequireWhole(const StoredRun& run);

// Returns the program, its compiler and the CPU level that records may depend on. Stores and
// baselines keep it, and rank 0 sends it to the others, to be compared as text. Must stay: its
// form, as another text is another build. `program`: what a program that links rockyard is known
// by,
// "" of the command.
std::string BuildName(const std::string& program = "");

// Returns what a report says of a run, with the provenance of this program.
report::RunDescription Describe(const StoredRun& run, int threads);

// Returns the run for report::CompareRuns. `run` must outlive the view. Throws core::UserError
// where no trial is finished.
report::ComparedRun ComparedView(const StoredRun& run);

// Returns the run for statistics::Compare. `run` must outlive the view.
statistics::ScenarioRun ScenarioView(const StoredRun& run);

// Returns the run for report::SummarizeSweep.
report::SweepCellTrials SweepCellView(StoredRun run);

// Compares two runs of drives by report::CompareRuns. Their records need no values here
// (StoredValues::kNone): values are read again from the stores, some columns of both runs at a
// time. Memory: `values_at_once` values, by default 130 MB, or one column of each run where that is
// more; and 200 bytes a trial of each. Throws core::UserError where no trial of a run is finished.
report::RunComparison CompareDrives(const StoredRun& first, const StoredRun& second,
                                    std::size_t values_at_once = std::size_t{1} << 24);

}  // namespace rockyard::campaign

#include "campaign/folder_report.h"

#include <fmt/format.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "batch/executor.h"
#include "batch/trial_hash.h"
#include "campaign/run_source.h"
#include "core/json_text.h"
#include "core/provenance.h"
#include "report/atomic_file.h"
#include "report/run_description.h"
#include "report/run_files.h"
#include "report/summary_json.h"
#include "scenario/load.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

void WriteShardFiles(const StoredRun& run, const report::RunDescription& description) {
  report::WriteFileAtomically(run.folder / "scenario.resolved.json",
                              report::ResolvedScenarioJson(description));
  report::WriteTrialsCsv(run.folder, run.schema, run.records);
  report::WriteFileAtomically(run.folder / "summary.json", report::ShardJson(description));
}

// Loads one cell after the other, and keeps their hashes for that of the campaign.
class StoredCells {
 public:
  explicit StoredCells(const batch::ResultStore& store)
      : reader_(store.path().parent_path(), store) {}

  report::SweepCellTrials Load(std::size_t index) {
    StoredRun run = reader_.Load(static_cast<int>(index));
    std::string name = run.identity.name;
    report::SweepCellTrials trials = SweepCellView(std::move(run));
    hashes_.push_back({std::move(name), trials.trial_hash});
    return trials;
  }

  std::string CampaignHash() const { return batch::CampaignHash(hashes_); }

 private:
  CellReader reader_;
  std::vector<batch::CellHash> hashes_;
};

// Writes counts and no rates: a shard holds no contiguous prefix of any cell.
SweepShardReport ReportSweepShard(const batch::ResultStore& store) {
  const batch::Shard shard = store.identity().shard;
  const std::filesystem::path folder = store.path().parent_path();
  const CellReader reader(folder, store);
  std::vector<report::ShardCell> cells;
  report::Accounting total;
  for (int cell = 0; cell < store.cells(); ++cell) {
    const StoredRun run = reader.Load(cell);
    cells.push_back({run.identity.name, AccountingOf(run)});
    total = report::Sum(total, cells.back().accounting);
  }
  const std::string& name = store.identity().name;
  std::string json = report::ShardCampaignJson(name, shard.index, shard.count, cells);
  report::WriteFileAtomically(folder / "summary.json", json);
  return {folder, name, shard, total, std::move(json)};
}

}  // namespace

RunReport ReportRun(const std::filesystem::path& folder, const ReportSettings& settings) {
  const StoredRun run = ReadRun(folder);
  // Trials that a rule ended are no sample of fixed size: only kStopped allows for that.
  RunReport told{.folder = run.folder,
                 .description = Describe(run, batch::ThreadCount({.threads = settings.threads})),
                 .summary = {},
                 .method = run.rule ? statistics::IntervalMethod::kStopped : settings.method};
  // The resolved scenario names the trials that are planned now; the run may have been extended.
  core::JsonValue resolved = core::ParseJson(run.identity.resolved, folder.string());
  resolved.Set("trials", core::JsonValue(run.planned));
  told.description.resolved = core::DumpJson(resolved);
  if (!run.shard.whole()) {
    WriteShardFiles(run, told.description);
  } else if (truth::IsMeasurement(run.schema)) {
    told.summary = report::WriteMeasurementFiles(run.folder, told.description, run.schema,
                                                 run.records, run.prefix(), told.method);
  } else {
    told.summary = report::WriteRunFiles(run.folder, told.description, run.schema, run.records,
                                         run.prefix(), told.method);
  }
  return told;
}

FolderReport ReportSweep(const batch::ResultStore& store, const scenario::Sweep& sweep,
                         const ReportSettings& settings) {
  if (!store.identity().shard.whole()) return ReportSweepShard(store);
  const std::filesystem::path folder = store.path().parent_path();
  StoredCells cells(store);
  report::SweepSummary summary = report::SummarizeSweep(
      sweep, [&](std::size_t index) { return cells.Load(index); }, settings.method);
  report::SweepDescription description{
      .trial_hash = cells.CampaignHash(),
      .provenance = core::CurrentProvenance(),
      .builds = store.Builds(),
      .threads = batch::ThreadCount({.threads = settings.threads})};
  report::WriteSweepFiles(folder, sweep, summary, description);
  return SweepReport{folder, sweep, std::move(summary), std::move(description)};
}

}  // namespace rockyard::campaign

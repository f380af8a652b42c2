#include "app/sweep_report.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/console.h"
#include "app/next_command.h"
#include "batch/executor.h"
#include "batch/trial_hash.h"
#include "campaign/run_source.h"
#include "campaign/run_views.h"
#include "core/provenance.h"
#include "report/accounting.h"
#include "report/atomic_file.h"
#include "report/line_text.h"
#include "report/sweep_files.h"

namespace rockyard::app {
namespace {

// Loads one cell after the other, and keeps their hashes for that of the campaign.
class StoredCells {
 public:
  explicit StoredCells(const batch::ResultStore& store)
      : reader_(store.path().parent_path(), store) {}

  report::SweepCellTrials Load(std::size_t index) {
    campaign::StoredRun run = reader_.Load(static_cast<int>(index));
    std::string name = run.identity.name;
    report::SweepCellTrials trials = campaign::SweepCellView(std::move(run));
    hashes_.push_back({std::move(name), trials.trial_hash});
    return trials;
  }

  std::string CampaignHash() const { return batch::CampaignHash(hashes_); }

 private:
  campaign::CellReader reader_;
  std::vector<batch::CellHash> hashes_;
};

// A shard holds no contiguous prefix of any cell: counts, and no rates.
void ReportSweepShard(const batch::ResultStore& store, const ReportOptions& options) {
  const batch::Shard shard = store.identity().shard;
  const std::filesystem::path folder = store.path().parent_path();
  const campaign::CellReader reader(folder, store);
  std::vector<report::ShardCell> cells;
  report::Accounting total;
  for (int cell = 0; cell < store.cells(); ++cell) {
    const campaign::StoredRun run = reader.Load(cell);
    cells.push_back({run.identity.name, campaign::AccountingOf(run)});
    total = report::Sum(total, cells.back().accounting);
  }
  const std::string json =
      report::ShardCampaignJson(store.identity().name, shard.index, shard.count, cells);
  report::WriteFileAtomically(folder / "summary.json", json);
  if (options.output == Output::kJson) Print(json);
  if (options.output != Output::kText) return;
  Print(fmt::format("{}: shard {} of {}\n{}",
                    report::Cut(report::Printable(store.identity().name), 40), shard.index,
                    shard.count, report::AccountingText(total)));
  Print(fmt::format("  results in {}\n", folder.string()));
  if (options.next) Print(NextLine(folder, Finished::kShard, options.resume));
}

}  // namespace

void ReportSweep(const batch::ResultStore& store, const scenario::Sweep& sweep,
                 const ReportOptions& options) {
  if (!store.identity().shard.whole()) return ReportSweepShard(store, options);
  const std::filesystem::path folder = store.path().parent_path();
  StoredCells cells(store);
  const report::SweepSummary summary = report::SummarizeSweep(
      sweep, [&](std::size_t index) { return cells.Load(index); }, options.method);
  const report::SweepDescription description{
      .trial_hash = cells.CampaignHash(),
      .provenance = core::CurrentProvenance(),
      .builds = store.Builds(),
      .threads = batch::ThreadCount({.threads = options.threads})};
  report::WriteSweepFiles(folder, sweep, summary, description);
  switch (options.output) {
    case Output::kText:
      Print(report::SweepText(sweep, summary, description, StyleFor(stdout)));
      Print(fmt::format("  results in {}\n", folder.string()));
      if (options.next) Print(NextLine(folder, Finished::kSweep, options.resume));
      break;
    case Output::kJson:
      Print(report::SweepJson(sweep, summary, description));
      break;
    case Output::kQuiet:
      break;
  }
}

}  // namespace rockyard::app

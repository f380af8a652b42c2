#include "app/sweep_report.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/console.h"
#include "batch/executor.h"
#include "batch/trial_hash.h"
#include "core/provenance.h"
#include "report/sweep_files.h"

namespace rockyard::app {
namespace {

// Loads one cell after the other, and keeps their hashes for that of the campaign.
class StoredCells {
 public:
  explicit StoredCells(const batch::ResultStore& store) : store_(store) {}

  report::SweepCellTrials Load(std::size_t index) {
    const int cell = static_cast<int>(index);
    std::vector<truth::Record> records = store_.Load(cell);
    const auto stored = static_cast<std::int64_t>(records.size());
    records.resize(batch::ContiguousPrefix(records).size());
    std::string hash = batch::TrialHash(records);
    hashes_.push_back({store_.identity().cells[index].name, hash});
    return {.schema = store_.identity().schema,
            .prefix = std::move(records),
            .planned = store_.planned(cell),
            .stored = stored,
            .trial_hash = std::move(hash)};
  }

  std::string CampaignHash() const { return batch::CampaignHash(hashes_); }

 private:
  const batch::ResultStore& store_;
  std::vector<batch::CellHash> hashes_;
};

// A shard holds no contiguous prefix of any cell.
bool TellShard(const batch::ResultStore& store) {
  const batch::Shard shard = store.identity().shard;
  if (shard.whole()) return false;
  PrintNote(fmt::format("part {} of {} is in {}; `rockyard merge` puts the parts together",
                        shard.index, shard.count, store.path().parent_path().string()));
  return true;
}

}  // namespace

void ReportSweep(const batch::ResultStore& store, const scenario::Sweep& sweep,
                 const ReportOptions& options) {
  if (TellShard(store)) return;
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
      break;
    case Output::kJson:
      Print(report::SweepJson(sweep, summary, description));
      break;
    case Output::kQuiet:
      break;
  }
}

}  // namespace rockyard::app

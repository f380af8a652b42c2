#include "campaign/merge.h"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <variant>
#include <vector>

#include "batch/merge_shards.h"
#include "batch/result_store.h"
#include "core/error.h"
#include "core/result.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {
namespace {

FolderReport ReportMerged(const std::filesystem::path& folder) {
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  const std::string& design = store.identity().design;
  if (design.empty()) return ReportRun(folder, {});
  return ReportSweep(store, scenario::ParseSweep(design), {});
}

// A trace belongs to a trial, but which trials have one was decided in each shard alone.
void RemarkTraces(const MergeRequest& request, Journal& journal) {
  std::error_code ignored;
  for (const std::filesystem::path& shard : request.shards) {
    if (!std::filesystem::is_directory(shard / "traces", ignored)) continue;
    journal.Remark(
        fmt::format("traces of shards are not merged: the same run or sweep with --out {}, "
                    "--resume and --traces, and without --shard, writes those of the whole",
                    request.folder.string()));
    return;
  }
}

// The folder has its own name only when its files are there.
FolderReport InFolder(FolderReport report, const std::filesystem::path& folder) {
  std::visit([&](auto& told) { told.folder = folder; }, report);
  return report;
}

}  // namespace

WorkResult Merge(const MergeRequest& request, const MergeObserver& observer) {
  return Recorded(observer, [&](Journal& journal) {
    core::Result<FolderReport> report = std::vector<core::Problem>{{"merge", "has not run", ""}};
    const batch::Merged merged = batch::MergeShards(
        request.shards, request.folder, {.build = request.build, .partial = request.partial},
        [&](const std::filesystem::path& made) {
          report = core::Attempt([&] { return ReportMerged(made); });
        });
    if (merged == batch::Merged::kBefore) {
      journal.Remark(fmt::format("{} holds these shards already", request.folder.string()));
      report = core::Attempt([&] { return ReportMerged(request.folder); });
    }
    journal.SetFolder(request.folder);
    RemarkTraces(request, journal);
    if (report.ok()) {
      if (observer.reported) observer.reported(InFolder(*report, request.folder));
      return Outcome::kDone;
    }
    journal.Warn("the shards are together in " + request.folder.string() +
                 ", but not all that follows");
    journal.Fail(report.problems());
    return Outcome::kFailed;
  });
}

}  // namespace rockyard::campaign

// Puts the shards of a campaign together.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "batch/campaign_differences.h"
#include "campaign/folder_report.h"
#include "campaign/journal.h"
#include "campaign/observer.h"

namespace rockyard::campaign {

struct MergeRequest {
  std::vector<std::filesystem::path> shards;
  std::filesystem::path folder;  // a new one
  batch::BuildPolicy build = batch::BuildPolicy::kSame;
  bool partial = false;  // shards or trials may be missing: they are pending then
};

struct MergeObserver : Observer {
  // The files of the new folder are written.
  std::function<void(const FolderReport& report)> reported = {};
};

// The folder appears when it is whole. Never throws. What is merged stays, whatever becomes of the
// files that follow from it: kFailed where one cannot be written.
WorkResult Merge(const MergeRequest& request, const MergeObserver& observer = {});

}  // namespace rockyard::campaign

/// @file
/// Drives one trial again and writes its 3-D replay, a page for a browser, and a plan view.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/work.h"
#include "truth/record.h"

namespace rockyard::campaign {

/// Which trial is shown, and in which files.
struct ReplayRequest {
  TrialRequest trial;                       ///< the one that is driven again
  std::optional<TrialRequest> beside = {};  ///< a second trial on the same page
  /// Files; empty: results/runs/<name>-seed<seed>-trial<I>.html, the plan beside the page, no data.
  std::string page = {};
  std::string plan = {};
  std::string data = {};  ///< what the page is given
};

/// A file that was written.
struct ReplayFile {
  std::string what;  ///< "3-D replay"
  std::filesystem::path path;
};

/// What came of it.
struct ReplayResult : WorkResult {
  std::string title;     ///< empty: nothing was driven
  truth::Record record;  ///< of the trial
  /// Of both trials; absent where there is no record to repeat.
  std::optional<bool> repeats_stored;
  std::vector<ReplayFile> files;  ///< that are written
};

/// Never throws. kDiffers where the trial does not repeat its stored record, which is shown all the
/// same. In a build without pages there are the plan and the data. Cost: that of driving the trial,
/// and some megabytes of files.
ReplayResult Replay(const ReplayRequest& request, const Observer& observer = {});

}  // namespace rockyard::campaign

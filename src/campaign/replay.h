/// @file
/// Drives one trial again and writes its 3-D replay, a page for a browser, and a plan view. The
/// command `replay` and programs call it.
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
  /// The files to write. Empty: for the page results/runs/<name>-seed<seed>-trial<I>.html, for the
  /// plan a file beside the page, for the data none.
  std::string page = {};
  std::string plan = {};
  std::string data = {};  ///< what the page is given
};

/// A file that was written.
struct ReplayFile {
  std::string what;  ///< "3-D replay"
  std::filesystem::path path;
};

/// What came of a replay.
struct ReplayResult : WorkResult {
  std::string title;     ///< empty: nothing was driven
  truth::Record record;  ///< of the trial
  /// Whether the trials repeat their stored records; absent where none has one.
  std::optional<bool> repeats_stored;
  std::vector<ReplayFile> files;  ///< that are written
};

/// Drives the trials and writes the files. Never throws. The outcome is kDiffers where a trial does
/// not repeat its stored record; the trial is shown all the same. In a build without pages there
/// are the plan and the data. Cost: that of driving the trials, and some megabytes of files.
ReplayResult Replay(const ReplayRequest& request, const Observer& observer = {});

}  // namespace rockyard::campaign

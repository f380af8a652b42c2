// Drives one trial again and writes its 3-D replay, a page for a browser, and a plan view.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/journal.h"
#include "campaign/observer.h"
#include "campaign/trial_source.h"
#include "truth/record.h"

namespace rockyard::campaign {

struct ReplayRequest {
  TrialRequest trial;
  std::optional<TrialRequest> beside = {};  // a second trial on the same page
  // Files; empty: results/runs/<name>-seed<seed>-trial<I>.html, the plan beside the page, no data.
  std::string page = {};
  std::string plan = {};
  std::string data = {};  // what the page is given
};

struct ReplayFile {
  std::string what;  // "3-D replay"
  std::filesystem::path path;
};

struct ReplayResult : WorkResult {
  std::string title;                   // empty: nothing was driven
  truth::Record record;                // of the trial
  std::optional<bool> repeats_stored;  // absent where there is no record to repeat; of both trials
  std::vector<ReplayFile> files;       // that are written
};

// Never throws. kDiffers where the trial does not repeat its stored record, which is shown all the
// same. In a build without pages there are the plan and the data. Cost: see replay_page.h.
ReplayResult Replay(const ReplayRequest& request, const Observer& observer = {});

}  // namespace rockyard::campaign

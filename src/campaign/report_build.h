// Puts a report together: from stores to the data of a page.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "campaign/report_inputs.h"
#include "campaign/report_replays.h"
#include "campaign/report_tracks.h"

namespace rockyard::campaign {

struct PageRequest {
  std::vector<ReportInput> inputs;
  std::string title;  // empty: what the inputs are of
  std::string command;
  std::string against;         // reference file; "" for those of results/reference
  std::size_t replays = 0;     // of the worst of each run, and of each sweep in all
  std::filesystem::path page;  // whose replays are written beside it
  ReplayReport progress;       // of these
  std::size_t tracks = 0;      // of each run that is no cell of a sweep
  TrackReport track_progress = {};
};

struct Report {
  std::string title;
  std::string json;  // ReportPayload of src/web/report/payload.ts
  std::size_t runs = 0;
  std::size_t trials = 0;
  ReportReplays replays;
};

// Throws core::UserError: a run without finished trials, a sweep that this program cannot read, a
// reference that fits none of the runs. Memory: the records of one run or cell at a time, 100 bytes
// for each trial of runs that are compared, and three times the text. Cost: linear in the trials;
// the comparison with published values takes some seconds.
Report BuildReport(const PageRequest& request, const Contact& contact);

}  // namespace rockyard::campaign

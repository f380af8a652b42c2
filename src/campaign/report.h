// Writes a page for a browser: what runs and sweeps say, and replays of failures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "campaign/journal.h"
#include "campaign/observer.h"
#include "campaign/report_replays.h"
#include "campaign/report_tracks.h"
#include "campaign/stop.h"

namespace rockyard::campaign {

struct ReportRequest {
  std::vector<std::string> runs;  // folders of runs or sweeps; runs are compared with the first
  std::string cell = {};          // of a campaign, that one alone: its name or number
  std::string page = {};          // empty: report.html in the folder that is named first
  std::string data = {};          // the numbers of the page as JSON; empty: no such file
  std::string against = {};       // reference file; empty: those of results/reference
  std::string title = {};         // empty: the scenarios of the runs
  std::string command = {};       // that makes the page, as the page shows it
  std::size_t replays = 5;   // of the worst failed trials of each run, or of each sweep; above 0, a
                             // run gets one of each outcome too
  std::size_t tracks = 100;  // true paths of trials of each run, for its map
};

struct ReportObserver : Observer {
  ReplayReport replays = {};
  TrackReport tracks = {};
};

struct ReportResult : WorkResult {
  std::filesystem::path page;
  std::size_t page_bytes = 0;  // 0: not written
  std::size_t data_bytes = 0;  // 0: not written
  std::size_t runs = 0;
  std::size_t trials = 0;
  ReportReplays replays;
};

// Never throws. Cost: see report_build.h.
ReportResult WriteReport(const ReportRequest& request, const ReportObserver& observer = {},
                         const Stop& stop = {});

}  // namespace rockyard::campaign

// Writes a page for a browser: what runs and sweeps say, and replays of failures. The command
// `report` calls it. No record depends on it: stores are only read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "campaign/journal.h"
#include "campaign/report_inputs.h"
#include "campaign/report_replays.h"
#include "campaign/stop.h"
#include "campaign/work.h"

namespace rockyard::campaign {

struct ReportRequest {
  std::vector<std::string> runs;  // folders of runs or sweeps; runs are compared with the first
  std::string cell = {};          // of a campaign, that one alone: its name or number
  std::string page = {};          // empty: report.html in the folder that is named first
  std::string data = {};          // the numbers of the page as JSON; empty: no such file
  std::string against = {};       // reference file; empty: those of `references`
  std::string references = "results/reference";  // folder
  std::string title = {};                        // empty: the scenarios of the runs
  std::string command = {};                      // that makes the page, as the page shows it
  std::size_t replays = 5;   // of the worst failed trials of each run, or of each sweep; above 0, a
                             // run gets one of each outcome too
  std::size_t tracks = 100;  // true paths of trials of each run, for its map
  bool plugins = false;      // whether runs in which a plugin decides are driven again for both
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

// Writes the page that the request asks for, and its replays. Never throws. Cost: that of
// BuildReport.
ReportResult WriteReport(const ReportRequest& request, const ReportObserver& observer = {},
                         const Stop& stop = {});

// What a page is built from.
struct PageRequest {
  std::vector<ReportInput> inputs;
  std::string title;  // empty: what the inputs are of
  std::string command;
  std::string against;                           // reference file; "" for those of `references`
  std::string references = "results/reference";  // folder
  std::size_t replays = 0;     // of the worst of each run, and of each sweep in all
  std::filesystem::path page;  // whose replays are written beside it
  ReplayReport progress;       // of these
  std::size_t tracks = 0;      // of each run that is no cell of a sweep
  bool plugins = false;        // whether plugins may run for them
  TrackReport track_progress = {};
};

struct Report {
  std::string title;
  std::string json;  // ReportPayload of src/web/report/payload.ts
  std::size_t runs = 0;
  std::size_t trials = 0;
  ReportReplays replays;
};

// Puts a report together: from stores to the data of a page, with its replays written beside it.
// Throws core::UserError: a run without finished trials, a sweep that this program cannot read, a
// reference that fits none of the runs. Memory: the records of one run or cell at a time, 100 bytes
// for each trial of runs that are compared, and three times the text. Cost: linear in the trials;
// the comparison with published values takes some seconds.
Report BuildReport(const PageRequest& request, const Contact& contact);

}  // namespace rockyard::campaign

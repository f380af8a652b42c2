// What a report drives again: the replay pages that are written with it, and true paths for its
// map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "batch/result_store.h"
#include "campaign/campaign_process.h"
#include "campaign/run_source.h"
#include "campaign/work.h"
#include "report/page_data.h"
#include "truth/record.h"

namespace rockyard::campaign {

// A trial that is worth a look, with what is needed to drive it again.
struct ChosenTrial {
  std::filesystem::path folder;
  std::string cell;              // number, or "" of a run
  batch::CellIdentity identity;  // of the cell
  std::vector<std::string> builds;
  truth::Record record;
  std::size_t run = 0;  // position on the page
  std::string label;
  double goal_distance_m = 0.0;  // infinity where unknown
};

// Returns the worst failed trials of a run (report/trial_outcomes.h); none of a run that measures.
std::vector<ChosenTrial> FindWorst(const StoredRun& run, std::size_t most);

// Adds the trials with these numbers, which must be stored, behind those that are chosen already;
// none twice.
void AddChosen(const StoredRun& run, std::span<const std::uint64_t> trials,
               std::vector<ChosenTrial>& chosen);

// Returns the worst of several cells together: furthest from the goal first, at most `most`.
// Equally far ones keep their order.
std::vector<ChosenTrial> Worst(std::vector<ChosenTrial> trials, std::size_t most);

struct ReportReplays {
  std::vector<std::vector<report::PageLink>> links;  // by run of the page
  std::size_t written = 0;
  std::filesystem::path folder;
  Outcome outcome = Outcome::kDone;
};

struct ReplayProgress {
  std::size_t ended = 0;
  std::size_t total = 0;
  std::uint64_t trial = 0;  // that ended last
  std::string label;        // of its run
};
// Called by one thread at a time, as replays end.
using ReplayReport = std::function<void(const ReplayProgress& progress, Moment moment)>;

// Drives the trials again and writes a page for each into the folder <stem of `page`>_replays
// beside `page`, which is made where it is needed. A trial that does not repeat its stored record
// is told, gets no page, and makes kDiffers; one that cannot be driven or written makes kFailed. A
// wish to stop ends the work after the trials in flight, with kInterrupted: what is written is
// linked. Pages of earlier reports in the folder stay, and are told. Cost: that of the trials, on
// `threads` threads; memory: the recording of one trial for each.
ReportReplays WriteReplays(const std::filesystem::path& page, std::span<const ChosenTrial> trials,
                           std::size_t runs, int threads, const Contact& contact,
                           const ReplayReport& progress = {});

struct TrackProgress {
  std::size_t ended = 0;
  std::size_t total = 0;
  std::string label;  // of the run
};
// Called by one thread at a time, as tracks end.
using TrackReport = std::function<void(const TrackProgress& progress, Moment moment)>;

struct TrackRequest {
  std::string label;
  std::size_t first = 0;                // so many trials from the first on; 0: no tracks at all
  std::vector<std::uint64_t> examples;  // these, with their rocks
  std::vector<std::uint64_t> named;     // and these
  double limit_s = 0.0;                 // no further trial starts after it
  int threads = 1;
  bool plugins = false;  // whether plugins may run, for runs in which one decides
};

struct Tracks {
  std::vector<report::PageTrack> tracks;  // by trial
  std::size_t first = 0;  // of them, those of the first trials: chosen without regard to their end
};

// Drives trials again for their true paths. The examples and the named trials come first, then the
// first ones; of a multibody rover these are a fourth as many. Trials that are not the stored ones
// when they are driven again have no track, and are told as one warning. A drive whose navigator
// ended the process that ran it is not driven again. Paths are simplified by 1 cm. Cost: that of
// the trials.
Tracks DriveTracks(const StoredRun& run, const TrackRequest& request, const Contact& contact,
                   const TrackReport& progress = {});

}  // namespace rockyard::campaign

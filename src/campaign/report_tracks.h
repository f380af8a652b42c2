// The true paths of a run's trials, for the map of a report: trials are driven again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "campaign/campaign_process.h"
#include "campaign/observer.h"
#include "campaign/run_source.h"
#include "report/page_tracks.h"

namespace rockyard::campaign {

struct TrackProgress {
  std::size_t ended = 0;
  std::size_t total = 0;
  std::string label;  // of the run
};
// By one thread at a time.
using TrackReport = std::function<void(const TrackProgress& progress, Moment moment)>;

struct TrackRequest {
  std::string label;
  std::size_t first = 0;                // so many trials from the first on; 0: no tracks at all
  std::vector<std::uint64_t> examples;  // these, with their rocks
  std::vector<std::uint64_t> named;     // and these
  double limit_s = 0.0;                 // no further trial starts after it
  int threads = 1;
};

struct Tracks {
  std::vector<report::PageTrack> tracks;  // by trial
  std::size_t first = 0;  // of them, those of the first trials: chosen without regard to their end
};

// Drives the examples and the named trials first, then the first ones, a fourth as many of a
// multibody rover. Trials without a track, since they are not those stored when they are driven
// again, are told as one warning. Paths are simplified by 1 cm. Cost: that of the trials.
Tracks DriveTracks(const StoredRun& run, const TrackRequest& request, const Contact& contact,
                   const TrackReport& progress = {});

}  // namespace rockyard::campaign

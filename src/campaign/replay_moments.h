// Scans and steps of a trial that is run again, listed or drawn: what `rockyard replay` does with
// --list, --scan or --step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "campaign/journal.h"
#include "campaign/looks/look_pictures.h"
#include "campaign/trial_source.h"
#include "campaign/work.h"
#include "math/pose.h"
#include "messages/navigation_view.h"
#include "report/scan_drawing.h"

namespace rockyard::campaign {

// Either one scan or one step is drawn into a folder, or, where neither is named, all are listed.
struct MomentsRequest {
  TrialRequest trial;
  std::optional<std::int64_t> scan = {};
  std::optional<std::int64_t> step = {};
  std::filesystem::path folder = {};  // empty: results/runs/<name>-seed<seed>-trial<I>-scan<N>
};

// Where the rover stood, and what the scan shows by itself.
struct ScanMoment {
  std::int64_t number = 0;
  math::Pose2 pose;
  std::vector<bool> stripe_hazard;
};

// Where the rover stood, and what it chose.
struct StepMoment {
  math::Pose2 pose;
  messages::NavigationView view;
};

// Scans and steps are told while the trial runs: a trial that ends its process has told what came
// before.
struct MomentsObserver : Observer {
  std::function<void(const ScanMoment& scan)> scan = {};
  std::function<void(const StepMoment& step)> step = {};
};

struct MomentsResult : WorkResult {
  std::int64_t scans = 0;
  std::int64_t steps = 0;
  std::optional<bool> repeats_stored;  // absent where there is no record to repeat
  // What was drawn, into `folder`: one of both.
  std::optional<report::ScanView> scan;
  std::optional<messages::NavigationView> step;
  std::vector<LookFile> look_files;  // what stereo cameras saw of the step
  std::string no_images;             // why look_files has no images of stereo cameras
};

// Runs the trial, and lists or draws. Never throws. The outcome is kBadInput where the scan or step
// does not occur, kDiffers where the trial does not repeat its stored record. Cost: that of the
// trial, and some seconds where a scan is drawn.
MomentsResult ReplayMoments(const MomentsRequest& request, const MomentsObserver& observer = {});

}  // namespace rockyard::campaign

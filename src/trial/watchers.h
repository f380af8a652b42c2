// Whoever looks over the shoulder of a trial: for pictures and for tests. A trial is the same with
// any of them and without.
#pragma once

#include "trial/scan_watcher.h"
#include "trial/step_watcher.h"
#include "trial/stereo_watcher.h"

namespace rockyard::trial {

struct Watchers {
  ScanWatcher scan = {};      // called after every scan of the light stripe
  StereoWatcher stereo = {};  // after every look of stereo cameras that has images
  StepWatcher step = {};      // after every decision of a map-based navigator that follows a look
};

}  // namespace rockyard::trial

// Everything that can be shown of one scan, taken at the moment when it happens, and where a
// decision of a map-based navigator was taken, for its drawing. `replay --scan` and `--step` draw
// them; recordings of drives take the hazards of each scan. No record depends on it.
#pragma once

#include <vector>

#include "messages/estimates.h"
#include "messages/stripe_images.h"
#include "report/scan_drawing.h"
#include "report/step_scene.h"
#include "trial/watchers.h"
#include "truth/trace.h"

namespace rockyard::campaign {

// One exposure with what the rover makes of it before it looks for stripes.
struct CapturedExposure {
  messages::StripeExposure frames;  // whole images, one band each
  std::vector<double> difference;   // averaged, row-major, counts
};

// A scan as it is shown.
struct CapturedScan {
  report::ScanView view;
  std::vector<CapturedExposure> exposures;
};

// Returns what the rover makes of a scan by itself, without a second one.
messages::HazardReport HazardsOf(const trial::WatchedScan& watched);

// Captures a scan. Whole images of every camera and group of lasers are rendered, also where the
// scan came from the geometric model. Cost: some seconds.
CapturedScan Capture(const trial::WatchedScan& watched);

// Returns where a decision was taken. `trace` is that of the trial up to this decision. Rocks lie
// where they lie now. A rover without stereo cameras has no camera.
report::StepScene SceneOf(const trial::WatchedStep& watched, const truth::Trace& trace);

}  // namespace rockyard::campaign

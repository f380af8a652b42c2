// Where a decision of a map-based navigator was taken, for its drawing.
#pragma once

#include "report/step_scene.h"
#include "trial/watchers.h"
#include "truth/trace.h"

namespace rockyard::campaign {

// `trace` is that of the trial up to this decision. Rocks lie where they lie now. A rover without
// stereo cameras has no camera.
report::StepScene SceneOf(const trial::WatchedStep& watched, const truth::Trace& trace);

}  // namespace rockyard::campaign

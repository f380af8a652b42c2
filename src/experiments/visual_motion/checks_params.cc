#include "experiments/visual_motion/checks_params.h"

namespace rockyard::experiments {

void RequireVisualMotion(const VisualMotionStudyParams& /*study*/, const trial::DriveParams& drive,
                         core::FieldVisitor& v) {
  v.Require("terrain.ground.slope_deg", drive.terrain.ground.IsLevel(),
            "or roughness_rms_m is not 0, or there are ditches or pits, where the experiment puts "
            "the rover on level ground",
            "leave the ground flat");
}

}  // namespace rockyard::experiments

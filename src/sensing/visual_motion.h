// Visual odometry without images: the true motion with the errors that images have. Drives with
// sensors.visual_odometry.fidelity error_model measure their motion by it.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "math/pose.h"
#include "sensing/visual_motion_params.h"
#include "vision/odometry/estimate_motion.h"

namespace rockyard::sensing {

// A model of what vision::VisualOdometer makes of two pairs of images, fitted to rendered images
// (VisualErrorModelParams). It gives no motion by chance, or else the true motion with normal
// errors along and about the first moment's axes, and the covariance from which they were drawn.
// Limits: errors of one step are independent of those of the next, though the real steps from one
// keyframe share its errors; what cameras see at the place does not matter.
class VisualMotion {
 public:
  VisualMotion(const VisualErrorModelParams& params, core::TrialKey key)
      : params_(params), key_(key) {}

  // Returns the measured motion. `X_FS` is the pose of R at the second moment in R at the first.
  // `number` counts measurements from 0 and is the substream of kVisualMotion. Records depend on
  // the order of its draws: failure, then errors along, across, up, two of tilt, heading.
  vision::MotionResult Measure(const math::Transform& X_FS, std::int64_t number) const;

 private:
  VisualErrorModelParams params_;
  core::TrialKey key_;
};

}  // namespace rockyard::sensing

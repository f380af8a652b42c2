// Visual odometry without images: the true motion with the errors that images have.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "math/pose.h"
#include "sensing/visual_motion_params.h"
#include "vision/odometry/estimate_motion.h"

namespace rockyard::sensing {

// What vision::VisualOdometer makes of two pairs of images, as numbers fitted to rendered ones
// (VisualErrorModelParams): no motion by chance, or the true motion with normal errors about and
// along the first moment's axes, and the covariance that they were drawn from. Limits: errors of
// one step are independent of those of the next, though steps from one keyframe share its errors;
// what cameras see at the place does not matter.
class VisualMotion {
 public:
  VisualMotion(const VisualErrorModelParams& params, core::TrialKey key)
      : params_(params), key_(key) {}

  // `X_FS`: the pose of R at the second moment in R at the first. `number` counts measurements from
  // 0 and is the substream of kVisualMotion.
  vision::MotionResult Measure(const math::Transform& X_FS, std::int64_t number) const;

 private:
  VisualErrorModelParams params_;
  core::TrialKey key_;
};

}  // namespace rockyard::sensing

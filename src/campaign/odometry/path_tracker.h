// From motions against keyframes to a path.
#pragma once

#include <optional>

#include "campaign/odometry/odometry_request.h"
#include "vision/odometry/odometer.h"

namespace rockyard::campaign {

// The first pair stands at the identity.
class PathTracker {
 public:
  // Where the next pair is expected, told in the frame of the present keyframe. `step`: the motion
  // since the pair before that others expect. Nothing without that before any motion is known.
  std::optional<math::Transform> Predict(Prediction prediction,
                                         const std::optional<math::Transform>& step) const;

  // Pose and covariance of a pair whose motion was sought; `predicted` as above, which takes its
  // place where there is none.
  void Place(const vision::OdometryStep& found, const std::optional<math::Transform>& predicted,
             PathStep& step);

 private:
  struct Known {
    math::Transform X_AB = math::Transform::Identity();
    std::optional<vision::MotionCovariance> covariance = vision::MotionCovariance::Zero();
  };

  Known keyframe_;
  math::Transform X_AB_ = math::Transform::Identity();  // of the last pair
  std::optional<math::Transform> last_step_;            // between the last two pairs
};

}  // namespace rockyard::campaign

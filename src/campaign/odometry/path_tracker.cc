#include "campaign/odometry/path_tracker.h"

#include "vision/odometry/motion_estimate.h"

namespace rockyard::campaign {

using math::Transform;

std::optional<Transform> PathTracker::Predict(Prediction prediction,
                                              const std::optional<Transform>& step) const {
  if (prediction == Prediction::kNone) return std::nullopt;
  const std::optional<Transform>& next = prediction == Prediction::kFile ? step : last_step_;
  if (!next) return std::nullopt;
  return keyframe_.X_AB.inverse() * X_AB_ * *next;
}

void PathTracker::Place(const vision::OdometryStep& found,
                        const std::optional<Transform>& predicted, PathStep& step) {
  const bool first = found.reference == found.number;
  Known known = keyframe_;
  if (found.result.motion && known.covariance) {
    const vision::Motion whole =
        vision::Compose({known.X_AB, *known.covariance}, *found.result.motion);
    known = {whole.X_FS, whole.covariance};
  } else if (found.result.motion) {
    known.X_AB = known.X_AB * found.result.motion->X_FS;
  } else if (!first) {
    known = {predicted ? Transform(known.X_AB * *predicted) : X_AB_, std::nullopt};
  }
  if (!first) last_step_ = X_AB_.inverse() * known.X_AB;
  if (!first && !found.result.motion && !predicted) last_step_.reset();
  X_AB_ = known.X_AB;
  step.X_AB = known.X_AB;
  step.covariance = known.covariance;
  if (found.keyframe) keyframe_ = known;
}

}  // namespace rockyard::campaign

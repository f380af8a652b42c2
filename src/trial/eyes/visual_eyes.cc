#include "trial/eyes/visual_eyes.h"

#include <utility>

namespace rockyard::trial {

VisualEyes::VisualEyes(const DriveParams& drive, core::TrialKey key,
                       const terrain::Terrain& terrain, RoverCameras& cameras)
    : params_(drive.sensors.visual_odometry),
      motion_(drive.sensors.visual_odometry.error_model, key),
      terrain_(terrain),
      cameras_(cameras) {}

MotionData VisualEyes::Look(const math::Transform& X_WR) {
  if (params_.fidelity == sensing::VisualFidelity::kErrorModel) return Model(X_WR);
  return cameras_.Expose(CameraUse::kMotion, terrain_, X_WR, messages::LookDirection::kAhead,
                         next_++);
}

VisualStep VisualEyes::Model(const math::Transform& X_WR) {
  VisualStep step{next_++, keyframe_, false, {}};
  if (!X_WK_) {
    step.keyframe = true;
  } else {
    const math::Transform X_KR = X_WK_->inverse() * X_WR;
    step.result = motion_.Measure(X_KR, step.number);
    step.keyframe = !step.result.motion || IsFar(X_KR);
  }
  if (step.keyframe) {
    keyframe_ = step.number;
    X_WK_ = X_WR;
  }
  return step;
}

bool VisualEyes::IsFar(const math::Transform& X_KR) const {
  const sensing::VisualErrorModelParams& model = params_.error_model;
  return X_KR.translation().norm() >= model.keyframe_m ||
         math::TurnOf(X_KR.linear()).angle_rad >= model.keyframe_rad;
}

}  // namespace rockyard::trial

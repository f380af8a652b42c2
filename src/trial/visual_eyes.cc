#include "trial/visual_eyes.h"

#include <optional>

#include "sensing/visual_motion.h"

namespace rockyard::trial {
namespace {

// The true motion with errors.
class FittedEyes final : public VisualEyes {
 public:
  FittedEyes(const DriveParams& drive, core::TrialKey key)
      : params_(drive.sensors.visual_odometry.error_model),
        motion_(drive.sensors.visual_odometry.error_model, key) {}

  VisualStep Look(const math::Transform& X_WR, const math::Transform& /*predicted*/) override {
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

  void Renew() override { X_WK_.reset(); }

 private:
  bool IsFar(const math::Transform& X_KR) const {
    return X_KR.translation().norm() >= params_.keyframe_m ||
           Eigen::AngleAxisd(X_KR.linear()).angle() >= params_.keyframe_rad;
  }

  sensing::VisualErrorModelParams params_;
  sensing::VisualMotion motion_;
  std::int64_t next_ = 0;
  std::int64_t keyframe_ = 0;
  std::optional<math::Transform> X_WK_;
};

}  // namespace

std::unique_ptr<VisualEyes> MakeVisualEyes(const DriveParams& drive, core::TrialKey key,
                                           const terrain::Terrain& /*terrain*/) {
  return std::make_unique<FittedEyes>(drive, key);
}

}  // namespace rockyard::trial

#include "trial/eyes/visual_eyes.h"

#include <cstdint>
#include <optional>

#include "perception/visual_odometry.h"
#include "sensing/stereo_imager.h"
#include "sensing/visual_motion.h"
#include "trial/eyes/onboard_calibration.h"

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

// The cameras as the rover believes that they sit on it.
vision::StereoRig BelievedRig(const DriveParams& drive, const sensing::StereoImager& imager) {
  vision::StereoRig rig = imager.rig(messages::LookDirection::kAhead);
  if (const auto misplaced = StereoMisplacement(drive.sensors.stereo, drive.perception.calibration,
                                                messages::LookDirection::kAhead)) {
    rig.left = vision::Moved(*misplaced, rig.left);
    rig.right = vision::Moved(*misplaced, rig.right);
  }
  return rig;
}

// Rendered images of the cameras ahead, and on-board software on them.
class RenderedEyes final : public VisualEyes {
 public:
  RenderedEyes(const DriveParams& drive, core::TrialKey key, const terrain::Terrain& terrain)
      : terrain_(terrain),
        imager_(drive.sensors.stereo, drive.sensors.sun, drive.sensors.look, drive.rover.geometry,
                key),
        odometry_(drive.perception.visual_odometry.odometer, BelievedRig(drive, imager_),
                  static_cast<int>(drive.sensors.visual_odometry.pyramid_level), key) {}

  VisualStep Look(const math::Transform& X_WR, const math::Transform& predicted) override {
    const sensing::StereoImages images =
        imager_.Expose(terrain_, X_WR, kFirstLook + next_++, messages::LookDirection::kAhead);
    const vision::OdometryStep step = odometry_.Add(images.left, images.right, predicted);
    return {step.number, step.reference, step.keyframe, step.result};
  }

  void Renew() override { odometry_.Renew(); }

 private:
  // The noise of pixels is drawn by the number of a look. Those of terrain sensing count from 0.
  static constexpr std::int64_t kFirstLook = std::int64_t{1} << 29;

  const terrain::Terrain& terrain_;
  sensing::StereoImager imager_;
  perception::VisualOdometry odometry_;
  std::int64_t next_ = 0;
};

}  // namespace

std::unique_ptr<VisualEyes> MakeVisualEyes(const DriveParams& drive, core::TrialKey key,
                                           const terrain::Terrain& terrain) {
  if (drive.sensors.visual_odometry.fidelity == sensing::VisualFidelity::kImage) {
    return std::make_unique<RenderedEyes>(drive, key, terrain);
  }
  return std::make_unique<FittedEyes>(drive, key);
}

}  // namespace rockyard::trial

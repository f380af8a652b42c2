#include "trial/sight/visual_reader.h"

#include <variant>

#include "trial/sight/onboard_calibration.h"
#include "vision/cameras/cahv.h"

namespace rockyard::trial {
namespace {

// Returns the cameras ahead as the rover believes that they are mounted.
vision::StereoRig BelievedRig(const DriveParams& drive) {
  constexpr messages::LookDirection kAhead = messages::LookDirection::kAhead;
  vision::StereoRig rig =
      sensing::CalibratedRig(drive.sensors.stereo, drive.rover.geometry, kAhead);
  if (const auto misplaced =
          StereoMisplacement(drive.sensors.stereo, drive.perception.calibration, kAhead)) {
    rig.left = vision::Moved(*misplaced, rig.left);
    rig.right = vision::Moved(*misplaced, rig.right);
  }
  return rig;
}

}  // namespace

VisualStep VisualReader::Read(const MotionData& data, const math::Transform& predicted) {
  const auto* images = std::get_if<sensing::StereoImages>(&data);
  if (images == nullptr) return std::get<VisualStep>(data);
  if (!odometry_) {
    odometry_.emplace(drive_.perception.visual_odometry.odometer, BelievedRig(drive_),
                      static_cast<int>(drive_.sensors.visual_odometry.pyramid_level), key_);
  }
  const vision::OdometryStep step = odometry_->Add(images->left, images->right, predicted);
  return {step.number, step.reference, step.keyframe, step.result};
}

void VisualReader::Renew() {
  if (odometry_) odometry_->Renew();
}

}  // namespace rockyard::trial

// The estimator of MER (Maimone, Cheng and Matthies 2007): wheels and gyro carry the pose from
// image to image, and where visual odometry found a motion, the motion takes their place.
//
//   pose(to) <- pose(from) (+) motion    every later pose moves along with pose(to) as a rigid body
//
// where pose (+) motion goes by x and y along the heading and adds the turn. Roll, pitch and height
// are those of accelerometers and wheels. It keeps no account of its error, weighs no measurement
// against another, and takes no fixes. Records of scenarios that name another estimator do not
// depend on it.
#pragma once

#include <map>

#include "localization/dead_reckoning.h"
#include "localization/estimator.h"
#include "localization/estimator_set_params.h"

namespace rockyard::localization {

// Keeps the pose of each captured moment, at which motions begin and end.
class VisualOdometryEstimator final : public Estimator {
 public:
  explicit VisualOdometryEstimator(const EstimatorSetup& setup);

  void Propagate(const messages::MotionMeasurement& motion) override;
  void Feel(const messages::VehicleState& felt, double duration_s) override;
  void Place(const messages::PoseUpdate& update) override;

  void Capture(messages::CaptureNumber capture) override;
  void Forget(messages::CaptureNumber capture) override;
  AidUse Update(const messages::PoseFix& /*fix*/) override { return AidUse::kNoInterest; }
  AidUse Update(const messages::RelativeMotion& motion) override;

  const messages::LocalizationEstimate& estimate() const override { return estimate_; }

 private:
  math::Pose2 PoseNow() const;
  void TakePose(const math::Pose2& pose);

  DeadReckoningEstimator wheels_;  // its pose is that of the odometry frame
  std::map<messages::CaptureNumber, math::Pose2> moments_;
  messages::LocalizationEstimate estimate_;
};

// Describes the estimator that scenarios name visual_odometry; its parameters are those of the
// setup.
EstimatorDescription<core::NoParams> DescribeVisualOdometry();

}  // namespace rockyard::localization

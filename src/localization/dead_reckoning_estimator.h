// Dead reckoning and attitude as flown: wheels and gyro for the pose in the plane, accelerometers
// for roll and pitch, nothing else. It keeps no account of its error and takes no aids; operators
// tell it where it is.
#pragma once

#include "localization/attitude.h"
#include "localization/dead_reckoning.h"
#include "localization/estimator.h"
#include "localization/estimator_set_params.h"

namespace rockyard::localization {

class DeadReckoningEstimator final : public Estimator {
 public:
  explicit DeadReckoningEstimator(const EstimatorSetup& setup);

  void Propagate(const messages::MotionMeasurement& motion) override;
  void Feel(const messages::VehicleState& felt, double duration_s) override;
  void Place(const messages::PoseUpdate& update) override;

  const messages::LocalizationEstimate& estimate() const override { return estimate_; }

 private:
  // Nothing corrects the pose, so that both frames are one.
  void TakePose();

  DeadReckoning dead_reckoning_;
  AttitudeEstimator attitude_;
  messages::PoseEstimate felt_pose_;  // at the last Feel
  messages::LocalizationEstimate estimate_;
};

// Named dead_reckoning; its parameters are those of the setup.
EstimatorDescription<core::NoParams> DescribeDeadReckoning();

}  // namespace rockyard::localization
